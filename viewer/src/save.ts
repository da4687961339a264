// Gives the user a file.

/** Long enough for the browser to have begun with it. */
const kKeep_ms = 10_000;

export function saveFile(name: string, content: Blob): void {
  const address = URL.createObjectURL(content);
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), kKeep_ms);
}

/** A scene's name and the time as a file's name: letters, digits, dots and dashes alone. */
export function fileName(scene: string, time: Date, ending: string): string {
  const stem = scene.replace(/[^A-Za-z0-9.]+/g, "-").replace(/^[-.]+|[-.]+$/g, "") || "hl";
  return `${stem}-${time.toISOString().slice(0, 19).replace(/[:T]/g, "-")}.${ending}`;
}
