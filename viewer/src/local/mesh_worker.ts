// Reads one file beside the page and the engine, so that neither waits for it, and then ends.

import { readMesh } from "./mesh_file";

onmessage = async ({ data }: MessageEvent<{ ending: string; file: File }>) => {
  try {
    const mesh = readMesh(data.ending, await data.file.arrayBuffer());
    postMessage(mesh, { transfer: [mesh.positions.buffer, mesh.triangles.buffer] });
  } catch (error) {
    postMessage(error instanceof Error ? error.message : String(error));
  }
};
