// Everything that can be touched, in three.js: a view for each mesh, with its places from the layout and moved by the
// states. What the proxy touches has a tint, when there is more than one object to distinguish.

import * as THREE from "three";
import type { PlacedMesh } from "./gen/hl_pb";
import { MeshView, type Highlight, type Meeting, type Palette } from "./mesh_view";
import type { Accept } from "./ray_tree";
import type { Bounds, Layout, Mesh } from "./scene_messages";
import type { Section } from "./section";
import { themeColour } from "./theme";
import type { Vec } from "./vec";

/** Above this, drawing every mesh edge would only fill the screen and the memory. */
const kEdgesMaxTriangles = 2_000_000;
const kPointSize_px = 4;

interface Placed {
  readonly view: MeshView;
  readonly place: number;
}

/** With the index into the layout. */
export type ObjectMeeting = Meeting & { readonly object: number };

export class ModelView {
  readonly group = new THREE.Group();
  private readonly views_ = new Map<number, MeshView>();
  private readonly palette_: Palette = makePalette();
  /** By index into the layout; undefined where its mesh is not known. */
  private placed_: (Placed | undefined)[] = [];
  private touched_: readonly number[] = [];
  private pointed_: number | undefined;
  private clip_: THREE.Plane[] = [];
  private triangles_ = 0;
  private flat_ = false;
  private showEdges_ = false;

  add(mesh: Mesh): void {
    this.drop(mesh.number);
    const view = new MeshView(mesh, this.palette_);
    view.setFlat(this.flat_);
    view.setClip(this.clip_);
    this.views_.set(mesh.number, view);
    this.group.add(view.group);
  }

  forget(meshes: readonly number[]): void {
    meshes.forEach((number) => this.drop(number));
  }

  clear(): void {
    this.forget([...this.views_.keys()]);
    this.placed_ = [];
    this.touched_ = [];
    this.triangles_ = 0;
  }

  setLayout(layout: Layout, poses: Float32Array): void {
    this.mark(this.touched_, "none");
    this.touched_ = [];
    this.setPointed(undefined);
    const counts = new Map<MeshView, number>();
    this.placed_ = layout.placed.map(({ mesh }) => {
      const view = this.views_.get(mesh);
      if (view === undefined) {
        return undefined;
      }
      const place = counts.get(view) ?? 0;
      counts.set(view, place + 1);
      return { view, place };
    });
    this.triangles_ = 0;
    for (const view of this.views_.values()) {
      const count = counts.get(view) ?? 0;
      view.setCount(count);
      this.triangles_ += view.triangles * count;
    }
    this.placed_.forEach((placed, i) => placed?.view.setColour(placed.place, colourOf(layout.placed[i]!)));
    this.move(layout.placed.keys(), poses);
    this.applyEdges();
  }

  /** Objects of the layout take the poses they have in `poses`. */
  move(indices: Iterable<number>, poses: Float32Array): void {
    for (const i of indices) {
      const placed = this.placed_[i];
      placed?.view.setPose(placed.place, poses, i);
    }
  }

  /** Shows which objects of the layout are touched, and which are no more. */
  setTouched(indices: readonly number[]): void {
    const now = this.placed_.length > 1 ? indices : [];
    if (now.length !== this.touched_.length || now.some((index, i) => index !== this.touched_[i])) {
      this.mark(this.touched_, "none");
      this.mark(now, "touched");
      this.touched_ = [...now];
      this.showPointed();
    }
  }

  /** Shows which object of several the pointer is on. */
  setPointed(object: number | undefined): void {
    if (object === this.pointed_) {
      return;
    }
    if (this.pointed_ !== undefined && !this.touched_.includes(this.pointed_)) {
      this.mark([this.pointed_], "none");
    }
    this.pointed_ = object;
    this.showPointed();
  }

  /** Draws only what the section leaves; all of it when there is none. */
  setSection(section: Section | undefined): void {
    const { palette_: palette } = this;
    this.clip_ = section === undefined ? [] : [planeOf(section)];
    const { edges, lines, points, touchedLines, touchedPoints } = palette;
    for (const material of [edges, lines, points, touchedLines, touchedPoints]) {
      material.clippingPlanes = this.clip_;
    }
    this.views_.forEach((view) => view.setClip(this.clip_));
  }

