// The View section's settings: kept in this browser across reloads, taken from a link, put into a link.

import { element } from "./elements";
import type { Side } from "./section";
import { decodeView, encodeView, kBoxes, linkTo, type Camera, type ViewSettings } from "./view_settings";

const kStorageKey = "hl-view";

export class ViewMemory {
  /** The camera of the link that opened this page, until it is used. */
  private camera_: Camera | undefined;

  /** Sets the controls as the link says, else as they were last; they act as if the user had set them. */
  constructor() {
    const linked = decodeView(location.hash);
    this.camera_ = linked?.camera;
    const settings = linked?.settings ?? decodeView(readStorage() ?? "")?.settings;
    if (settings !== undefined) {
      apply(settings);
    }
    for (const id of [...kBoxes, "section", "section-at"]) {
      element(id).addEventListener("change", () => writeStorage(encodeView({ settings: shown(), camera: undefined })));
    }
  }

  /** Once. */
  takeCamera(): Camera | undefined {
    const camera = this.camera_;
    this.camera_ = undefined;
    return camera;
  }

  link(camera: Camera): string {
    return linkTo(location, { settings: shown(), camera });
  }
}

function shown(): ViewSettings {
  return {
    boxes: new Set(kBoxes.filter((id) => element<HTMLInputElement>(id).checked)),
    section: element<HTMLSelectElement>("section").value as Side,
    sectionAt: element<HTMLInputElement>("section-at").valueAsNumber,
  };
}

function apply({ boxes, section, sectionAt }: ViewSettings): void {
  for (const id of kBoxes) {
    const box = element<HTMLInputElement>(id);
    if (box.checked !== boxes.has(id)) {
      box.click();
    }
  }
  element<HTMLInputElement>("section-at").value = String(sectionAt);
  const select = element<HTMLSelectElement>("section");
  select.value = section;
  select.dispatchEvent(new Event("change"));
}

// Storage may be forbidden (private windows): then settings last as long as the page.
function readStorage(): string | null {
  try {
    return localStorage.getItem(kStorageKey);
  } catch {
    return null;
  }
}

function writeStorage(text: string): void {
  try {
    localStorage.setItem(kStorageKey, text);
  } catch {
    return;
  }
}
