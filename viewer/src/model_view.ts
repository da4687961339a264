// The touched model in three.js: a surface in studio grey, its mesh edges on request, and its segments and points.
// All parts share one vertex buffer.

import * as THREE from "three";
import type { Scene } from "./protocol";
import { orientTowardNormals } from "./winding";
import { imageTexture } from "./image_texture";
import { themeColour } from "./theme";

/** Above this, drawing every mesh edge would only fill the screen and the memory. */
const kEdgesMaxTriangles = 2_000_000;
const kPointSize_px = 4;

export class ModelView {
  readonly group = new THREE.Group();
  /** The plain one, then one for each texture of the scene. */
  private surfaces_: THREE.MeshStandardMaterial[] = [surfaceMaterial()];
  private readonly edges_ = new THREE.MeshBasicMaterial({ wireframe: true, transparent: true, opacity: 0.22 });
  private readonly lines_ = new THREE.LineBasicMaterial();
  private readonly points_ = new THREE.PointsMaterial({ size: kPointSize_px, sizeAttenuation: false });
  private surfaceMesh_: THREE.Mesh | undefined;
  private edgeMesh_: THREE.Mesh | undefined;
  private hasNormals_ = false;
  private flat_ = false;
  private showEdges_ = false;

  get triangles(): number {
    return (this.surfaceMesh_?.geometry.index?.count ?? 0) / 3;
  }

  setScene(scene: Scene): void {
    this.clear();
    const position = new THREE.BufferAttribute(scene.positions, 3);
    this.hasNormals_ = scene.normals !== undefined;
    if (scene.triangles.length > 0) {
      const geometry = indexed(position, scene.triangles);
      if (scene.normals !== undefined) {
        orientTowardNormals(scene.positions, scene.normals, scene.triangles);
        geometry.setAttribute("normal", new THREE.BufferAttribute(scene.normals, 3));
      }
      this.surfaceMesh_ = new THREE.Mesh(geometry, this.surfaces_[0]!);
      this.showLooks(scene, geometry);
      this.group.add(this.surfaceMesh_);
    }
    if (scene.segments.length > 0) {
      this.group.add(new THREE.LineSegments(indexed(position, scene.segments), this.lines_));
    }
    if (scene.points.length > 0) {
      this.group.add(new THREE.Points(indexed(position, scene.points), this.points_));
    }
    this.applyShading();
    this.applyEdges();
    this.applyTheme();
  }

  /** Facets instead of interpolated normals; what has no normals is always shown so. */
  setFlat(flat: boolean): void {
    this.flat_ = flat;
    this.applyShading();
  }

  setEdges(shown: boolean): void {
    this.showEdges_ = shown;
    this.applyEdges();
  }

  applyTheme(): void {
    this.surfaces_.forEach((surface) => surface.color.set(themeColour("model")));
    this.edges_.color.set(themeColour("model-edge"));
    this.lines_.color.set(themeColour("model-line"));
    this.points_.color.set(themeColour("model-line"));
  }

  /** True when the ray meets the surface; models too large to ask in one frame count as met. */
  isHit(raycaster: THREE.Raycaster): boolean {
    if (this.surfaceMesh_ === undefined) {
      return false;
    }
    return this.triangles > kEdgesMaxTriangles || raycaster.intersectObject(this.surfaceMesh_, false).length > 0;
  }

  /** Textured triangles get the material of their image, all others the plain one. */
  private showLooks(scene: Scene, geometry: THREE.BufferGeometry): void {
    if (scene.texcoords === undefined) {
      return;
    }
    geometry.setAttribute("uv", new THREE.BufferAttribute(scene.texcoords, 2));
    const runs = scene.looks.flatMap((look, i) => look.runs.map((run) => ({ ...run, material: i + 1 })));
    let next = 0;
    for (const run of runs.sort((a, b) => a.first - b.first)) {
      geometry.addGroup(3 * next, 3 * (run.first - next), 0);
      geometry.addGroup(3 * run.first, 3 * run.count, run.material);
      next = run.first + run.count;
    }
    geometry.addGroup(3 * next, scene.triangles.length - 3 * next, 0);
    this.surfaces_.push(...scene.looks.map((look) => surfaceMaterial(imageTexture(look.image))));
    this.surfaceMesh_!.material = this.surfaces_;
  }

  private applyShading(): void {
    for (const surface of this.surfaces_) {
      surface.flatShading = this.flat_ || !this.hasNormals_;
      surface.needsUpdate = true;
    }
  }

  private applyEdges(): void {
    const wanted = this.showEdges_ && this.surfaceMesh_ !== undefined && this.triangles <= kEdgesMaxTriangles;
    if (wanted && this.edgeMesh_ === undefined) {
      this.edgeMesh_ = new THREE.Mesh(this.surfaceMesh_!.geometry, this.edges_);
      this.group.add(this.edgeMesh_);
    }
    if (this.edgeMesh_ !== undefined) {
      this.edgeMesh_.visible = wanted;
    }
  }

  private clear(): void {
    for (const child of this.group.children) {
      (child as THREE.Mesh).geometry.dispose();
    }
    this.group.clear();
    for (const textured of this.surfaces_.splice(1)) {
      textured.map?.dispose();
      textured.dispose();
    }
    this.surfaceMesh_ = undefined;
    this.edgeMesh_ = undefined;
  }
}

function surfaceMaterial(map: THREE.Texture | null = null): THREE.MeshStandardMaterial {
  return new THREE.MeshStandardMaterial({
    map,
    roughness: 0.62,
    metalness: 0,
    side: THREE.DoubleSide,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
}

function indexed(position: THREE.BufferAttribute, index: Uint32Array): THREE.BufferGeometry {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", position);
  geometry.setIndex(new THREE.BufferAttribute(index, 1));
  geometry.computeBoundingSphere();
  return geometry;
}
