// One mesh in three.js, wherever it is placed: its surface is drawn once for all places, its segments and points once for
// each. All parts share one vertex buffer.

import * as THREE from "three";
import type { SurfaceImage } from "./gen/hl_pb";
import { imageTexture, pictureTexture } from "./image_texture";
import { kPoseNumbers, type Bounds, type Mesh } from "./scene_messages";
import { RayTree, type Accept } from "./ray_tree";
import { length, type Vec } from "./vec";
import { orientTowardNormals } from "./winding";

/** What all meshes are drawn with. `tint` is what the plain surface's colour is multiplied by where it is touched. */
export interface Palette {
  readonly model: THREE.Color;
  readonly tint: THREE.Color;
  /** The same where the pointer is. */
  readonly pointed: THREE.Color;
  readonly edges: THREE.MeshBasicMaterial;
  readonly lines: THREE.LineBasicMaterial;
  readonly points: THREE.PointsMaterial;
  readonly touchedLines: THREE.LineBasicMaterial;
  readonly touchedPoints: THREE.PointsMaterial;
}

/** Where a ray meets a surface. World frame. */
export interface Meeting {
  /** In lengths of the ray's direction. */
  readonly distance: number;
  readonly point: Vec;
  /** Unit; of the shading, where the mesh has one. */
  readonly normal: Vec;
  /** Number of the material there. */
  readonly material: number;
}

export type Highlight = "none" | "pointed" | "touched";

type Surface = THREE.InstancedMesh<THREE.BufferGeometry, THREE.Material[]>;
type Mark = THREE.LineSegments | THREE.Points;

/** Shading normals that are farther than 60 degrees off the facet are no guide to where the surface is. */
const kLeaning = 0.5;
const kUntouched = new THREE.Color(1, 1, 1);

export class MeshView {
  readonly group = new THREE.Group();
  readonly triangles: number;
  private readonly palette_: Palette;
  private readonly mesh_: Mesh;
  /** Around the mesh in its own frame. */
  private readonly ball_: THREE.Sphere;
  private readonly sphere_ = new THREE.Sphere();
  /** Made when the first ray comes. */
  private tree_: RayTree | undefined;
  private readonly bounds_: THREE.Box3;
  /** The plain one, then one for each texture or picture. */
  private readonly materials_: THREE.MeshStandardMaterial[] = [];
  /** Those of them that have the colours of the model's file. */
  private readonly own_ = new Set<THREE.MeshStandardMaterial>();
  private disposed_ = false;
  private readonly geometries_: THREE.BufferGeometry[] = [];
  private readonly hasNormals_: boolean;
  private readonly surfaceGeometry_: THREE.BufferGeometry | undefined;
  private readonly lineGeometry_: THREE.BufferGeometry | undefined;
  private readonly pointGeometry_: THREE.BufferGeometry | undefined;
  private surface_: Surface | undefined;
  private edges_: THREE.InstancedMesh | undefined;
  private edgesShown_ = false;
  /** Of places that have a colour of their own, as it is to be seen. */
  private readonly colours_ = new Map<number, THREE.Color>();
  /** Segments and points of each place. */
  private readonly marks_: Mark[][] = [];

  constructor(mesh: Mesh, palette: Palette) {
    this.palette_ = palette;
    this.mesh_ = mesh;
    this.bounds_ = boxOf(mesh.bounds);
    this.ball_ = this.bounds_.getBoundingSphere(new THREE.Sphere());
    this.triangles = mesh.triangles.length / 3;
    this.hasNormals_ = mesh.normals !== undefined;
    const position = new THREE.BufferAttribute(mesh.positions, 3);
    if (this.triangles > 0) {
      this.surfaceGeometry_ = this.indexed(position, mesh.triangles);
      this.dress(mesh, this.surfaceGeometry_);
    }
    this.lineGeometry_ = mesh.segments.length > 0 ? this.indexed(position, mesh.segments) : undefined;
    this.pointGeometry_ = mesh.points.length > 0 ? this.indexed(position, mesh.points) : undefined;
  }

