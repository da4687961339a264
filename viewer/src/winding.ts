// Files do not agree on which side of a triangle is its front; the renderer lights a back side with reversed normals.
// Each triangle is turned so that its front is where its own vertex normals point: then light follows the normals.

/** Swaps two corners, in place, of every triangle that faces away from the sum of its vertex normals. */
export function orientTowardNormals(positions: Float32Array, normals: Float32Array, triangles: Uint32Array): void {
  for (let i = 0; i + 2 < triangles.length; i += 3) {
    const [a, b, c] = [3 * triangles[i]!, 3 * triangles[i + 1]!, 3 * triangles[i + 2]!];
    const ux = positions[b]! - positions[a]!;
    const uy = positions[b + 1]! - positions[a + 1]!;
    const uz = positions[b + 2]! - positions[a + 2]!;
    const vx = positions[c]! - positions[a]!;
    const vy = positions[c + 1]! - positions[a + 1]!;
    const vz = positions[c + 2]! - positions[a + 2]!;
    const agreement =
      (uy * vz - uz * vy) * (normals[a]! + normals[b]! + normals[c]!) +
      (uz * vx - ux * vz) * (normals[a + 1]! + normals[b + 1]! + normals[c + 1]!) +
      (ux * vy - uy * vx) * (normals[a + 2]! + normals[b + 2]! + normals[c + 2]!);
    if (agreement < 0) {
      const second = triangles[i + 1]!;
      triangles[i + 1] = triangles[i + 2]!;
      triangles[i + 2] = second;
    }
  }
}
