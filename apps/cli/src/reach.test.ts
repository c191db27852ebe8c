import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { afterAll, describe, expect, test } from "vitest";

const root = fileURLToPath(new URL("../../../", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "twincell-reach-"));
afterAll(() => {
  rmSync(folder, { recursive: true, force: true });
});

interface Report {
  points: { step: string; name: string; postures: number; room?: { joint: number; value: number } }[];
  reached: number;
  leastRoom: { joint: number; value: number };
}
function reach(...args: readonly string[]) {
  const run = spawnSync(process.execPath, ["apps/cli/src/main.ts", "reach", ...args], { cwd: root, encoding: "utf8" });
  return { code: run.status, out: run.stdout, err: run.stderr };
}

describe("X-35 the reach report from the command line", () => {
  const example = ["examples/01-edge-trace/program.json", "--cell", "examples/01-edge-trace/cell.json"];

  test("every taught point of the edge trace is reached, in at least one posture, with its room to the nearest limit", () => {
    const { code, out, err } = reach(...example);
    const report = JSON.parse(out) as Report;
    expect(code).toBe(0);
    expect(report.points.length).toBeGreaterThan(4);
    expect(report.reached).toBe(report.points.length);
    expect(Math.min(...report.points.map(point => point.postures))).toBeGreaterThanOrEqual(1);
    expect(report.leastRoom.value).toBe(Math.min(...report.points.map(point => point.room!.value)));
    expect(err).toBe(`${report.reached} of ${report.points.length} points are reached.\n`);
  });

  test("a point out of reach ends with 1 and stands in the table with its reason", () => {
    const program = JSON.parse(readFileSync(`${root}${example[0]}`, "utf8")) as {
      steps: { target?: object }[];
    };
    program.steps[2]!.target = {
      pose: { position: [9, 0, 1], quaternion: [1, 0, 0, 0] },
      frame: "world",
      tool: "flange",
    };
    const path = join(folder, "far.json");
    writeFileSync(path, JSON.stringify(program));
    const table = join(folder, "reach.csv");
    const { code, out } = reach(path, "--cell", example[2]!, "--table", table);
    const report = JSON.parse(out) as Report;
    expect(code).toBe(1);
    expect(report.points.length - report.reached).toBe(1);
    expect(readFileSync(table, "utf8").trim().split("\n")).toHaveLength(report.points.length + 1);
  });

  test("without a program it says what is missing", () => {
    const { code, err } = reach();
    expect(code).toBe(2);
    expect(err).toContain("PROGRAM is missing.");
  });
});