  /** How many places it has; their poses and touches are set next. */
  setCount(count: number): void {
    if (this.surfaceGeometry_ !== undefined) {
      this.growSurface(this.surfaceGeometry_, count);
    }
    while (this.marks_.length > count) {
      this.group.remove(...this.marks_.pop()!);
    }
    while (this.marks_.length < count) {
      this.addMarks();
    }
  }

  /** Draws a place in a colour of its own, or as others. */
  setColour(place: number, colour: THREE.Color | undefined): void {
    if (colour === undefined) {
      this.colours_.delete(place);
    } else {
      this.colours_.set(place, colour);
    }
    this.setMark(place, "none");
  }

  /** The pose is at index `at` of `poses`. */
  setPose(place: number, poses: Float32Array, at: number): void {
    const from = kPoseNumbers * at;
    if (this.surface_ !== undefined) {
      writeMatrix(this.surface_.instanceMatrix.array, 16 * place, poses, from);
      this.surface_.instanceMatrix.needsUpdate = true;
    }
    for (const mark of this.marks_[place] ?? []) {
      writeMatrix(mark.matrix.elements, 0, poses, from);
      mark.matrixWorldNeedsUpdate = true;
    }
  }

  setMark(place: number, mark: Highlight): void {
    const { palette_: palette, surface_: surface } = this;
    const touched = mark !== "none";
    if (surface !== undefined) {
      const factor = mark === "touched" ? palette.tint : mark === "pointed" ? palette.pointed : this.factorOf(place);
      surface.setColorAt(place, factor);
      surface.instanceColor!.needsUpdate = true;
    }
    for (const mark of this.marks_[place] ?? []) {
      const [plain, bright] = mark instanceof THREE.Points
        ? [palette.points, palette.touchedPoints]
        : [palette.lines, palette.touchedLines];
      mark.material = touched ? bright : plain;
    }
  }

  /** Draws only what is in front of these planes. */
  setClip(planes: THREE.Plane[]): void {
    this.materials_.forEach((material) => (material.clippingPlanes = planes));
  }

  setFlat(flat: boolean): void {
    for (const material of this.materials_) {
      material.flatShading = flat || !this.hasNormals_;
      material.needsUpdate = true;
    }
  }

  setEdges(shown: boolean): void {
    this.edgesShown_ = shown;
    this.materials_.forEach((material) => (material.polygonOffset = shown));
    if (shown && this.edges_ === undefined && this.surface_ !== undefined) {
      this.makeEdges(this.surface_);
    }
    if (this.edges_ !== undefined) {
      this.edges_.visible = shown;
    }
  }

  applyTheme(): void {
    const { model } = this.palette_;
    this.materials_.forEach((material) => material.color.copy(this.own_.has(material) ? kUntouched : model));
    for (const place of this.colours_.keys()) {
      this.setMark(place, "none");
    }
  }

  /** Where a ray of the world first meets the surface at a place; `accept` is asked of points of the world. */
  cast(place: number, origin: Vec, direction: Vec, farthest: number, accept?: Accept): Meeting | undefined {
    const surface = this.surface_;
    if (surface === undefined || place >= surface.count) {
      return undefined;
    }
    const toWorld = new THREE.Matrix4();
    surface.getMatrixAt(place, toWorld);
    const ray = new THREE.Ray(three(origin), three(direction).normalize());
    const ball = this.sphere_.copy(this.ball_).applyMatrix4(toWorld);
    const nearest_m = ray.origin.distanceTo(ball.center) - ball.radius;
    if (nearest_m > farthest * length(direction) || !ray.intersectsSphere(ball)) {
      return undefined;
    }
    const toMesh = toWorld.clone().invert();
    const from = three(origin).applyMatrix4(toMesh);
    const along = three(origin).add(three(direction)).applyMatrix4(toMesh).sub(from);
    const counts = accept && ((point: Vec) => accept(three(point).applyMatrix4(toWorld)));
    this.tree_ ??= new RayTree(this.mesh_.positions, this.mesh_.triangles);
    const hit = this.tree_.cast(from, along, farthest, counts);
    if (hit === undefined) {
      return undefined;
    }
    const normal = this.normalAt(hit.triangle, hit.u, hit.v);
    normal.applyNormalMatrix(new THREE.Matrix3().getNormalMatrix(toWorld));
    const point = three(direction).multiplyScalar(hit.distance).add(three(origin));
    const material = this.mesh_.triangleMaterials[hit.triangle] ?? 0;
    return { distance: hit.distance, point: plain(point), normal: plain(normal), material };
  }

