// A name that floats above a hand in the scene and faces the camera, at a fixed size on the screen.

import * as THREE from "three";

const kHeight_px = 16;
const kText_px = 48;
const kPad_px = 12;
/** Above the hand, in heights of the label. */
const kAbove = 1.6;

export class NameLabel {
  readonly sprite: THREE.Sprite;
  private readonly canvas_ = document.createElement("canvas");
  private shown_ = "";

  constructor() {
    const map = new THREE.CanvasTexture(this.canvas_);
    map.colorSpace = THREE.SRGBColorSpace;
    this.sprite = new THREE.Sprite(new THREE.SpriteMaterial({ map, depthTest: false, depthWrite: false }));
    this.sprite.center.set(0.5, -kAbove);
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

  /** `metresPerPixel` where it is. */
  setSize(metresPerPixel: number): void {
    const height_m = kHeight_px * metresPerPixel;
    this.sprite.scale.set((height_m * this.canvas_.width) / Math.max(1, this.canvas_.height), height_m, 1);
  }

  dispose(): void {
    this.sprite.material.map?.dispose();
    this.sprite.material.dispose();
  }
}
