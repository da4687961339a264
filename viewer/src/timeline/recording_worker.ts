// Reads a recording file beside the page, which goes on drawing meanwhile.

import type { Recording } from "./recording";
import { RecordingError } from "./recording_blocks";
import { readRecording } from "./recording_reader";

export type WorkerMessage =
  | { readonly kind: "share"; readonly share: number }
  | { readonly kind: "recording"; readonly recording: Recording }
  | { readonly kind: "refused"; readonly why: string };

const kReport_ms = 100;

function buffersOf({ steps, ticks, meshes, bodies }: Recording): ArrayBuffer[] {
  const tracks = [steps, ticks].flatMap(({ times, columns }) => [times, ...columns]);
  const lists = meshes.flatMap((mesh) =>
    [mesh.positions, mesh.normals, mesh.triangles, mesh.segments, mesh.points, mesh.triangleMaterials]);
  const poses = bodies.flatMap((track) => [track.times, track.poses]);
  return [...tracks, ...lists, ...poses].flatMap((list) => (list === undefined ? [] : [list.buffer as ArrayBuffer]));
}

async function answer(file: Blob): Promise<void> {
  const post = (message: WorkerMessage, transfer: ArrayBuffer[] = []) => postMessage(message, { transfer });
  let reported_ms = 0;
  try {
    const recording = await readRecording(file, (share) => {
      if (performance.now() - reported_ms > kReport_ms) {
        reported_ms = performance.now();
        post({ kind: "share", share });
      }
    });
    post({ kind: "recording", recording }, buffersOf(recording));
  } catch (error) {
    const why = error instanceof RecordingError ? error.message : `cannot be read (${String(error)})`;
    post({ kind: "refused", why });
  }
}

onmessage = (event: MessageEvent<Blob>) => void answer(event.data);
