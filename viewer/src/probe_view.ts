// What touches the model: the proxy as the sphere the user sees, in its true size, with a thin ring when that would be
// too small to find; the finger as a faint mark behind everything; the line between; the force as an arrow; and the
// contact planes.

import * as THREE from "three";
import type { ContactPlane, State } from "./gen/hl_pb";
import { DropLine } from "./drop_line";
import { FrictionCones } from "./friction_cones";
import { overlay } from "./overlay";
import { StylusView } from "./stylus_view";
import { themeColour } from "./theme";
import { kZero, length, type Vec } from "./vec";
import { knownVec } from "./wire_values";

/** The device's peak force is drawn this long, as a share of the model's diagonal. */
const kArrowShare = 0.35;
/** A force above the peak is drawn no longer than this many times the peak. */
const kArrowMost = 1.5;
/** Below this force nothing is drawn: quantisation noise of a free hand. */
const kArrowMin_N = 0.02;
const kPlanesMax = 8;
const kPlaneShare = 0.05;
const kRing_px = 13;
const kFinger_px = 5;

export class ProbeView {
  readonly group = new THREE.Group();
  readonly cones = new FrictionCones();
  readonly drop = new DropLine();
  readonly stylus = new StylusView();
  private readonly proxy_: THREE.Mesh<THREE.SphereGeometry, THREE.MeshStandardMaterial>;
  private readonly ghost_: THREE.Mesh<THREE.SphereGeometry, THREE.MeshBasicMaterial>;
  private readonly ring_: THREE.Mesh<THREE.RingGeometry, THREE.MeshBasicMaterial>;
  private readonly finger_: THREE.Mesh<THREE.SphereGeometry, THREE.MeshBasicMaterial>;
  private readonly line_: THREE.Line<THREE.BufferGeometry, THREE.LineBasicMaterial>;
  private readonly arrow_ = new THREE.Group();
  private readonly shaft_: THREE.Mesh<THREE.CylinderGeometry, THREE.MeshBasicMaterial>;
  private readonly tip_: THREE.Mesh<THREE.ConeGeometry, THREE.MeshBasicMaterial>;
  private readonly planes_: THREE.Group[] = [];
  private readonly planeFill_ = overlay(THREE.MeshBasicMaterial, 0.28, true);
  private readonly planeRim_ = overlay(THREE.LineBasicMaterial, 0.9, true);
  private diagonal_m_ = 1;
  private radius_m_ = 0;
  private hasProxy_ = false;
  private forceMax_N_ = 10;
  private showPlanes_ = false;
  private colour_: string | undefined;
  private aside_ = false;

  constructor() {
    const sphere = new THREE.SphereGeometry(1, 32, 20);
    this.proxy_ = new THREE.Mesh(sphere, new THREE.MeshStandardMaterial({ roughness: 0.35 }));
    // Drawn after the finger, which would hide it otherwise.
    this.proxy_.material.transparent = true;
    this.proxy_.renderOrder = 1;
    this.ghost_ = new THREE.Mesh(sphere, overlay(THREE.MeshBasicMaterial, 0.35));
    this.ring_ = new THREE.Mesh(new THREE.RingGeometry(0.86, 1, 48), overlay(THREE.MeshBasicMaterial, 0.7));
    this.finger_ = new THREE.Mesh(new THREE.SphereGeometry(1, 16, 12), overlay(THREE.MeshBasicMaterial, 0.55));
    const ends = new THREE.BufferGeometry().setAttribute("position", new THREE.BufferAttribute(new Float32Array(6), 3));
    this.line_ = new THREE.Line(ends, overlay(THREE.LineBasicMaterial, 0.6));
    this.line_.frustumCulled = false;
    const arrowMaterial = new THREE.MeshBasicMaterial();
    this.shaft_ = new THREE.Mesh(new THREE.CylinderGeometry(1, 1, 1, 16).translate(0, 0.5, 0), arrowMaterial);
    this.tip_ = new THREE.Mesh(new THREE.ConeGeometry(1, 1, 20).translate(0, 0.5, 0), arrowMaterial);
    this.arrow_.add(this.shaft_, this.tip_);
    this.group.add(this.proxy_, this.ghost_, this.ring_, this.finger_, this.line_, this.arrow_, this.cones.group, this.drop.group, this.stylus.group);
    for (let i = 0; i < kPlanesMax; ++i) {
      this.planes_.push(this.makePlane());
    }
    this.group.visible = false;
  }

  /** Of what the camera shows: arrows and planes are drawn in proportion to it. */
  setDiagonal(diagonal_m: number): void {
    this.diagonal_m_ = diagonal_m;
    this.cones.setScene(diagonal_m);
    this.stylus.setDiagonal(diagonal_m);
  }

  setRadius(proxyRadius_m: number): void {
    this.radius_m_ = proxyRadius_m > 0 ? proxyRadius_m : this.diagonal_m_ * 2e-3;
    this.proxy_.scale.setScalar(this.radius_m_);
    this.ghost_.scale.setScalar(this.radius_m_);
  }

  get radius_m(): number {
    return this.radius_m_;
  }

  setForceMax(force_N: number): void {
    this.forceMax_N_ = force_N > 0 ? force_N : 10;
  }

  setStylusShown(shown: boolean): void {
    this.stylus.setShown(shown);
  }

  setPlanesShown(shown: boolean): void {
    this.showPlanes_ = shown;
  }

  /** In the place of the theme's, for proxy and ring. */
  setColour(colour: string): void {
    if (this.colour_ === colour) return;
    this.colour_ = colour;
    this.applyTheme();
  }

