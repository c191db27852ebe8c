import { defineConfig } from "vitest/config";

export default defineConfig({
  test: {
    include: ["apps/studio/browser-tests/**/*.test.ts"],
    testTimeout: 180_000,
    hookTimeout: 180_000,
    fileParallelism: false,
    // Real timers in a real browser, drawn by the processor: a test that a busy machine spoilt is run once more, and
    // the report says so.
    retry: 1,
  },
});
