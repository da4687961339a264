// The stage: renderer, camera, lights and floor. The camera is centred in the part of the window that the panels leave
// free. Device axes are screen axes at the start: x right, y up, z toward the user.

import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { Rect } from "./edge_mark";
import { depthOf, type ViewFrame } from "./hand_mapping";
import { themeColour } from "./theme";
import type { Vec } from "./vec";

const kFovY_deg = 35;
/** Sharper than this costs more than anyone sees. */
const kPixelRatioMax = 2;

/** The camera's own motion after a gesture dies away in this time constant. */
const kDamping_ms = 100;

/** Pixels at the window's edges that are covered by panels. */
export interface Insets {
  readonly left: number;
  readonly right: number;
  readonly top: number;
  readonly bottom: number;
}

export class Stage {
  readonly canvas: HTMLCanvasElement;
  /** Undefined in a browser that cannot draw: all else works. */
  private readonly renderer_: THREE.WebGLRenderer | undefined;
  readonly camera = new THREE.PerspectiveCamera(kFovY_deg, 1, 0.01, 100);
  readonly controls: OrbitControls;
  readonly scene = new THREE.Scene();
  private readonly lights_ = new THREE.Group();
  private floor_: THREE.GridHelper | undefined;
  private centre_ = new THREE.Vector3();
  private diagonal_m_ = 1;
  private insets_: Insets = { left: 0, right: 0, top: 0, bottom: 0 };
  private untouched_ = true;
  private drawn_ms_ = 0;

  /** `cannotDraw` gets why nothing is drawn, and undefined when it is again. */
  constructor(canvas: HTMLCanvasElement, cannotDraw: (reason: string | undefined) => void) {
    this.canvas = canvas;
    this.renderer_ = makeRenderer(canvas);
    if (this.renderer_ === undefined) {
      cannotDraw("This browser cannot draw in 3-D: WebGL is switched off or not there. Numbers and controls work.");
    }
    canvas.addEventListener("webglcontextlost", () => {
      cannotDraw("The browser took the graphics away from this page. Numbers and controls work. Reload to draw again.");
    });
    canvas.addEventListener("webglcontextrestored", () => cannotDraw(undefined));
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = true;
    this.controls.addEventListener("start", () => (this.untouched_ = false));
    this.scene.add(this.camera, ...this.makeLights());
    this.camera.add(this.lights_);
    this.resetView();
  }

  /** Near enough to clip nothing, for the hand too. */
  get near_m(): number {
    return this.camera.near;
  }

  get size_px(): { width: number; height: number } {
    const { canvas } = this;
    return { width: canvas.clientWidth, height: canvas.clientHeight };
  }

  /** The part of the canvas that no panel covers, CSS pixels. */
  get visible(): Rect {
    const { width, height } = this.size_px;
    const { left, right, top, bottom } = this.insets_;
    return { left, top, right: width - right, bottom: height - bottom };
  }

  /** What the view turns about. */
  get target(): Vec {
    return plain(this.controls.target);
  }

  /** Where the floor is beneath a place. */
  floorBelow(place: Vec): Vec | undefined {
    const floor_m = this.floor_?.position.y;
    return floor_m === undefined || place.y < floor_m ? undefined : { ...place, y: floor_m };
  }

  setBounds(boundsMin: Vec, boundsMax: Vec): void {
    const box = new THREE.Box3(
      new THREE.Vector3(boundsMin.x, boundsMin.y, boundsMin.z),
      new THREE.Vector3(boundsMax.x, boundsMax.y, boundsMax.z),
    );
    box.getCenter(this.centre_);
    this.diagonal_m_ = Math.max(box.getSize(new THREE.Vector3()).length(), 1e-6);
    this.rebuildFloor(new THREE.Vector3(this.centre_.x, this.floorUnder(box.min.y), this.centre_.z));
    this.resetView();
  }

