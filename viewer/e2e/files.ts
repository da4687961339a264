// Model files for the end-to-end tests, and how a page is given one.

import type { Page } from "playwright-core";

const kFaces = [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6]] as const;

function corners(x: number, y: number, z: number): number[][] {
  return Array.from({ length: 8 }, (_, i) => [i & 1 ? x : 0, i & 2 ? y : 0, i & 4 ? z : 0]);
}

/** A closed box from the origin, with these sides. */
export function boxObj(x: number, y = x, z = x, head = ""): string {
  const vertices = corners(x, y, z).map((corner) => `v ${corner.join(" ")}`);
  return `${head}${[...vertices, ...kFaces.map((face) => `f ${face.join(" ")}`)].join("\n")}\n`;
}

export function boxStl(side: number): string {
  const at = corners(side, side, side);
  const facets = kFaces.flatMap(([a, b, c, d]) => [[a, b, c], [a, c, d]]).map((triangle) =>
    `facet normal 0 0 0\nouter loop\n${triangle.map((i) => `vertex ${at[i! - 1]!.join(" ")}`).join("\n")}\nendloop\nendfacet`);
  return `solid box\n${facets.join("\n")}\nendsolid box\n`;
}

export function boxPly(side: number): string {
  const head = "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n" +
    "element face 6\nproperty list uchar int vertex_indices\nend_header\n";
  const faces = kFaces.map((face) => `4 ${face.map((i) => i - 1).join(" ")}`);
  return `${head}${[...corners(side, side, side).map((corner) => corner.join(" ")), ...faces].join("\n")}\n`;
}

/** Drops a file on the page, as a browser does it, or only holds it there. */
export async function drop(
  page: Page, name: string, content: string, events: readonly string[] = ["dragenter", "dragover", "drop"],
): Promise<void> {
  const data = await page.evaluateHandle(([name, content]) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([content!], name!));
    return transfer;
  }, [name, content]);
  for (const type of events) {
    await page.dispatchEvent("#canvas", type, { dataTransfer: data });
  }
}