  /** Set when the page moves another hand: proxy and ring are drawn as the finger is. */
  setAside(aside: boolean): void {
    if (this.aside_ === aside) return;
    this.aside_ = aside;
    this.applyTheme();
  }

  applyTheme(): void {
    this.cones.applyTheme();
    this.drop.applyTheme();
    this.stylus.applyTheme();
    const colour = this.colour_ ?? themeColour(this.aside_ ? "finger" : "proxy");
    this.proxy_.material.color.set(colour);
    this.proxy_.material.emissive.set(colour).multiplyScalar(0.35);
    this.ghost_.material.color.set(colour);
    this.ring_.material.color.set(colour);
    this.finger_.material.color.set(themeColour("finger"));
    this.line_.material.color.set(themeColour("finger"));
    this.shaft_.material.color.set(themeColour("force"));
    this.planeFill_.color.set(themeColour("plane"));
    this.planeRim_.color.set(themeColour("plane"));
  }

  /** Shows one state of the server. Without a proxy, as in a black box, the force is shown at the finger. */
  update(state: State | undefined): void {
    const finger = knownVec(state?.finger);
    this.group.visible = finger !== undefined;
    if (state === undefined || finger === undefined) {
      return;
    }
    const known = knownVec(state.proxy);
    this.hasProxy_ = known !== undefined;
    for (const mark of [this.proxy_, this.ghost_, this.line_]) {
      mark.visible = this.hasProxy_;
    }
    if (!this.hasProxy_) this.drop.group.visible = false;
    const proxy = known ?? finger;
    for (const mesh of [this.proxy_, this.ghost_, this.ring_]) {
      mesh.position.set(proxy.x, proxy.y, proxy.z);
    }
    this.finger_.position.set(finger.x, finger.y, finger.z);
    const ends = this.line_.geometry.getAttribute("position") as THREE.BufferAttribute;
    ends.setXYZ(0, proxy.x, proxy.y, proxy.z).setXYZ(1, finger.x, finger.y, finger.z);
    ends.needsUpdate = true;
    const force_N = knownVec(state.forceN) ?? kZero;
    this.stylus.update(proxy, state.stylus);
    this.updateArrow(proxy, force_N);
    this.cones.update(state.contacts, state.slipping, this.arrowLength_m(length(force_N)));
    this.planes_.forEach((plane, i) => this.updatePlane(plane, state.contacts[i]));
  }

  /** Keeps marks at their size in pixels; `metresPerPixel` at the proxy, or the finger. Once per drawn frame. */
  face(camera: THREE.Camera, metresPerPixel: number): void {
    this.ring_.quaternion.copy(camera.quaternion);
    this.ring_.scale.setScalar(kRing_px * metresPerPixel);
    this.ring_.visible = this.hasProxy_ && this.radius_m_ < 0.7 * kRing_px * metresPerPixel;
    this.finger_.scale.setScalar(kFinger_px * metresPerPixel);
  }

  private arrowLength_m(magnitude_N: number): number {
    return Math.min(magnitude_N / this.forceMax_N_, kArrowMost) * kArrowShare * this.diagonal_m_;
  }

  private updateArrow(proxy: Vec, force_N: Vec): void {
    const force = new THREE.Vector3(force_N.x, force_N.y, force_N.z);
    const magnitude_N = force.length();
    this.arrow_.visible = magnitude_N > kArrowMin_N;
    if (!this.arrow_.visible) {
      return;
    }
    const whole = this.arrowLength_m(magnitude_N);
    const thickness = 0.0045 * this.diagonal_m_;
    const head = Math.min(whole * 0.5, 6 * thickness);
    this.arrow_.position.set(proxy.x, proxy.y, proxy.z);
    this.arrow_.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), force.normalize());
    this.shaft_.scale.set(thickness, whole - head, thickness);
    this.tip_.position.y = whole - head;
    this.tip_.scale.set(head * 0.4, head, head * 0.4);
  }

  private updatePlane(plane: THREE.Group, contact: ContactPlane | undefined): void {
    const point = knownVec(contact?.point);
    const normal = knownVec(contact?.normal);
    plane.visible = this.showPlanes_ && point !== undefined && normal !== undefined;
    if (!plane.visible || point === undefined || normal === undefined) {
      return;
    }
    plane.position.set(point.x, point.y, point.z);
    plane.quaternion.setFromUnitVectors(
      new THREE.Vector3(0, 0, 1),
      new THREE.Vector3(normal.x, normal.y, normal.z).normalize(),
    );
    plane.scale.setScalar(kPlaneShare * this.diagonal_m_);
  }

  /** A disc of radius 1 with a rim and a stick along its normal. */
  private makePlane(): THREE.Group {
    const plane = new THREE.Group();
    const rim: THREE.Vector3[] = [];
    for (let i = 0; i < 64; ++i) {
      rim.push(new THREE.Vector3(Math.cos((i * Math.PI) / 32), Math.sin((i * Math.PI) / 32), 0));
    }
    const stick = [new THREE.Vector3(0, 0, 0), new THREE.Vector3(0, 0, 0.6)];
    plane.add(
      new THREE.Mesh(new THREE.CircleGeometry(1, 64), this.planeFill_),
      new THREE.LineLoop(new THREE.BufferGeometry().setFromPoints(rim), this.planeRim_),
      new THREE.Line(new THREE.BufferGeometry().setFromPoints(stick), this.planeRim_),
    );
    plane.visible = false;
    this.group.add(plane);
    return plane;
  }
}
