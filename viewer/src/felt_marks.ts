// Marks of what is felt and not seen: snaps, the one that holds the proxy, force fields, joints.

import * as THREE from "three";
import { diagonalOf } from "./fit";
import { fieldLines, snapLines } from "./place_lines";
import { jointLines } from "./joint_lines";
import { kWorld, LineSet, piecesOf, type Piece } from "./line_set";
import type { PlacedJoint } from "./gen/hl_pb";
import { inverse, kIdentity, moved, vecOf, type Rigid } from "./rigid";
import type { Layout } from "./scene_messages";
import type { Vec } from "./vec";
import { floats } from "./wire_values";

/** Half an axis, and half the side of a plane, as a part of the scene's diagonal. */
const kSizePart = 0.05;
/** If the scene has no extent, m. */
const kSize_m = 0.005;

export class FeltMarks {
  readonly group = new THREE.Group();
  private readonly snaps_ = new LineSet("snap", 0.5);
  private readonly held_ = new LineSet("held", 1);
  private readonly fields_ = new LineSet("field", 0.35);
  private readonly joints_ = new LineSet("joint", 0.55);
  private readonly sets_ = [this.snaps_, this.held_, this.fields_, this.joints_];
  /** By number. */
  private snapPieces_: readonly Piece[][] = [];
  private heldNumber_: number | undefined;
  private poses_: Float32Array = new Float32Array();

  constructor() {
    // Over the proxy, which is larger than a point that holds it.
    this.held_.lines.renderOrder = 2;
    this.group.add(...this.sets_.map((set) => set.lines));
  }

  /** Index of the snap that holds the proxy, among those of the layout. */
  get held(): number | undefined {
    return this.heldNumber_;
  }

  setShown(shown: boolean): void {
    this.group.visible = shown;
  }

  applyTheme(): void {
    this.sets_.forEach((set) => set.applyTheme());
  }

  setLayout(layout: Layout, poses: Float32Array): void {
    const size_m = layout.bounds === undefined ? kSize_m : kSizePart * diagonalOf(layout.bounds);
    this.poses_ = poses;
    this.heldNumber_ = undefined;
    this.held_.set([], poses);
    this.snapPieces_ = (layout.felt?.snaps ?? []).map((snap) =>
      snapLines(snap, size_m).flatMap((line) => piecesOf(line, snap.placed)));
    this.snaps_.set(this.snapPieces_.flat(), poses);
    const fields = (layout.felt?.fields ?? []).flatMap((field) =>
      fieldLines(field, size_m).flatMap((line) => piecesOf(line, field.placed)));
    this.fields_.set(fields, poses);
    const joints = (layout.mechanics?.joints ?? []).flatMap((joint) => jointPieces(joint, layout, size_m));
    this.joints_.set(joints, poses);
  }

  clear(): void {
    this.sets_.forEach((set) => set.set([], this.poses_));
    this.snapPieces_ = [];
    this.heldNumber_ = undefined;
  }

  /** Objects are elsewhere. */
  move(poses: Float32Array): void {
    this.poses_ = poses;
    this.sets_.forEach((set) => set.move(poses));
  }

  /** Index of a snap of the layout; undefined: none holds the proxy. */
  setHeld(snap: number | undefined): void {
    const known = snap !== undefined && snap < this.snapPieces_.length ? snap : undefined;
    if (known !== this.heldNumber_) {
      this.heldNumber_ = known;
      this.held_.set(known === undefined ? [] : this.snapPieces_[known]!, this.poses_);
    }
  }
}

/** From the world with bodies at their start into the frames of the bodies. */
function jointPieces({ joint, bodyA, bodyB = kWorld }: PlacedJoint, { placed }: Layout, size_m: number): Piece[] {
  const startOf = (body: number): Rigid => (body === kWorld ? kIdentity : floats(placed[body]!.start, "start"));
  const start = startOf(bodyA);
  const [intoA, intoB] = [inverse(start), inverse(startOf(bodyB))];
  const into = (frame: Rigid, place: Vec): Vec => vecOf(moved(frame, place));
  const { ofA, ofB, between } = jointLines(joint!, { x: start[3]!, y: start[7]!, z: start[11]! }, size_m);
  const pieces = [
    ...ofA.flatMap((line) => piecesOf(line.map((place) => into(intoA, place)), bodyA)),
    ...ofB.flatMap((line) => piecesOf(line.map((place) => into(intoB, place)), bodyB)),
  ];
  return between === undefined ? pieces : [...pieces, [
    { frame: bodyA, place: into(intoA, between[0]) }, { frame: bodyB, place: into(intoB, between[1]) },
  ]];
}
