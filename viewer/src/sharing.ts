// What the user takes away from the page: a link to this view, a picture, the samples that the plots show, the scene.

import { csvOf } from "./csv";
import type { Notices } from "./notices";
import { kWindow_s } from "./plots";
import type { SampleRing } from "./samples";
import { fileName, saveFile } from "./save";
import { sceneFile } from "./scene_file";
import type { SceneStore } from "./scene_store";
import type { Stage } from "./stage";
import type { SurfaceSettings } from "./surfaces";
import type { ViewMemory } from "./view_memory";

export class Sharing {
  private readonly samples_: SampleRing;
  private readonly sceneName_: () => string;
  /** The samples that a paused plot shows. */
  private held_: string | undefined;

  /** `samples`: force and penetration. */
  constructor(samples: SampleRing, sceneName: () => string) {
    this.samples_ = samples;
    this.sceneName_ = sceneName;
  }

  get paused(): boolean {
    return this.held_ !== undefined;
  }

  setPaused(paused: boolean): void {
    this.held_ = paused ? this.table() : undefined;
  }

  async copyLink(stage: Stage, memory: ViewMemory, notices: Notices): Promise<void> {
    const link = memory.link(stage.eye);
    // Also where a browser refuses to copy: there the user takes it from the notice.
    const copied = await navigator.clipboard?.writeText(link).then(() => true, () => false);
    if (copied === true) {
      notices.report("The link is copied.", false, "link");
    } else {
      notices.settle("link");
      notices.report(`The link: ${link}`, false);
    }
  }

  async savePicture(stage: Stage): Promise<void> {
    const picture = await stage.picture();
    if (picture !== undefined) {
      saveFile(fileName(this.sceneName_(), new Date(), "png"), picture);
    }
  }

  saveSamples(): void {
    const table = new Blob([this.held_ ?? this.table()], { type: "text/csv" });
    saveFile(fileName(this.sceneName_(), new Date(), "csv"), table);
  }

  /** Everything as it is now, with the materials that are felt: what the user has set is `over` the scene's. */
  async saveScene(store: SceneStore, over: SurfaceSettings, notices: Notices): Promise<void> {
    try {
      const { content, lacking } = await sceneFile(store, over);
      saveFile(fileName(this.sceneName_(), new Date(), "hl.json"), content);
      if (lacking === undefined) {
        notices.settle("scene file");
      } else {
        notices.report(lacking, false, "scene file");
      }
    } catch (error) {
      notices.report(error instanceof Error ? error.message : String(error), true, "scene file");
    }
  }

  private table(): string {
    const { times, values } = this.samples_.last(0, kWindow_s);
    return csvOf({ time_s: times, force_N: values, penetration_m: this.samples_.last(1, kWindow_s).values });
  }
}