  /** Keeps the floor beneath everything; it does not rise again until the next bounds. */
  lowerFloor(lowest_m: number): void {
    if (this.floor_ !== undefined && this.floorUnder(lowest_m) < this.floor_.position.y) {
      this.floor_.position.y = this.floorUnder(lowest_m);
    }
  }

  /** The whole model, a little from above and from the right. */
  resetView(): void {
    this.untouched_ = true;
    const { width, height } = this.free();
    const narrow = Math.min(1, width / height);
    const distance = (0.56 * this.diagonal_m_) / Math.tan(THREE.MathUtils.degToRad(kFovY_deg / 2)) / narrow;
    const { height: full } = this.size_px;
    const direction = new THREE.Vector3(0.32, 0.42, 1).normalize();
    this.controls.target.copy(this.centre_);
    this.camera.position.copy(this.centre_).addScaledVector(direction, distance * Math.max(1, full / height));
    this.camera.near = this.diagonal_m_ * 0.01;
    this.camera.far = this.diagonal_m_ * 60;
    this.controls.minDistance = this.diagonal_m_ * 0.05;
    this.controls.maxDistance = this.diagonal_m_ * 20;
    this.camera.updateProjectionMatrix();
    this.controls.update();
  }

  /** Whether the user, or a link, has turned the view. */
  get isTurned(): boolean {
    return !this.untouched_;
  }

  /** Where the eye is, and what it looks at. */
  get eye(): { position: Vec; target: Vec } {
    return { position: plain(this.camera.position), target: this.target };
  }

  /** As if the user had turned the view so. */
  lookFrom(position: Vec, target: Vec): void {
    this.untouched_ = false;
    this.camera.position.set(position.x, position.y, position.z);
    this.controls.target.set(target.x, target.y, target.z);
    this.controls.update();
  }

  /** Follows the window; `insets` are the panels. A view that the user has not moved keeps showing the whole model. */
  resize(insets: Insets): void {
    this.insets_ = insets;
    const { canvas } = this;
    const width = Math.max(1, canvas.parentElement?.clientWidth ?? 1);
    const height = Math.max(1, canvas.parentElement?.clientHeight ?? 1);
    this.renderer_?.setSize(width, height, true);
    canvas.style.width = `${width}px`;
    canvas.style.height = `${height}px`;
    this.camera.aspect = width / height;
    const shiftX = (insets.right - insets.left) / 2;
    const shiftY = (insets.bottom - insets.top) / 2;
    this.camera.setViewOffset(width, height, shiftX, shiftY, width, height);
    this.camera.updateProjectionMatrix();
    if (this.untouched_) {
      this.resetView();
    }
  }

  applyTheme(): void {
    this.scene.background = new THREE.Color(themeColour("stage"));
    if (this.floor_ !== undefined) {
      this.rebuildFloor(this.floor_.position.clone());
    }
  }

