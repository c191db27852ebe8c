import { spawnSync } from "node:child_process";
import { fileURLToPath } from "node:url";
import { readFileSync } from "node:fs";
import { expect, test } from "vitest";

const root = fileURLToPath(new URL("../../../", import.meta.url));
function calibrate(
  what: string,
  input: unknown,
  ...more: string[]
): { readonly code: number; readonly err: string; readonly answer: Record<string, unknown> } {
  const run = spawnSync(process.execPath, ["apps/cli/src/main.ts", "calibrate", what, "-", ...more], {
    cwd: root,
    input: JSON.stringify(input),
    encoding: "utf8",
  });
  return {
    code: run.status ?? -1,
    err: run.stderr,
    answer: run.stdout === "" ? {} : (JSON.parse(run.stdout) as Record<string, unknown>),
  };
}
const golden = JSON.parse(readFileSync(`${root}fixtures/calibration/calibration.json`, "utf8")) as {
  tips: { touches: unknown[]; tip: number[]; rms_m: number }[];
  registrations: { known: number[][]; measured: number[][]; position: number[] }[];
};

test("calibrate tcp gives the tip, its residual and what is missing", () => {
  const { touches, tip, rms_m } = golden.tips[4]!;
  const { code, answer } = calibrate("tcp", { touches });
  expect(code).toBe(0);
  (answer["flangeFromTcp"] as { position: number[] }).position.forEach((value, i) => {
    expect(value).toBeCloseTo(tip[i]!, 9);
  });
  expect(answer["rms_m"]).toBeCloseTo(rms_m, 9);
  expect((answer["each_m"] as number[]).length).toBe(touches.length);
  const few = calibrate("tcp", { touches: touches.slice(0, 2) });
  expect([few.code, few.answer["sentence"]]).toEqual([1, "4 touches are the least; 2 were given."]);
});

test("calibrate tcp takes joint angles of a robot", () => {
  // Turns of the wrist alone: the touched point is the wrist centre, 85 mm behind the flange.
  const touches = [
    [0.3, 0.5, 0.1],
    [1, 0.9, -1],
    [-1.5, 0.7, 2],
    [2, -0.6, 0.4],
    [-0.4, -0.8, -2],
  ].map(wrist => ({ q: [0.4, -1, 1.4, ...wrist] }));
  const { code, answer } = calibrate("tcp", { touches }, "--robot", "staubli_rx90l");
  expect(code).toBe(0);
  (answer["flangeFromTcp"] as { position: number[] }).position.forEach((value, i) => {
    expect(value).toBeCloseTo([0, 0, -0.085][i]!, 9);
  });
  const without = calibrate("tcp", { touches });
  expect([without.code, without.err]).toEqual([2, "twincell: -: touch 1 holds joint angles; --robot is missing.\n"]);
});

test("calibrate frame takes three points or pairs of known and measured ones", () => {
  const three = calibrate("frame", { origin: [1, 0, 0.5], alongX: [1, 0.4, 0.5], inXy: [0.7, 0.1, 0.5] });
  expect(three.code).toBe(0);
  expect(three.answer).toMatchObject({ kind: "frame", frame: { position: [1, 0, 0.5] } });
  (three.answer["frame"] as { quaternion: number[] }).quaternion.forEach((value, i) => {
    expect(value).toBeCloseTo([0, 0, Math.SQRT1_2, Math.SQRT1_2][i]!, 12);
  });
  const { known, measured, position } = golden.registrations[2]!;
  const pairs = calibrate("frame", { points: known.map((point, i) => ({ known: point, measured: measured[i] })) });
  expect(pairs.code).toBe(0);
  (pairs.answer["frame"] as { position: number[] }).position.forEach((value, i) => {
    expect(value).toBeCloseTo(position[i]!, 9);
  });
  expect(calibrate("frame", { origin: [0, 0, 0], alongX: [1, 0, 0], inXy: [2, 0, 0] })).toMatchObject({
    code: 1,
    answer: { kind: "in-line" },
  });
  expect(calibrate("frame", { origin: [0, 0], alongX: [1, 0, 0], inXy: [2, 0, 0] })).toMatchObject({
    code: 2,
    err: 'twincell: -: "origin" wants three finite numbers.\n',
  });
});
