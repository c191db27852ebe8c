/**
 * Poses in V+ numbers that scipy, robodk and pinocchio worked out: neither the emitter nor the interpreter had a hand
 * in them.
 */
import { readFileSync } from "node:fs";
import {
  angleBetween,
  compose,
  distance,
  emptyProgram,
  flangePose,
  fromMatrix,
  pose,
  robotById,
  type MoveStep,
  type Pose,
  type Program,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { PROOF_TOLERANCE, vPlus } from "../index.ts";

interface Orientation {
  readonly matrix: readonly (readonly number[])[];
  readonly vplus_ypr_deg: readonly number[];
}
interface Sample {
  readonly q: readonly number[];
  /** Rows of baseFromFlange. */
  readonly T: readonly (readonly number[])[];
  /** Of the flange, in mm from the shoulder; its angles are those of another language. */
  readonly vendor_pose: { readonly X: number; readonly Y: number; readonly Z: number };
}
const fixture = <T>(path: string): T =>
  JSON.parse(readFileSync(new URL(`../../../../fixtures/${path}`, import.meta.url), "utf8")) as T;
const orientations = fixture<{ readonly cases: readonly Orientation[] }>("conventions/orientations.json").cases;
const samples = fixture<{ readonly samples: readonly Sample[] }>("kinematics/staubli_rx90l.forward.json").samples;
const robot = robotById("staubli_rx90l")!;

/** A robot of unlimited reach that stands with its shoulder in the origin, for poses that no arm reaches. */
const anywhere = { ...robot, baseFromVendorWorld: pose<"base", "vendor-world">() };

/**
 * Yaw, pitch and roll [deg] read off the matrix Rz(y)·Ry(p)·Rz(r): its last column is (cy sp, sy sp, cp), its last row
 * (−sp cr, sp sr, cp).
 */
function anglesOf(rows: Sample["T"]): number[] {
  const angles = [
    Math.atan2(rows[1]![2]!, rows[0]![2]!),
    Math.acos(Math.max(-1, Math.min(1, rows[2]![2]!))),
    Math.atan2(rows[2]![1]!, -rows[2]![0]!),
  ];
  return angles.map(angle => (angle / Math.PI) * 180);
}
const isUpright = ({ T }: Sample): boolean => Math.hypot(T[0]![2]!, T[1]![2]!) < 1e-3;

function executedPose(location: readonly number[], of = robot): Pose {
  const answer = vPlus.interpret(`.PROGRAM a()\nMOVE TRANS(${location.map(x => x.toFixed(9)).join(",")})\n.END\n`, of);
  if (answer.kind !== "ready") throw new Error(JSON.stringify(answer.faults));
  const run = answer.run();
  for (let next = run.next(); next.done !== true; next = run.next()) {
    const { step } = next.value;
    if (step?.type === "move" && "pose" in step.target) return step.target.pose;
  }
  throw new Error("no motion");
}

describe("golden poses", () => {
  test("47 orientations, 7 of them singular: TRANS means the matrix that scipy and robodk say", () => {
    expect(orientations).toHaveLength(47);
    for (const { matrix, vplus_ypr_deg } of orientations) {
      const wanted = fromMatrix(matrix.slice(0, 3).flatMap(row => row.slice(0, 3)));
      const position = matrix.slice(0, 3).map(row => row[3]!);
      const got = executedPose([...position, ...vplus_ypr_deg], anywhere);
      expect(angleBetween(got.quaternion, wanted)).toBeLessThan(PROOF_TOLERANCE.angle_rad);
      for (const [i, v] of got.position.entries())
        expect(Math.abs(v - position[i]! / 1000)).toBeLessThan(PROOF_TOLERANCE.position_m);
    }
  });

  test("200 postures: the V+ location of the flange, counted from the shoulder, is where pinocchio and robodk say", () => {
    expect(samples).toHaveLength(200);
    for (const sample of samples) {
      if (isUpright(sample)) continue;
      const { X, Y, Z } = sample.vendor_pose;
      const wanted = flangePose(robot.arm, sample.q);
      const got = executedPose([X, Y, Z, ...anglesOf(sample.T)]);
      expect(distance(got.position, wanted.position)).toBeLessThan(PROOF_TOLERANCE.position_m);
      expect(angleBetween(got.quaternion, wanted.quaternion)).toBeLessThan(PROOF_TOLERANCE.angle_rad);
    }
  });

  test("what is written for these postures are the same numbers", () => {
    for (const sample of samples) {
      const {
        q,
        vendor_pose: { X, Y, Z },
      } = sample;
      const step: MoveStep = {
        id: "a",
        type: "move",
        path: "ptp",
        target: {
          pose: compose(pose<"frame", "base">(), compose(flangePose(robot.arm, q), pose<"flange", "tcp">())),
          frame: "world",
          tool: "flange",
        },
        speed: { ratio: 1 },
        blend_m: 0,
      };
      const program: Program = { ...emptyProgram(robot.id), steps: [step] };
      const emitted = vPlus.emit(program, robot);
      // A few samples lie on the border of reach: whether they can be exported is not the question here.
      if (emitted.kind === "cannot") continue;
      const numbers = /MOVE TRANS\(([^)]*)\)/.exec(emitted.files[0]!.text)![1]!.split(",").map(Number);
      for (const [i, mm] of [X, Y, Z].entries()) expect(Math.abs(numbers[i]! - mm)).toBeLessThan(1e-3);
      if (isUpright(sample)) continue;
      // Half the difference, so that −180 and 180 are the same.
      for (const [i, angle] of anglesOf(sample.T).entries())
        expect(Math.abs(Math.sin(((numbers[3 + i]! - angle) / 360) * Math.PI)), `${numbers}`).toBeLessThan(1e-5);
    }
  });
});
