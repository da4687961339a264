// Builds the page without a server into build/web/: the same page, with a worker in the place of the connection.
import { fileURLToPath } from "node:url";
import { defineConfig, type Plugin } from "vite";

const path = (relative: string) => fileURLToPath(new URL(relative, import.meta.url));
const moduleFolder = path("../build/web-module");

// 'wasm-unsafe-eval' allows WebAssembly to be compiled, and no script.
const contentPolicy =
  "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; style-src 'self'; img-src 'self' data:; " +
  "connect-src 'self'; base-uri 'none'; form-action 'none'";

function contentPolicyPlugin(): Plugin {
  return {
    name: "hl-content-policy",
    transformIndexHtml: () => [
      { tag: "meta", attrs: { "http-equiv": "Content-Security-Policy", content: contentPolicy }, injectTo: "head-prepend" },
    ],
  };
}

const alias = [
  { find: /^\.\/connection$/, replacement: path("src/local/connection.ts") },
  { find: /^\.\/model_file$/, replacement: path("src/local/model_file.ts") },
  { find: /^hl-web-module$/, replacement: `${moduleFolder}/hl_web.mjs` },
  { find: /^hl-web-binary/, replacement: `${moduleFolder}/hl_web.wasm` },
];

export default defineConfig({
  base: "./",
  plugins: [contentPolicyPlugin()],
  resolve: { alias },
  worker: { format: "es" },
  build: {
    outDir: "../build/web",
    emptyOutDir: true,
    target: "es2022",
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 1500,
    assetsInlineLimit: 0,
  },
});
