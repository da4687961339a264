// Builds the page into dist/: static files with relative addresses, under a strict content policy.
import { defineConfig, type Plugin } from "vite";

// Everything from the serving host, nothing else. Only in the build: Vite's own development client needs inline styles.
const contentPolicy =
  "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; base-uri 'none'; " +
  "form-action 'none'";

function contentPolicyPlugin(): Plugin {
  return {
    name: "hl-content-policy",
    apply: "build",
    transformIndexHtml: () => [
      { tag: "meta", attrs: { "http-equiv": "Content-Security-Policy", content: contentPolicy }, injectTo: "head-prepend" },
    ],
  };
}

export default defineConfig({
  base: "./",
  plugins: [contentPolicyPlugin()],
  build: {
    target: "es2022",
    modulePreload: { polyfill: false },
    // three.js alone is about 0.7 MB; it comes from the same machine, so one chunk is simplest.
    chunkSizeWarningLimit: 1500,
    assetsInlineLimit: 0,
  },
  // For `npm run dev`: the page from Vite, the data from a running `hl touch`.
  server: { host: "127.0.0.1", proxy: { "/viewer": { target: process.env.HL_PAGE ?? "http://127.0.0.1:1997", ws: true } } },
});
