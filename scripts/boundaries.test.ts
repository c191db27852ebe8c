import { mkdirSync, rmSync, writeFileSync } from "node:fs";
import { spawnSync } from "node:child_process";
import { afterAll, expect, test } from "vitest";
import { fileURLToPath } from "node:url";

const root = fileURLToPath(new URL("..", import.meta.url));
const planted: string[] = [];
const cruise = (path: string) =>
  spawnSync(
    process.execPath,
    ["node_modules/dependency-cruiser/bin/dependency-cruiser.mjs", "--config", "dependency-cruiser.mjs", path],
    { cwd: root, encoding: "utf8" },
  );

function plant(folder: string, text: string): string {
  const path = `${folder}/planted-violation.ts`;
  mkdirSync(root + folder, { recursive: true });
  writeFileSync(root + path, text);
  planted.push(root + path);
  return path;
}
afterAll(() => {
  for (const path of planted) rmSync(path, { force: true });
});

test.each([
  [
    "core knows nobody",
    "packages/core/src",
    'import * as x from "@twincell/languages";\nexport const y = x;\n',
    "core-knows-only-its-own",
  ],
  [
    "core's folders are layers",
    "packages/core/src/kinematics",
    'import * as x from "../trajectory/index.ts";\nexport const y = x;\n',
    "core-kinematics-uses-lower-layers",
  ],
  [
    "neighbours are strangers",
    "packages/recording/src",
    'import * as x from "@twincell/controllers";\nexport const y = x;\n',
    "recording-knows-only-its-own",
  ],
  [
    "a package installs only what its row allows",
    "packages/core/src",
    'import { z } from "zod";\nexport const y = z;\n',
    "core-installs-only",
  ],
  [
    "nobody imports a package by a path into its src",
    "apps/cli/src",
    'import * as x from "../../../packages/core/src/fault.ts";\nexport const y = x;\n',
    "through-the-front-door",
  ],
  [
    "stores see no picture",
    "apps/studio/src/stores",
    'import * as x from "three";\nexport const y = x;\n',
    "stores-see-no-picture",
  ],
])(
  "a planted violation is reported: %s",
  (_says, folder, text, rule) => {
    const path = plant(folder, text);
    const run = cruise(path);
    rmSync(root + path, { force: true });
    expect(run.stdout).toContain(rule);
    expect(run.status).not.toBe(0);
  },
  60_000,
);

test("a planted DOM use in a package does not compile", () => {
  const path = plant("packages/formats/src", "export const y = document.title;\n");
  const run = spawnSync(process.execPath, ["node_modules/typescript7/bin/tsc", "-p", "packages/formats"], {
    cwd: root,
    encoding: "utf8",
  });
  rmSync(root + path, { force: true });
  expect(run.stdout).toContain("Cannot find name 'document'");
}, 120_000);

test("a planted clock or dice in a package does not pass lint", () => {
  const path = plant("packages/core/src", "export const y = () => Math.random() + Date.now();\n");
  const run = spawnSync(process.execPath, ["node_modules/eslint/bin/eslint.js", path], { cwd: root, encoding: "utf8" });
  rmSync(root + path, { force: true });
  expect(run.stdout).toContain("Randomness is an argument");
  expect(run.stdout).toContain("Time is an argument");
}, 60_000);
