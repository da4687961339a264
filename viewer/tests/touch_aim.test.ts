// How deep a goal may be beneath a place so that the proxy stays there: on a ball, a bar, and a block near its edge.
import * as THREE from "three";
import { expect, test } from "vitest";
import { ModelView } from "../src/model_view";
import type { Layout, Mesh } from "../src/scene_messages";
import { steadyDepth, surfaceUnder, type AimScene } from "../src/touch_aim";
import type { Vec } from "../src/vec";

type Place = [x: number, y: number, z: number];

function sceneOf(shape: THREE.BufferGeometry, worldPerHand = 1, ...places: Place[]): AimScene {
  const at = places.length > 0 ? places : [[0, 0, 0]];
  const poses = Float32Array.from(at.flatMap(([x, y, z]) => [1, 0, 0, x!, 0, 1, 0, y!, 0, 0, 1, z!]));
  shape.computeBoundingBox();
  const { min, max } = shape.boundingBox!;
  const mesh: Mesh = {
    number: 1, positions: shape.getAttribute("position").array as Float32Array,
    normals: shape.getAttribute("normal").array as Float32Array, triangles: Uint32Array.from(shape.index!.array),
    segments: new Uint32Array(), points: new Uint32Array(), texcoords: undefined, looks: [],
    triangleMaterials: new Uint16Array(), bounds: { min, max },
  };
  const model = new ModelView();
  model.add(mesh);
  const placed = at.map(() => ({ mesh: 1 })) as unknown as Layout["placed"];
  const layout = { number: 1, name: "", bounds: undefined, proxyRadius_m: 0.002, worldPerDevice: worldPerHand, placed };
  model.setLayout({ ...layout, poses }, poses);
  return { model, bounds: () => mesh.bounds, proxyRadius_m: 0.002, worldPerHand, section: undefined };
}

/** Straight below a place high above. */
function steadyBelow(scene: AimScene, x: number, z: number): number {
  const down: Vec = { x: 0, y: -1, z: 0 };
  return steadyDepth(scene, surfaceUnder(scene, { origin: { x, y: 9, z }, direction: down })!);
}

test("on a ball it is the radius, whatever the scale", () => {
  for (const scale of [1, 100]) {
    const scene = sceneOf(new THREE.SphereGeometry(0.04 * scale, 200, 200), scale);
    for (const x of [0, 0.01, 0.03]) {
      expect(steadyBelow(scene, x * scale, 0.002 * scale) / scale).toBeCloseTo(0.04, 3);
    }
  }
});

test("on a bar it is that of the bend across", () => {
  const scene = sceneOf(new THREE.CylinderGeometry(0.005, 0.005, 0.2, 200, 200).rotateZ(0.5 * Math.PI));
  expect(steadyBelow(scene, 0.01, 0.0001)).toBeGreaterThan(0.0045);
  expect(steadyBelow(scene, 0.01, 0.0001)).toBeLessThan(0.006);
});

test("on a face it is any, near an edge too; closer to it the middle of the block", () => {
  const scene = sceneOf(new THREE.BoxGeometry(0.06, 0.04, 0.06));
  expect(steadyBelow(scene, 0, 0.001)).toBe(Infinity);
  expect(steadyBelow(scene, 0.027, 0.001)).toBe(Infinity);
  expect(steadyBelow(scene, 0.029, 0.001)).toBeCloseTo(0.02, 4);
});

test("on a ring it is that of its tube, on either side", () => {
  const scene = sceneOf(new THREE.TorusGeometry(0.05, 0.02, 100, 200).rotateX(0.5 * Math.PI));
  expect(steadyBelow(scene, 0.04, 0)).toBeCloseTo(0.02, 3);
  expect(steadyBelow(scene, 0.06, 0)).toBeCloseTo(0.02, 3);
});

test("at the foot of a wall it is any", () => {
  const scene = sceneOf(new THREE.BoxGeometry(0.06, 0.04, 0.06), 1, [0, 0, 0], [0.06, 0.03, 0]);
  expect(steadyBelow(scene, 0.029, 0.001)).toBe(Infinity);
});
