// The elements of index.html by their ids. One that is missing is a mistake in the page, found immediately.

export function element<T extends HTMLElement = HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (found === null) {
    throw new Error(`the page has no element "${id}"`);
  }
  return found as T;
}

export function setText(id: string, text: string): void {
  const target = element(id);
  if (target.textContent !== text) {
    target.textContent = text;
  }
}

/** The tooltip. */
export function setTitle(id: string, title: string): void {
  const target = element(id);
  if (target.title !== title) {
    target.title = title;
  }
}

/** Calls `act` whenever a pointer lets go, wherever it then is: a slider's drag often ends beside the slider. */
export function onLetGo(act: () => void): void {
  window.addEventListener("pointerup", act);
  window.addEventListener("pointercancel", act);
}

/** Keys belong to the slider, the radio buttons and the open dialog while those have the focus. */
export function isEditing(target: EventTarget | null): boolean {
  return target instanceof Element && target.closest("input[type=range], input[type=radio], dialog") !== null;
}