  /** Adds the box of one place to `bounds`. */
  addBounds(bounds: THREE.Box3, poses: Float32Array, at: number): void {
    const matrix = new THREE.Matrix4();
    writeMatrix(matrix.elements, 0, poses, kPoseNumbers * at);
    if (!this.bounds_.isEmpty()) {
      bounds.union(this.bounds_.clone().applyMatrix4(matrix));
    }
  }

  dispose(): void {
    this.disposed_ = true;
    this.group.removeFromParent();
    this.surface_?.dispose();
    this.geometries_.forEach((geometry) => geometry.dispose());
    for (const material of this.materials_) {
      material.map?.dispose();
      material.dispose();
    }
  }

  /** What the surface's colour is multiplied by at a place that nothing marks. */
  private factorOf(place: number): THREE.Color {
    const colour = this.colours_.get(place);
    if (colour === undefined || this.own_.size > 0) {
      return kUntouched;
    }
    const { r, g, b } = this.palette_.model;
    return new THREE.Color(colour.r / r, colour.g / g, colour.b / b);
  }

  /** Of the shading, unless it leans far off the facet: then of the facet. */
  private normalAt(triangle: number, u: number, v: number): THREE.Vector3 {
    const { positions, normals, triangles } = this.mesh_;
    const corners = [0, 1, 2].map((corner) => triangles[3 * triangle + corner]!);
    const at = (values: Float32Array, i: number) => new THREE.Vector3().fromArray(values, 3 * corners[i]!);
    const a = at(positions, 0);
    const facet = at(positions, 1).sub(a).cross(at(positions, 2).sub(a)).normalize();
    if (normals === undefined) {
      return facet;
    }
    const weights = [1 - u - v, u, v];
    const shaded = new THREE.Vector3();
    weights.forEach((weight, i) => shaded.addScaledVector(at(normals, i), weight));
    shaded.normalize();
    return Math.abs(shaded.dot(facet)) > kLeaning ? shaded : facet;
  }

  /** Normals, and for textured triangles the material of their image. */
  private dress(mesh: Mesh, geometry: THREE.BufferGeometry): void {
    this.materials_.push(surfaceMaterial());
    if (mesh.normals !== undefined) {
      orientTowardNormals(mesh.positions, mesh.normals, mesh.triangles);
      geometry.setAttribute("normal", new THREE.BufferAttribute(mesh.normals, 3));
    }
    const runs = mesh.looks.flatMap((look, i) => look.runs.map((run) => ({ ...run, material: i + 1 })));
    let next = 0;
    for (const run of runs.sort((a, b) => a.first - b.first)) {
      geometry.addGroup(3 * next, 3 * (run.first - next), 0);
      geometry.addGroup(3 * run.first, 3 * run.count, run.material);
      next = run.first + run.count;
    }
    geometry.addGroup(3 * next, mesh.triangles.length - 3 * next, 0);
    if (mesh.texcoords !== undefined) {
      geometry.setAttribute("uv", new THREE.BufferAttribute(mesh.texcoords, 2));
      this.materials_.push(...mesh.looks.map((look) => this.materialOf(look.image)));
    }
    if (mesh.colours !== undefined) {
      geometry.setAttribute("color", new THREE.BufferAttribute(linearColours(mesh.colours), 3, true));
      for (const material of this.materials_) {
        material.vertexColors = true;
        this.own_.add(material);
      }
    }
    this.applyTheme();
  }

  /** A picture appears when the browser has read it. */
  private materialOf(image: SurfaceImage): THREE.MeshStandardMaterial {
    if (image.file.length === 0) {
      return surfaceMaterial(imageTexture(image));
    }
    const material = surfaceMaterial();
    this.own_.add(material);
    void pictureTexture(image).then((texture) => {
      if (texture === undefined || this.disposed_) {
        texture?.dispose();
        return;
      }
      material.map = texture;
      material.needsUpdate = true;
    });
    return material;
  }

