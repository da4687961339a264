// End-to-end tests: a real server, the built page, a real Chromium. One after the other: they share a small machine.
import { defineConfig } from "vitest/config";

export default defineConfig({
  test: {
    include: ["e2e/**/*.e2e.ts"],
    environment: "node",
    fileParallelism: false,
    // Software graphics on a busy machine: what is waited for comes late: a long wait distinguishes late from never.
    testTimeout: 600_000,
    hookTimeout: 300_000,
    expect: { poll: { timeout: 120_000 } },
  },
});
