import { defineConfig } from "vitest/config";

const none = ["**/node_modules/**"];
/** Real sockets and real clocks: one file after the other, when all else is done. */
const REAL_TIME = [
  "apps/server/src/**/*.test.ts",
  "apps/cli/src/virtual.test.ts",
  "apps/cli/src/recordings.test.ts",
  "apps/cli/src/on-robot.test.ts",
  "apps/cli/src/operations.test.ts",
  "apps/cli/src/vendor-sections.test.ts",
  "apps/cli/src/first-motion/first-motion.test.ts",
  "scripts/tutorials.test.ts",
];

export default defineConfig({
  test: {
    projects: [
      // Virtual time: how busy the machine is does not matter to them.
      {
        test: {
          name: "quick",
          include: [
            "packages/*/src/**/*.test.ts",
            "apps/*/src/**/*.test.ts",
            "apps/*/src/**/*.test.tsx",
            "scripts/**/*.test.ts",
            "examples/**/*.test.ts",
          ],
          exclude: [...none, ...REAL_TIME],
          testTimeout: 30_000,
          maxWorkers: 2,
          sequence: { groupOrder: 0 },
        },
      },
      {
        test: {
          name: "real time",
          include: REAL_TIME,
          exclude: none,
          testTimeout: 30_000,
          maxWorkers: 1,
          sequence: { groupOrder: 1 },
        },
      },
    ],
  },
});
