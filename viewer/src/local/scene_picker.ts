// The list of the built-in scenes.

import { element } from "../elements";
import { pickableScenes } from "./scene_names";

export class ScenePicker {
  private readonly select_ = element<HTMLSelectElement>("scene");
  /** The scene that is shown. */
  private shown_ = "";

  constructor(pick: (name: string) => void) {
    this.select_.addEventListener("change", () => pick(this.select_.value));
  }

  /** `list`: as help texts have it. */
  show(list: string): void {
    this.select_.replaceChildren(...pickableScenes(list).map((name) => new Option(name)));
    this.select_.hidden = false;
    this.select(undefined);
  }

  /** Another scene is shown now; undefined: the same as before. One that is not in the list is shown beside it. */
  select(name: string | undefined): void {
    this.shown_ = name ?? this.shown_;
    const options = [...this.select_.options];
    const listed = options.some(({ value }) => value === this.shown_);
    this.select_.selectedIndex = listed ? options.findIndex(({ value }) => value === this.shown_) : -1;
  }
}
