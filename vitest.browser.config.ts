import { defineConfig } from "vitest/config";

export default defineConfig({
  test: {
    include: ["apps/studio/browser-tests/**/*.test.ts"],
    testTimeout: 180_000,
    hookTimeout: 180_000,
    fileParallelism: false,
  },
});