  /** Facets instead of interpolated normals; what has no normals is always shown so. */
  setFlat(flat: boolean): void {
    this.flat_ = flat;
    this.views_.forEach((view) => view.setFlat(flat));
  }

  setEdges(shown: boolean): void {
    this.showEdges_ = shown;
    this.applyEdges();
  }

  applyTheme(): void {
    const { model, tint, pointed, edges, lines, points, touchedLines, touchedPoints } = this.palette_;
    model.set(themeColour("model"));
    const touched = new THREE.Color(themeColour("model-touched"));
    tint.setRGB(touched.r / model.r, touched.g / model.g, touched.b / model.b);
    edges.color.set(themeColour("model-edge"));
    lines.color.set(themeColour("model-line"));
    points.color.set(themeColour("model-line"));
    touchedLines.color.set(themeColour("accent"));
    touchedPoints.color.set(themeColour("accent"));
    this.views_.forEach((view) => view.applyTheme());
    const under = new THREE.Color(themeColour("model-pointed"));
    pointed.setRGB(under.r / model.r, under.g / model.g, under.b / model.b);
    this.mark(this.touched_, "touched");
    this.showPointed();
  }

  /**
   * Where a ray first meets a surface, and of which object: within `farthest` lengths of `direction`, at a point of the
   * world that `accept` takes.
   */
  cast(origin: Vec, direction: Vec, farthest = Infinity, accept?: Accept): ObjectMeeting | undefined {
    let best: ObjectMeeting | undefined;
    this.placed_.forEach((placed, object) => {
      const met = placed?.view.cast(placed.place, origin, direction, best?.distance ?? farthest, accept);
      best = met === undefined ? best : { ...met, object };
    });
    return best;
  }

  /** Of everything where it is now; undefined when there is nothing. */
  bounds(poses: Float32Array): Bounds | undefined {
    const box = new THREE.Box3();
    this.placed_.forEach((placed, i) => placed?.view.addBounds(box, poses, i));
    const plain = ({ x, y, z }: THREE.Vector3) => ({ x, y, z });
    return box.isEmpty() ? undefined : { min: plain(box.min), max: plain(box.max) };
  }

  private mark(indices: readonly number[], mark: Highlight): void {
    for (const i of indices) {
      const placed = this.placed_[i];
      placed?.view.setMark(placed.place, mark);
    }
  }

  private showPointed(): void {
    if (this.pointed_ !== undefined && this.placed_.length > 1 && !this.touched_.includes(this.pointed_)) {
      this.mark([this.pointed_], "pointed");
    }
  }

  private applyEdges(): void {
    const shown = this.showEdges_ && this.triangles_ <= kEdgesMaxTriangles;
    this.views_.forEach((view) => view.setEdges(shown));
  }

  private drop(number: number): void {
    this.views_.get(number)?.dispose();
    this.views_.delete(number);
  }
}

/** Of an object that has one of its own. */
function colourOf({ colour }: Pick<PlacedMesh, "colour">): THREE.Color | undefined {
  const [red, green, blue] = colour ?? [];
  return blue === undefined
    ? undefined
    : new THREE.Color().setRGB(red! / 255, green! / 255, blue / 255, THREE.SRGBColorSpace);
}

function planeOf({ normal, constant_m }: Section): THREE.Plane {
  return new THREE.Plane(new THREE.Vector3(normal.x, normal.y, normal.z), constant_m);
}

function makePalette(): Palette {
  const point = { size: kPointSize_px, sizeAttenuation: false };
  return {
    model: new THREE.Color(),
    tint: new THREE.Color(),
    pointed: new THREE.Color(),
    edges: new THREE.MeshBasicMaterial({ wireframe: true, transparent: true, opacity: 0.22 }),
    lines: new THREE.LineBasicMaterial(),
    points: new THREE.PointsMaterial(point),
    touchedLines: new THREE.LineBasicMaterial(),
    touchedPoints: new THREE.PointsMaterial({ ...point, size: 1.5 * kPointSize_px }),
  };
}
