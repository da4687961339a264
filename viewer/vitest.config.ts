// Unit tests of the pure modules; no browser, no server. A test takes milliseconds, or seconds where compilers run beside.
import { defineConfig } from "vitest/config";

export default defineConfig({
  test: { include: ["tests/**/*.test.ts"], environment: "node", testTimeout: 120_000, hookTimeout: 120_000 },
});
