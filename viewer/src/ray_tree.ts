// Where a ray meets a mesh first: a tree of boxes over the triangles, which is split only where a ray comes along. So
// the first ray into a million triangles costs a few passes over them, and every later one microseconds.

import type { Vec } from "./vec";

export interface RayHit {
  /** In lengths of the ray's direction. */
  readonly distance: number;
  readonly triangle: number;
  /** Weights of the triangle's second and third corner. */
  readonly u: number;
  readonly v: number;
}

/** True: this point of the mesh counts. In the frame of the mesh. */
export type Accept = (point: Vec) => boolean;

interface Node {
  readonly box: Float64Array;  // low x y z, high x y z
  readonly first: number;
  readonly count: number;
  children?: readonly [Node, Node];
}

interface Ray {
  readonly origin: readonly number[];
  readonly direction: readonly number[];
  readonly inverse: readonly number[];
  readonly accept: Accept | undefined;
}

const kLeaf = 8;
/** In place of zero in the ray's direction, so that its inverse is a number. */
const kTiny = 1e-300;

export class RayTree {
  private readonly positions_: Float32Array;
  private readonly triangles_: Uint32Array;
  private readonly order_: Uint32Array;
  private readonly root_: Node;

  constructor(positions: Float32Array, triangles: Uint32Array) {
    this.positions_ = positions;
    this.triangles_ = triangles;
    this.order_ = Uint32Array.from({ length: Math.floor(triangles.length / 3) }, (_, i) => i);
    this.root_ = this.makeNode(0, this.order_.length);
  }

  /** The nearest triangle within `farthest` lengths of `direction`, whichever side it shows. */
  cast(origin: Vec, direction: Vec, farthest: number, accept?: Accept): RayHit | undefined {
    const along = [direction.x, direction.y, direction.z];
    const inverse = along.map((d) => 1 / (d || kTiny));
    const ray: Ray = { origin: [origin.x, origin.y, origin.z], direction: along, inverse, accept };
    return this.castInto(this.root_, ray, { distance: farthest, triangle: -1, u: 0, v: 0 });
  }

  private castInto(root: Node, ray: Ray, limit: RayHit): RayHit | undefined {
    let best = limit;
    const open: [Node, number][] = [[root, entry(root.box, ray)]];
    while (open.length > 0) {
      const [node, at] = open.pop()!;
      if (!(at < best.distance)) {
        continue;
      }
      const children = this.childrenOf(node);
      if (children === undefined) {
        best = this.castAtLeaf(node, ray, best);
        continue;
      }
      const [a, b] = [entry(children[0].box, ray), entry(children[1].box, ray)];
      const [first, second]: [Node, number][] = [[children[0], a], [children[1], b]];
      open.push(...(a < b ? [second!, first!] : [first!, second!]));
    }
    return best.triangle < 0 ? undefined : best;
  }

  private castAtLeaf(node: Node, ray: Ray, best: RayHit): RayHit {
    for (let i = node.first; i < node.first + node.count; ++i) {
      const hit = this.meet(this.order_[i]!, ray, best.distance);
      best = hit ?? best;
    }
    return best;
  }

  /** Moeller and Trumbore's test. */
  private meet(triangle: number, ray: Ray, farthest: number): RayHit | undefined {
    const p = this.positions_;
    const t = this.triangles_;
    const [a, b, c] = [3 * t[3 * triangle]!, 3 * t[3 * triangle + 1]!, 3 * t[3 * triangle + 2]!];
    const [dx, dy, dz] = ray.direction as [number, number, number];
    const [ax, ay, az] = [p[a]!, p[a + 1]!, p[a + 2]!];
    const [bx, by, bz] = [p[b]! - ax, p[b + 1]! - ay, p[b + 2]! - az];
    const [cx, cy, cz] = [p[c]! - ax, p[c + 1]! - ay, p[c + 2]! - az];
    const [hx, hy, hz] = [dy * cz - dz * cy, dz * cx - dx * cz, dx * cy - dy * cx];
    const determinant = bx * hx + by * hy + bz * hz;
    const [sx, sy, sz] = [ray.origin[0]! - ax, ray.origin[1]! - ay, ray.origin[2]! - az];
    const u = (sx * hx + sy * hy + sz * hz) / determinant;
    const [qx, qy, qz] = [sy * bz - sz * by, sz * bx - sx * bz, sx * by - sy * bx];
    const v = (dx * qx + dy * qy + dz * qz) / determinant;
    const distance = (cx * qx + cy * qy + cz * qz) / determinant;
    const met = u >= 0 && v >= 0 && u + v <= 1 && distance >= 0 && distance < farthest;
    const at = (axis: number) => ray.origin[axis]! + distance * ray.direction[axis]!;
    const counts = met && (ray.accept === undefined || ray.accept({ x: at(0), y: at(1), z: at(2) }));
    return counts ? { distance, triangle, u, v } : undefined;
  }

  private childrenOf(node: Node): readonly [Node, Node] | undefined {
    if (node.children === undefined && node.count > kLeaf) {
      const middle = this.partition(node);
      const end = node.first + node.count;
      node.children = [this.makeNode(node.first, middle), this.makeNode(middle, end)];
    }
    return node.children;
  }

  /** Reorders the node's triangles about the middle of their centres, along the longest side; halves what is alike. */
  private partition(node: Node): number {
    const sides = [0, 1, 2].map((axis) => node.box[axis + 3]! - node.box[axis]!);
    const axis = sides.indexOf(Math.max(...sides));
    const end = node.first + node.count;
    let [low, high] = [Infinity, -Infinity];
    for (let i = node.first; i < end; ++i) {
      const centre = this.centre(this.order_[i]!, axis);
      low = Math.min(low, centre);
      high = Math.max(high, centre);
    }
    const split = (low + high) / 2;
    let middle = node.first;
    for (let i = node.first; i < end; ++i) {
      const triangle = this.order_[i]!;
      if (this.centre(triangle, axis) < split) {
        this.order_[i] = this.order_[middle]!;
        this.order_[middle++] = triangle;
      }
    }
    return middle > node.first && middle < end ? middle : node.first + (node.count >> 1);
  }

  /** Three times the coordinate of the triangle's centre. */
  private centre(triangle: number, axis: number): number {
    const t = this.triangles_;
    const p = this.positions_;
    const at = 3 * triangle;
    return p[3 * t[at]! + axis]! + p[3 * t[at + 1]! + axis]! + p[3 * t[at + 2]! + axis]!;
  }

  private makeNode(first: number, end: number): Node {
    const box = new Float64Array([Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity]);
    for (let i = first; i < end; ++i) {
      const at = 3 * this.order_[i]!;
      for (let corner = 0; corner < 3; ++corner) {
        const vertex = 3 * this.triangles_[at + corner]!;
        for (let axis = 0; axis < 3; ++axis) {
          const value = this.positions_[vertex + axis]!;
          if (value < box[axis]!) box[axis] = value;
          if (value > box[axis + 3]!) box[axis + 3] = value;
        }
      }
    }
    return { box, first, count: end - first };
  }
}

/** Where the ray enters the box, in lengths of its direction; infinity when it misses. */
function entry(box: Float64Array, { origin, inverse }: Ray): number {
  let [from, to] = [0, Infinity];
  for (let axis = 0; axis < 3; ++axis) {
    const a = (box[axis]! - origin[axis]!) * inverse[axis]!;
    const b = (box[axis + 3]! - origin[axis]!) * inverse[axis]!;
    from = Math.max(from, Math.min(a, b));
    to = Math.min(to, Math.max(a, b));
  }
  return from <= to ? from : Infinity;
}