  /** The camera as the hand mapping needs it. */
  viewFrame(): ViewFrame {
    this.camera.updateMatrixWorld();
    const axes = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()] as const;
    this.camera.matrixWorld.extractBasis(...axes);
    return {
      eye: plain(this.camera.position),
      right: plain(axes[0]),
      up: plain(axes[1]),
      forward: plain(axes[2].negate()),
      fovY_rad: THREE.MathUtils.degToRad(this.camera.fov),
      height_px: this.size_px.height,
    };
  }

  /** Where `point` is on the page, in CSS pixels from the canvas's corner, and how far along the view, m. */
  project(point: Vec): { x: number; y: number; depth_m: number } {
    this.camera.updateMatrixWorld();
    const ndc = new THREE.Vector3(point.x, point.y, point.z).project(this.camera);
    const { width, height } = this.size_px;
    const depth_m = depthOf(this.viewFrame(), point);
    return { x: ((ndc.x + 1) / 2) * width, y: ((1 - ndc.y) / 2) * height, depth_m };
  }

  /** Through a pixel of the canvas. World frame, the direction is a unit vector. */
  rayAt(x_px: number, y_px: number): { origin: Vec; direction: Vec } {
    const { width, height } = this.size_px;
    this.camera.updateMatrixWorld();
    const raycaster = new THREE.Raycaster();
    raycaster.setFromCamera(new THREE.Vector2((x_px / width) * 2 - 1, 1 - (y_px / height) * 2), this.camera);
    return { origin: plain(raycaster.ray.origin), direction: plain(raycaster.ray.direction) };
  }

  draw(): void {
    // The controls damp per frame; made per second here, a slow renderer does not turn it into sluggishness.
    const now_ms = performance.now();
    this.controls.dampingFactor = 1 - Math.exp(-(now_ms - this.drawn_ms_) / kDamping_ms);
    this.drawn_ms_ = now_ms;
    this.controls.update();
    this.renderer_?.render(this.scene, this.camera);
  }

  /** The picture of the view alone; undefined where nothing can be drawn. */
  async picture(): Promise<Blob | undefined> {
    if (this.renderer_ === undefined) {
      return undefined;
    }
    // What was drawn is gone as soon as the browser has shown it.
    this.renderer_.render(this.scene, this.camera);
    return new Promise((resolve) => this.canvas.toBlob((blob) => resolve(blob ?? undefined), "image/png"));
  }

  private free(): { width: number; height: number } {
    const { width, height } = this.size_px;
    return {
      width: Math.max(100, width - this.insets_.left - this.insets_.right),
      height: Math.max(100, height - this.insets_.top - this.insets_.bottom),
    };
  }

  /** Studio light: a warm key and a cool rim that travel with the camera, and soft light from sky and floor. */
  private makeLights(): THREE.Object3D[] {
    const key = new THREE.DirectionalLight(0xfff4e6, 2.1);
    key.position.set(-0.6, 0.9, 1);
    const fill = new THREE.DirectionalLight(0xe6f0ff, 0.55);
    fill.position.set(1, 0.1, 0.6);
    const rim = new THREE.DirectionalLight(0xdfeaff, 0.9);
    rim.position.set(0.3, 0.8, -1);
    for (const light of [key, fill, rim]) {
      this.lights_.add(light, light.target);
    }
    return [new THREE.HemisphereLight(0xffffff, 0x8a8f98, 0.95)];
  }

  /** A little lower than the model: a flat one would flicker in the same plane. */
  private floorUnder(lowest_m: number): number {
    return lowest_m - 0.004 * this.diagonal_m_;
  }

  /** A faint grid under the model: the eye judges depth by it. */
  private rebuildFloor(centre: THREE.Vector3): void {
    if (this.floor_ !== undefined) {
      this.scene.remove(this.floor_);
      this.floor_.dispose();
    }
    const colour = new THREE.Color(themeColour("grid"));
    this.floor_ = new THREE.GridHelper(this.diagonal_m_ * 2, 20, colour, colour);
    this.floor_.position.copy(centre);
    this.scene.add(this.floor_);
  }
}

/** Undefined where WebGL is switched off or not there. */
function makeRenderer(canvas: HTMLCanvasElement): THREE.WebGLRenderer | undefined {
  const context = canvas.getContext("webgl2", { antialias: !drawsInSoftware(), alpha: true });
  if (context === null) {
    return undefined;
  }
  const renderer = new THREE.WebGLRenderer({ canvas, context });
  renderer.localClippingEnabled = true;
  renderer.setPixelRatio(Math.min(window.devicePixelRatio, kPixelRatioMax));
  return renderer;
}

/** True when no graphics card draws: then smooth edges would cost two thirds of the frames. */
function drawsInSoftware(): boolean {
  const context = document.createElement("canvas").getContext("webgl2");
  const details = context?.getExtension("WEBGL_debug_renderer_info");
  const name: unknown = context?.getParameter(details?.UNMASKED_RENDERER_WEBGL ?? context.RENDERER);
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(String(name));
}

function plain(v: THREE.Vector3): Vec {
  return { x: v.x, y: v.y, z: v.z };
}
