// What the page knows of the scene: meshes, the layout that places them, and where everything is now. A state names only
// what is elsewhere than the layout says, so that states may be missed; what it no longer names is back in its place.

import { kPoseNumbers, type Layout, type Mesh, type Moves } from "./scene_messages";

export interface Counts {
  readonly objects: number;
  readonly triangles: number;
  readonly segments: number;
  readonly points: number;
}

export type Ahead = Pick<Counts, "triangles" | "points">;

export class SceneStore {
  private readonly meshes_ = new Map<number, Mesh>();
  private layout_: Layout | undefined;
  private poses_ = new Float32Array();
  private away_: readonly number[] = [];

  get meshes(): ReadonlyMap<number, Mesh> {
    return this.meshes_;
  }

  /** The one in force; none before the first. */
  get layout(): Layout | undefined {
    return this.layout_;
  }

  /** Where each object of the layout is now, kPoseNumbers each. */
  get poses(): Float32Array {
    return this.poses_;
  }

  clear(): void {
    this.meshes_.clear();
    this.layout_ = undefined;
    this.poses_ = new Float32Array();
    this.away_ = [];
  }

  add(mesh: Mesh): void {
    this.meshes_.set(mesh.number, mesh);
  }

  forget(meshes: readonly number[]): void {
    meshes.forEach((number) => this.meshes_.delete(number));
  }

  setLayout(layout: Layout): void {
    this.layout_ = layout;
    this.poses_ = layout.poses.slice();
    this.away_ = [];
  }

  /** Moves the objects; returns those that may have another pose now. Moves of another layout are for another moment. */
  move(moves: Moves): readonly number[] {
    const layout = this.layout_;
    if (layout === undefined || moves.layout !== layout.number) {
      return [];
    }
    const back = this.away_;
    for (const i of back) {
      this.poses_.set(poseAt(layout.poses, i), kPoseNumbers * i);
    }
    const away = moves.indices.filter((i) => i < layout.placed.length);
    moves.indices.forEach((i, k) => {
      if (i < layout.placed.length) this.poses_.set(poseAt(moves.poses, k), kPoseNumbers * i);
    });
    this.away_ = away;
    return back.length === 0 ? away : [...new Set([...back, ...away])];
  }

  /** Of meshes that no object of the layout has: of a scene that is on its way. */
  ahead(): Ahead {
    const placed = new Set(this.layout_?.placed.map(({ mesh }) => mesh));
    const coming = [...this.meshes_.values()].filter(({ number }) => !placed.has(number)).map(countsOf);
    const sum = (of: keyof Ahead) => coming.reduce((total, mesh) => total + mesh[of], 0);
    return { triangles: sum("triangles"), points: sum("points") };
  }

  /** Of everything in the layout, each object counted. */
  counts(): Counts {
    const counts = { objects: this.layout_?.placed.length ?? 0, triangles: 0, segments: 0, points: 0 };
    for (const { mesh: number } of this.layout_?.placed ?? []) {
      const mesh = this.meshes_.get(number);
      if (mesh !== undefined) {
        const { triangles, segments, points } = countsOf(mesh);
        counts.triangles += triangles;
        counts.segments += segments;
        counts.points += points;
      }
    }
    return counts;
  }
}

/** The triangles of a cloud are how its points are drawn. */
function countsOf({ triangles, segments, points, cloudPoints }: Mesh): Omit<Counts, "objects"> {
  return {
    triangles: cloudPoints === undefined ? triangles.length / 3 : 0,
    segments: segments.length / 2,
    points: cloudPoints ?? points.length,
  };
}

function poseAt(poses: Float32Array, i: number): Float32Array {
  return poses.subarray(kPoseNumbers * i, kPoseNumbers * (i + 1));
}
