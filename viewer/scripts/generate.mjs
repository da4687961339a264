// Generates src/gen/hl_pb.ts and recording_pb.ts from the schemas, proto/hl.proto and recording.proto, with protoc and the npm plugin protoc-gen-es.
// The result is never committed, so page and server cannot drift apart.
import { spawnSync } from "node:child_process";
import { mkdirSync } from "node:fs";
import { delimiter, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const viewerDir = dirname(dirname(fileURLToPath(import.meta.url)));
const protoDir = join(viewerDir, "..", "proto");
const outDir = join(viewerDir, "src", "gen");
mkdirSync(outDir, { recursive: true });

const pluginDir = join(viewerDir, "node_modules", ".bin");
const result = spawnSync("protoc", [`-I${protoDir}`, `--es_out=${outDir}`, "--es_opt=target=ts", "hl.proto", "recording.proto"], {
  stdio: "inherit",
  env: { ...process.env, PATH: `${pluginDir}${delimiter}${process.env.PATH ?? ""}` },
});
if (result.error) {
  console.error(`cannot run protoc (Debian package protobuf-compiler): ${result.error.message}`);
}
process.exit(result.status ?? 1);
