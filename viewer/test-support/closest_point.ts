// Distance from a point to a mesh by asking every triangle: the slow judge of where the proxy is. The point is projected
// onto the triangle's plane when it lies over the face, else onto the nearest of its three edges.

import { add, dot, length, scale, sub, type Vec } from "../src/vec";

function cross(a: Vec, b: Vec): Vec {
  return { x: a.y * b.z - a.z * b.y, y: a.z * b.x - a.x * b.z, z: a.x * b.y - a.y * b.x };
}

function distanceToSegment(p: Vec, a: Vec, b: Vec): number {
  const along = sub(b, a);
  const squared = dot(along, along);
  const t = squared > 0 ? Math.min(1, Math.max(0, dot(sub(p, a), along) / squared)) : 0;
  return length(sub(p, add(a, scale(along, t))));
}

function distanceToTriangle(p: Vec, corners: readonly [Vec, Vec, Vec]): number {
  const [a, b, c] = corners;
  const normal = cross(sub(b, a), sub(c, a));
  const area2 = length(normal);
  const edges: [Vec, Vec][] = [[a, b], [b, c], [c, a]];
  const over = area2 > 0 && edges.every(([from, to]) => dot(cross(sub(to, from), sub(p, from)), normal) >= 0);
  return over
    ? Math.abs(dot(sub(p, a), normal)) / area2
    : Math.min(...edges.map(([from, to]) => distanceToSegment(p, from, to)));
}

export function distanceToTriangles(p: Vec, positions: Float32Array, triangles: Uint32Array): number {
  const vertex = (i: number): Vec => ({ x: positions[3 * i]!, y: positions[3 * i + 1]!, z: positions[3 * i + 2]! });
  let nearest = Infinity;
  for (let i = 0; i + 2 < triangles.length; i += 3) {
    const corners = [vertex(triangles[i]!), vertex(triangles[i + 1]!), vertex(triangles[i + 2]!)] as const;
    nearest = Math.min(nearest, distanceToTriangle(p, corners));
  }
  return nearest;
}
