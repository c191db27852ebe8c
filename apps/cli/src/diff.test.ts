import { spawnSync } from "node:child_process";
import { edgeTraceCell, saveDocument } from "@twincell/project";
import { fileURLToPath } from "node:url";
import { expect, test } from "vitest";

const root = fileURLToPath(new URL("../../../", import.meta.url));
const EXAMPLE = "examples/01-edge-trace/cell.json";
const diff = (args: readonly string[], input = "") =>
  spawnSync(process.execPath, ["apps/cli/src/main.ts", "diff", ...args], { cwd: root, input, encoding: "utf8" });

test("diff of a cell with itself prints nothing and exits with 0", () => {
  const run = diff([EXAMPLE, EXAMPLE]);
  expect([run.status, run.stdout, run.stderr]).toEqual([0, "", ""]);
});

test("diff names what was moved and renamed, one line each, and exits with 1; --json says the same", () => {
  const cell = edgeTraceCell();
  const before = saveDocument(cell);
  const after = saveDocument({
    ...cell,
    name: "Line 2",
    objects: cell.objects.map(object =>
      object.id === "carton"
        ? { ...object, worldFromObject: { ...object.worldFromObject, position: [0.5, 0, 0.9] as const } }
        : object,
    ),
  });
  const run = diff([EXAMPLE, "-"], after);
  const from = diff([EXAMPLE, "-"], before);
  expect(from.stdout).toBe("");
  expect(run.status).toBe(1);
  const lines = run.stdout.trim().split("\n");
  // The frame at the corner of the carton goes with it.
  expect(lines).toHaveLength(3);
  expect(lines[0]).toMatch(/^~ object Carton, pose, position: .* mm → 500, 0, 900 mm \(moved by [\d.]+ mm\)$/);
  expect(lines[1]).toMatch(/^~ frame Carton corner/);
  expect(lines[2]).toBe(`~ cell, name: ${cell.name} → Line 2`);
  const json = diff([EXAMPLE, "-", "--json"], after);
  expect(
    json.stdout
      .trim()
      .split("\n")
      .map(line => (JSON.parse(line) as { kind: string }).kind),
  ).toEqual(["changed", "changed", "changed"]);
});

test("diff of one file, or of a file that is no cell, is one sentence and exit 2", () => {
  expect(diff([EXAMPLE]).status).toBe(2);
  const wrong = diff([EXAMPLE, "package.json"]);
  expect(wrong.status).toBe(2);
  expect(wrong.stderr).toContain("package.json");
});
