// The button that opens a file, and the whole page as a place to drop one.

import { element } from "./elements";
import type { FileDrop } from "./file_drop";

/** Calls `drop` with what the user gives. The button is there as long as anything can be opened. */
export class FileInput {
  private readonly input_ = element<HTMLInputElement>("file");
  /** Enters less leaves: each element under the pointer sends its own. */
  private depth_ = 0;

  constructor(private readonly drop_: FileDrop) {
    element("open-file").addEventListener("click", () => this.input_.click());
    this.input_.addEventListener("change", () => {
      const files = [...(this.input_.files ?? [])];
      this.input_.value = ""; // so that the same file can be chosen again
      void this.drop_.take(files);
    });
    window.addEventListener("dragenter", (event) => this.over(event, 1));
    window.addEventListener("dragleave", (event) => this.over(event, -1));
    window.addEventListener("dragover", (event) => this.accept(event));
    window.addEventListener("drop", (event) => this.dropped(event));
    this.showOffered();
  }

  /** Another server, or one that takes other files. */
  showOffered(): void {
    element("file-row").hidden = !this.drop_.offered;
  }

  private over(event: DragEvent, change: number): void {
    if (holdsFiles(event)) {
      this.depth_ = Math.max(0, this.depth_ + change);
      this.showTarget(this.depth_ > 0);
    }
  }

  /** Without this the browser would leave the page and show the file. */
  private accept(event: DragEvent): void {
    if (holdsFiles(event)) {
      event.preventDefault();
      event.dataTransfer!.dropEffect = this.drop_.offered ? "copy" : "none";
    }
  }

  private dropped(event: DragEvent): void {
    this.depth_ = 0;
    this.showTarget(false);
    if (holdsFiles(event)) {
      event.preventDefault();
      void this.drop_.take([...event.dataTransfer!.files]);
    }
  }

  private showTarget(shown: boolean): void {
    element("drop-target").hidden = !(shown && this.drop_.offered);
  }
}

function holdsFiles(event: DragEvent): boolean {
  return event.dataTransfer?.types.includes("Files") ?? false;
}
