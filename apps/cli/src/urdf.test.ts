import { spawnSync } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { describe, expect, test } from "vitest";

const root = fileURLToPath(new URL("../../../", import.meta.url));
/** Robots of other people beside the checkout; without them these tests are skipped. */
const ROBOTS = `${root}../shared/robots/`;
const present = existsSync(`${ROBOTS}kuka_kr6r900sixx/robot.urdf`);
const read = (path: string): unknown => JSON.parse(readFileSync(`${ROBOTS}${path}`, "utf8"));

function twincell(
  args: readonly string[],
  lines: readonly unknown[],
): { readonly code: number; readonly err: string; readonly lines: unknown[] } {
  const input = lines.map(line => JSON.stringify(line)).join("\n");
  const run = spawnSync(process.execPath, ["apps/cli/src/main.ts", ...args], {
    cwd: root,
    input,
    encoding: "utf8",
    maxBuffer: 1 << 26,
  });
  return {
    code: run.status ?? -1,
    err: run.stderr,
    lines: run.stdout
      .trim()
      .split("\n")
      .filter(line => line !== "")
      .map(line => JSON.parse(line) as unknown),
  };
}
const wrapped = (angle: number): number => Math.abs(angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI)));

describe.skipIf(!present)("a robot from its URDF (the robots are not beside this checkout when skipped)", () => {
  for (const id of ["kuka_kr6r900sixx", "yaskawa_gp8", "staubli_rx160"]) {
    test(`N-66 ${id}: forward kinematics in the root and in the vendor's base, and every solution of the reference`, () => {
      const robot = `${ROBOTS}${id}/robot.urdf`;
      const { samples } = read(`${id}/reference_fk.json`) as {
        samples: { q: number[]; T: number[][]; vendor_pose: { X: number; Y: number; Z: number } }[];
      };
      const poses = twincell(
        ["fk", "--robot", robot],
        samples.map(({ q }) => ({ q })),
      ).lines as { position: number[]; quaternion: number[] }[];
      const vendor = twincell(
        ["fk", "--robot", robot, "--base", "base"],
        samples.map(({ q }) => ({ q })),
      ).lines as { position: number[] }[];
      expect(poses.length).toBe(200);
      samples.forEach(({ T, vendor_pose: { X, Y, Z } }, i) => {
        for (const axis of [0, 1, 2]) expect(Math.abs(poses[i]!.position[axis]! - T[axis]![3]!)).toBeLessThan(1e-9);
        [X, Y, Z].forEach((mm, axis) => {
          expect(Math.abs(vendor[i]!.position[axis]! - mm / 1000)).toBeLessThan(1e-9);
        });
      });
      const inverse = read(`${id}/reference_ik.json`) as { poses: { seed_q: number[]; solutions: number[][] }[] };
      const wanted = twincell(
        ["fk", "--robot", robot],
        inverse.poses.map(({ seed_q }) => ({ q: seed_q })),
      ).lines;
      const answers = twincell(["ik", "--robot", robot], wanted).lines as { solutions: number[][] }[];
      inverse.poses.forEach(({ solutions }, i) => {
        expect(answers[i]!.solutions.length).toBe(solutions.length);
        for (const solution of solutions) {
          expect(
            Math.min(
              ...answers[i]!.solutions.map(got => Math.max(...got.map((angle, j) => wrapped(angle - solution[j]!)))),
            ),
          ).toBeLessThan(1e-6);
        }
      });
    });
  }
  test("arms of other families are solved as well, each with all its postures; a wrong link is named", () => {
    const ur10e = `${ROBOTS}ur10e/robot.urdf`;
    for (const [path, q, count] of [
      [ur10e, [0.3, -1, 1.2, 0.4, 0.8, -0.2], 8],
      [`${ROBOTS}kuka_lbr_iiwa_14_r820/robot.urdf`, [0.3, 0.7, -0.4, -1.2, 0.5, 0.9, 0.2], 8],
      [
        `${ROBOTS}abb_crb15000_5_95/robot.urdf`,
        [0.785997997765218, 2.49576791806099, 0.26987265218164, -1.7265741463697, -1.2555922625249, 2.3471055195601],
        8,
      ],
    ] as const) {
      const [pose] = twincell(["fk", "--robot", path], [{ q }]).lines;
      const [answer] = twincell(["ik", "--robot", path, "--near", q.join(",")], [pose]).lines as {
        solutions: number[][];
        reach: { kind: string };
      }[];
      expect(answer!.reach.kind).toBe("reached");
      expect(answer!.solutions).toHaveLength(count);
      answer!.solutions[0]!.forEach((angle, j) => {
        expect(angle).toBeCloseTo(q[j]!, 8);
      });
    }
    expect(twincell(["fk", "--robot", ur10e, "--tip", "nose"], [])).toMatchObject({
      code: 2,
      err: expect.stringContaining("has no link nose") as string,
    });
  });
});

test("a URDF that is not there is named, exit 2", () => {
  expect(twincell(["fk", "--robot", "nowhere.urdf"], [])).toMatchObject({
    code: 2,
    err: expect.stringContaining("nowhere.urdf cannot be read") as string,
  });
});
