// The scene as it comes from the server: kept in the store, shown by the model view. Decides when the camera is fitted.

import type { State } from "./gen/hl_pb";
import { FeltMarks } from "./felt_marks";
import { needsFit } from "./fit";
import { ModelView } from "./model_view";
import type { Bounds, Layout, Mesh, Moves } from "./scene_messages";
import { SceneStore } from "./scene_store";

/** About what a hand reaches to each side, m at the hand. */
const kHandReach_m = 0.1;

export interface SceneHooks {
  /** A layout came and is shown. */
  shown(store: SceneStore, layout: Layout): void;
  /** The camera should show all of `bounds`. */
  fit(bounds: Bounds): void;
  /** Another scene has taken the place of the one before, at the same server. */
  replaced(): void;
}

export class LiveScene {
  readonly model = new ModelView();
  readonly marks = new FeltMarks();
  private readonly store_ = new SceneStore();
  private readonly hooks_: SceneHooks;
  /** What the camera was fitted to last; it outlives the connection. */
  private fitted_: Bounds | undefined;
  /** There have been objects since the scene was new or empty. */
  private begun_ = false;
  private name_: string | undefined;
  /** Meshes of the scene in whose place another one is to come. */
  private leaving_: ReadonlySet<number> | undefined;
  /** The server has taken that other scene; its layout is yet to come. */
  private coming_ = false;
  private moves_: Moves | undefined;
  private moving_ = false;
  private touched_: readonly number[] = [];

  constructor(hooks: SceneHooks) {
    this.hooks_ = hooks;
  }

  get store(): SceneStore {
    return this.store_;
  }

  get layout(): Layout | undefined {
    return this.store_.layout;
  }

  /** Whether the newest state moved objects. */
  get moving(): boolean {
    return this.moving_;
  }

  /** Whether the scene, or another one in its place, is on its way. */
  get coming(): boolean {
    return this.layout === undefined || this.coming_;
  }

  /** Objects of the layout that are touched. */
  get touched(): readonly number[] {
    return this.touched_;
  }

  /** A server begins: nothing of what another one sent is valid. Another scene is fitted anew, whatever its size. */
  clear(name: string): void {
    if (name !== this.name_) {
      this.fitted_ = undefined;
    }
    this.name_ = name;
    this.leaving_ = undefined;
    this.coming_ = false;
    this.store_.clear();
    this.model.clear();
    this.marks.clear();
    this.begun_ = false;
    this.moves_ = undefined;
    this.touched_ = [];
  }

  add(mesh: Mesh): void {
    this.store_.add(mesh);
    this.model.add(mesh);
  }

  forget(meshes: readonly number[]): void {
    this.store_.forget(meshes);
    this.model.forget(meshes);
  }

  /** A file of this page is about to take the place of the scene, perhaps under the same name; or is not, after all. */
  expectOther(expected: boolean): void {
    this.leaving_ = expected ? new Set(this.layout?.placed.map(({ mesh }) => mesh)) : undefined;
    this.coming_ = false;
  }

  /** The server has the other scene, and sends it. */
  taken(): void {
    this.coming_ = this.leaving_ !== undefined;
  }

  setLayout(layout: Layout): void {
    if (this.isOther(layout)) {
      this.name_ = layout.name;
      this.leaving_ = this.fitted_ = undefined;
      this.begun_ = this.coming_ = false;
      this.hooks_.replaced();
    }
    this.store_.setLayout(layout);
    this.model.setLayout(layout, this.store_.poses);
    this.marks.setLayout(layout, this.store_.poses);
    this.touched_ = [];
    if (layout.bounds !== undefined && !this.begun_ && needsFit(this.fitted_, layout.bounds)) {
      this.fit(layout.bounds);
    } else if (this.fitted_ === undefined) {
      this.hooks_.fit(handSpace(layout.worldPerDevice));
    }
    this.begun_ = layout.bounds !== undefined;
    this.hooks_.shown(this.store_, layout);
  }

  private isOther(layout: Layout): boolean {
    const left = this.leaving_ !== undefined && layout.placed.length > 0 &&
      layout.placed.every(({ mesh }) => !this.leaving_!.has(mesh));
    return left || (layout.name !== "" && layout.name !== this.name_);
  }

  /** Only the newest moves count; they are shown in the next frame. */
  take(state: State, moves: Moves): void {
    this.moves_ = moves;
    this.moving_ = moves.indices.length > 0;
    const current = state.layout === this.layout?.number;
    this.touched_ = current ? state.touched : [];
    this.marks.setHeld(current ? state.snap : undefined);
  }

  /** Once per drawn frame. */
  frame(): void {
    if (this.moves_ !== undefined) {
      const moved = this.store_.move(this.moves_);
      this.model.move(moved, this.store_.poses);
      if (moved.length > 0) {
        this.marks.move(this.store_.poses);
      }
      this.moves_ = undefined;
    }
    this.model.setTouched(this.touched_);
  }

  /** Shows everything as it is now. */
  refit(): void {
    const bounds = this.model.bounds(this.store_.poses) ?? this.fitted_;
    if (bounds !== undefined) {
      this.fit(bounds);
    }
  }

  private fit(bounds: Bounds): void {
    this.fitted_ = bounds;
    this.hooks_.fit(bounds);
  }
}

/** What to show while there is nothing else: where the hand can be. */
function handSpace(worldPerDevice: number): Bounds {
  const reach = worldPerDevice > 0 ? kHandReach_m * worldPerDevice : kHandReach_m;
  return { min: { x: -reach, y: -reach, z: -reach }, max: { x: reach, y: reach, z: reach } };
}
