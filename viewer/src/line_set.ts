// Lines that move with the objects of a layout, in one drawing call: each end of a piece is a place in the frame of an
// object, or of the world.

import * as THREE from "three";
import type { Line } from "./lines";
import { overlay } from "./overlay";
import { kPoseNumbers } from "./scene_messages";
import { themeColour } from "./theme";
import type { Vec } from "./vec";

/** In the place of an object's index. */
export const kWorld = -1;

/** A place in the frame of an object. */
export interface FramedPlace {
  readonly frame: number;
  readonly place: Vec;
}
export type Piece = readonly [FramedPlace, FramedPlace];

/** A line of one object, as pieces. */
export function piecesOf(line: Line, frame: number): Piece[] {
  return line.slice(1).map((to, i) => [{ frame, place: line[i]! }, { frame, place: to }]);
}

/** World places of the ends of the pieces, three numbers each, into `out`. */
export function placeEnds(ends: readonly FramedPlace[], poses: Float32Array, out: Float32Array): void {
  ends.forEach(({ frame, place: { x, y, z } }, i) => {
    if (frame === kWorld) {
      out.set([x, y, z], 3 * i);
      return;
    }
    for (let row = 0; row < 3; ++row) {
      const at = kPoseNumbers * frame + 4 * row;
      out[3 * i + row] = poses[at]! * x + poses[at + 1]! * y + poses[at + 2]! * z + poses[at + 3]!;
    }
  });
}

export class LineSet {
  readonly lines: THREE.LineSegments<THREE.BufferGeometry, THREE.LineBasicMaterial>;
  private readonly colour_: string;
  private ends_: readonly FramedPlace[] = [];

  /** `colour`: its name in the style sheet. */
  constructor(colour: string, opacity: number) {
    this.colour_ = colour;
    this.lines = new THREE.LineSegments(new THREE.BufferGeometry(), overlay(THREE.LineBasicMaterial, opacity));
    this.lines.frustumCulled = false;
  }

  get pieces(): number {
    return this.ends_.length / 2;
  }

  set(pieces: readonly Piece[], poses: Float32Array): void {
    this.ends_ = pieces.flat();
    this.lines.geometry.dispose();
    const places = new THREE.BufferAttribute(new Float32Array(3 * this.ends_.length), 3);
    this.lines.geometry = new THREE.BufferGeometry().setAttribute("position", places);
    this.lines.visible = this.ends_.length > 0;
    this.move(poses);
  }

  /** To where the objects are now. */
  move(poses: Float32Array): void {
    if (this.ends_.length === 0) {
      return;
    }
    const places = this.lines.geometry.getAttribute("position") as THREE.BufferAttribute;
    placeEnds(this.ends_, poses, places.array as Float32Array);
    places.needsUpdate = true;
  }

  applyTheme(): void {
    this.lines.material.color.set(themeColour(this.colour_));
  }
}
