// A name beside a hand in the scene that faces the camera, at a fixed size on the screen.

import * as THREE from "three";
import { kName_px, type Point } from "./name_places";
import type { Vec } from "./vec";

const kText_px = 48;
const kPad_px = 12;

export class NameLabel {
  readonly sprite: THREE.Sprite;
  private readonly canvas_ = document.createElement("canvas");
  private shown_ = "";

  constructor() {
    const map = new THREE.CanvasTexture(this.canvas_);
    map.colorSpace = THREE.SRGBColorSpace;
    this.sprite = new THREE.Sprite(new THREE.SpriteMaterial({ map, depthTest: false, depthWrite: false }));
    this.sprite.renderOrder = 4;
  }

  /** `ground`: what the letters stand on, so that they are read before anything. */
  setText(text: string, colour: string, ground: string): void {
    if (this.shown_ === text + colour + ground) return;
    this.shown_ = text + colour + ground;
    const context = this.canvas_.getContext("2d");
    if (context === null) return;
    const font = `600 ${kText_px}px system-ui, sans-serif`;
    context.font = font;
    this.canvas_.width = Math.ceil(context.measureText(text).width) + 2 * kPad_px;
    this.canvas_.height = kText_px + 2 * kPad_px;
    context.font = font;
    context.textBaseline = "middle";
    context.lineJoin = "round";
    context.lineWidth = kPad_px;
    context.strokeStyle = ground;
    context.strokeText(text, kPad_px, this.canvas_.height / 2);
    context.fillStyle = colour;
    context.fillText(text, kPad_px, this.canvas_.height / 2);
    // Its size may be another one: the texture is made anew.
    this.sprite.material.map!.dispose();
    this.sprite.material.map!.needsUpdate = true;
  }

  get width_px(): number {
    return (kName_px * this.canvas_.width) / Math.max(1, this.canvas_.height);
  }

  /** At a hand: `place` from there to the middle of the name, pixels, y downward; `metresPerPixel` there. */
  stand(hand: Vec, place: Point, metresPerPixel: number): void {
    this.sprite.position.set(hand.x, hand.y, hand.z);
    this.sprite.center.set(0.5 - place.x / Math.max(1, this.width_px), 0.5 + place.y / kName_px);
    this.sprite.scale.set(this.width_px * metresPerPixel, kName_px * metresPerPixel, 1);
  }
}