  /** Room for twice as many as before, so that a scene that grows one by one is not copied each time. */
  private growSurface(geometry: THREE.BufferGeometry, count: number): void {
    const room = this.surface_?.instanceMatrix.count ?? 0;
    if (count > room) {
      this.dropSurface();
      const surface = new THREE.InstancedMesh(geometry, this.materials_ as THREE.Material[], Math.max(count, 2 * room));
      surface.instanceMatrix.setUsage(THREE.DynamicDrawUsage);
      surface.frustumCulled = false;  // it is in many places
      for (let place = 0; place < surface.instanceMatrix.count; ++place) {
        surface.setColorAt(place, kUntouched);
      }
      this.surface_ = surface;
      this.group.add(surface);
      this.setEdges(this.edgesShown_);
    }
    for (const drawn of [this.surface_, this.edges_]) {
      if (drawn !== undefined) drawn.count = count;
    }
  }

  private dropSurface(): void {
    for (const old of [this.surface_, this.edges_]) {
      old?.removeFromParent();
    }
    this.surface_?.dispose();
    this.surface_ = this.edges_ = undefined;
  }

  /** Drawn where the surface is: they share the matrices. */
  private makeEdges(surface: Surface): void {
    this.edges_ = new THREE.InstancedMesh(surface.geometry, this.palette_.edges, 0);
    this.edges_.instanceMatrix = surface.instanceMatrix;
    this.edges_.count = surface.count;
    this.edges_.frustumCulled = false;
    this.group.add(this.edges_);
  }

  private addMarks(): void {
    const marks: Mark[] = [];
    if (this.lineGeometry_ !== undefined) {
      marks.push(new THREE.LineSegments(this.lineGeometry_, this.palette_.lines));
    }
    if (this.pointGeometry_ !== undefined) {
      marks.push(new THREE.Points(this.pointGeometry_, this.palette_.points));
    }
    marks.forEach((mark) => (mark.matrixAutoUpdate = false));
    this.marks_.push(marks);
    if (marks.length > 0) {
      this.group.add(...marks);
    }
  }

  private indexed(position: THREE.BufferAttribute, index: Uint32Array): THREE.BufferGeometry {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", position);
    geometry.setIndex(new THREE.BufferAttribute(index, 1));
    geometry.boundingBox = this.bounds_.clone();
    geometry.boundingSphere = this.bounds_.getBoundingSphere(new THREE.Sphere());
    this.geometries_.push(geometry);
    return geometry;
  }
}

function boxOf(bounds: Bounds | undefined): THREE.Box3 {
  const box = new THREE.Box3();
  if (bounds !== undefined) {
    box.min.set(bounds.min.x, bounds.min.y, bounds.min.z);
    box.max.set(bounds.max.x, bounds.max.y, bounds.max.z);
  }
  return box;
}

/** Colours as screens show them, as three.js mixes them with light: 0..65535. */
function linearColours(colours: Uint8Array): Uint16Array {
  const linear = Uint16Array.from({ length: 256 }, (_, value) =>
    Math.round(65535 * new THREE.Color().setRGB(value / 255, 0, 0, THREE.SRGBColorSpace).r));
  return Uint16Array.from(colours, (value) => linear[value]!);
}

function surfaceMaterial(map: THREE.Texture | null = null): THREE.MeshStandardMaterial {
  return new THREE.MeshStandardMaterial({
    map,
    roughness: 0.62,
    metalness: 0,
    side: THREE.DoubleSide,
    // Only while edges are drawn in the same place: at a silhouette it would let the back through.
    polygonOffset: false,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
}

/** A pose of 3 rows of 4 as the 4 columns of 4 that three.js keeps. */
function writeMatrix(out: THREE.TypedArray | number[], to: number, poses: Float32Array, from: number): void {
  for (let column = 0; column < 4; ++column) {
    for (let row = 0; row < 3; ++row) {
      out[to + 4 * column + row] = poses[from + 4 * row + column]!;
    }
    out[to + 4 * column + 3] = column === 3 ? 1 : 0;
  }
}

function three({ x, y, z }: Vec): THREE.Vector3 {
  return new THREE.Vector3(x, y, z);
}

function plain({ x, y, z }: THREE.Vector3): Vec {
  return { x, y, z };
}
