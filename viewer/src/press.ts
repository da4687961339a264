// A press on the model: where the simulated hand has to want to be, so that the proxy touches what is under the
// pointer. First the way there, around whatever is in between, then into the surface, then along it with the pointer.
//
//   goal = hit - depth n        force = depth / (1 / K + 1 / k_arm + 1 / k_pad)
//
// A proxy on a surface that is curved away from it, as on a ball of radius R, would roll off from above a goal beyond
// the middle: there is a deepest goal that holds it in place (touch_aim.ts), and wheel, Shift and second finger end there.
// With the spring K of the servo and the springs of the arm and the fingerpad of the simulated hand: 200 and 300 N/m
// for its light grip, 400 and 800 N/m for the firm one. K = 1000 N/m makes a depth of 12 mm 1.3 N and 2.5 N.

import { beside, Walk } from "./route";
import { dot, length, scale, sub, type Vec } from "./vec";

/** What is under the pointer. World frame. */
export interface SurfaceHit {
  readonly point: Vec;
  /** Unit, on the side that is seen. */
  readonly normal: Vec;
  /** How far the back is beneath the surface, m; infinite when nothing is behind. */
  readonly thickness_m: number;
  /** Index into the layout. */
  readonly object: number;
  /** Number of its material there. */
  readonly material: number;
}

/** Depth beneath the surface, m at the hand: that of the exploring hand. */
export const kPress_D = 0.012;
/** Nor deeper than this part of what is pressed: a goal beyond the middle of a handle lets the proxy slip around it. */
const kThicknessPart = 0.4;
/** But at least this, m at the hand, so that a force is felt on thin things too: 0.3 N by a light grip. */
const kPressLeast_D = 0.003;
/** What is pressed deeper goes to this part of the deepest goal that holds the proxy in place. */
const kSteadyPart = 0.8;
/** The hand comes to a place this far above the surface first, m at the hand. */
export const kAbove_D = 0.01;
/** It aims this far ahead on its way, m at the hand: then it goes at its full 0.3 m/s. */
const kLead_D = 0.03;
/** The place above the surface is reached within this, m at the hand. */
const kReached_D = 0.006;
/** A drag that jumps farther than this is a new press: what is under the pointer is another part. */
const kJump_D = 0.025;
/** Limits of what wheel, Shift and second finger add to the depth, m at the hand. */
const kLift_D = -0.04;
const kPush_D = 0.04;
/** A hand that has come no farther for so long is held by something: it goes straight. */
const kHeld_ms = 1000;
/** Of that a drawn frame counts at most this: a busy page, which draws seldom, learns late how far the hand has come. */
const kFrame_ms = 50;

/** A hand led along a way until it is there, or held by something. */
export class Errand {
  private readonly walk_: Walk;
  private readonly world_per_hand_: number;
  private came_m_ = 0;
  private held_ms_ = 0;
  private asked_ms_: number | undefined;
  private ended_ = false;

  constructor(worldPerHand: number, way: readonly Vec[]) {
    this.world_per_hand_ = worldPerHand;
    this.walk_ = new Walk(way);
  }

  get ended(): boolean {
    return this.ended_;
  }

  /** What the hand has to want now, when the proxy is at `proxy`. Once per drawn frame. */
  goal(proxy: Vec, now_ms: number): Vec {
    const next = this.walk_.next(proxy, kLead_D * this.world_per_hand_);
    const frame_ms = Math.min(now_ms - (this.asked_ms_ ?? now_ms), kFrame_ms);
    this.held_ms_ = this.walk_.done_m > this.came_m_ ? 0 : this.held_ms_ + frame_ms;
    this.came_m_ = Math.max(this.came_m_, this.walk_.done_m);
    this.asked_ms_ = now_ms;
    const there = length(sub(proxy, this.walk_.end)) < kReached_D * this.world_per_hand_;
    this.ended_ ||= there || this.held_ms_ > kHeld_ms;
    return next;
  }
}

/** What a press has to know of the scene. */
export interface PressAim {
  /** The way of the hand to a place. */
  plan(to: Vec): Vec[];
  /** The deepest goal beneath a place that holds the proxy there, m; infinite where any does. */
  steady(hit: SurfaceHit): number;
}

export class Press {
  private readonly world_per_hand_: number;
  private readonly aim_: PressAim;
  private hit_: SurfaceHit;
  /** The deepest goal beneath what is pressed that holds the proxy in place, m. */
  private steady_m_: number;
  private deeper_m_ = 0;
  /** Where the hand is to be while the pointer is beside the model. */
  private beside_: Vec | undefined;
  private way_: Errand | undefined;

  constructor(worldPerHand: number, hit: SurfaceHit, aim: PressAim) {
    this.world_per_hand_ = worldPerHand;
    this.aim_ = aim;
    this.hit_ = hit;
    this.steady_m_ = aim.steady(hit);
    this.approach();
  }

  /** True while the hand is on its way. */
  get coming(): boolean {
    return this.way_ !== undefined;
  }

  /** What is pressed. */
  get hit(): SurfaceHit {
    return this.hit_;
  }

  /** Where the hand has to want to be to touch what is pressed. */
  get pressed(): Vec {
    const { hit_: hit } = this;
    return beside(hit.point, scale(hit.normal, -1), this.depth_m + Math.min(this.deeper_m_, this.deepest_m));
  }

  /** Before it is pressed deeper. */
  private get depth_m(): number {
    const { world_per_hand_: scaled, hit_: hit } = this;
    return Math.min(kPress_D * scaled, Math.max(kThicknessPart * hit.thickness_m, kPressLeast_D * scaled));
  }

  /** What it may be pressed deeper by. */
  private get deepest_m(): number {
    return Math.min(kPush_D * this.world_per_hand_, Math.max(0, kSteadyPart * this.steady_m_ - this.depth_m));
  }

  /** The pointer is over another point. */
  slide(hit: SurfaceHit): void {
    const jumped = length(sub(hit.point, this.beside_ ?? this.hit_.point)) > kJump_D * this.world_per_hand_;
    this.hit_ = hit;
    this.steady_m_ = this.aim_.steady(hit);
    this.beside_ = undefined;
    if (jumped || this.coming) {
      this.approach();
    }
  }

  /** The pointer is beside the model: the hand goes there. */
  leave(place: Vec): void {
    this.beside_ = place;
    this.way_ = undefined;
  }

  deepen(distance_m: number): void {
    const before_m = Math.min(this.deeper_m_, this.deepest_m);
    this.deeper_m_ = Math.min(this.deepest_m, Math.max(kLift_D * this.world_per_hand_, before_m + distance_m));
  }

  /** What the hand has to want now, when the proxy is at `proxy`. */
  goal(proxy: Vec, now_ms: number): Vec {
    const way = this.way_;
    if (way === undefined) {
      return this.beside_ ?? this.pressed;
    }
    const next = way.goal(proxy, now_ms);
    if (way.ended || this.isNear(proxy)) {
      this.way_ = undefined;
      return this.pressed;
    }
    return next;
  }

  /** Already so near to the surface, on its seen side, that there is nothing to go around. */
  private isNear(proxy: Vec): boolean {
    const offset = sub(proxy, this.hit_.point);
    return length(offset) < kAbove_D * this.world_per_hand_ && dot(offset, this.hit_.normal) > 0;
  }

  private approach(): void {
    const above = beside(this.hit_.point, this.hit_.normal, kAbove_D * this.world_per_hand_);
    this.way_ = new Errand(this.world_per_hand_, this.aim_.plan(above));
  }
}
