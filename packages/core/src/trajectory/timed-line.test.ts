import { describe, expect, test } from "vitest";
import { flangePose } from "../kinematics/forward.ts";
import { seededRandom } from "../random.ts";
import { robotById } from "../robots/library/index.ts";
import type { Pose } from "../spatial/pose.ts";
import { angleBetween, fromAxisAngle, multiply, type Quaternion } from "../spatial/quaternion.ts";
import { fromEulerAngles, toEulerAngles } from "../spatial/turns.ts";
import { distance, subtract, type Vector3 } from "../spatial/vector.ts";
import { FrameCheck, TimedLine, type FrameVerdict } from "./timed-line.ts";

const robot = robotById("staubli_rx90l")!;
const at = (position: Vector3, quaternion: Quaternion): Pose => ({ position, quaternion });
const DOWN: Quaternion = [1, 0, 0, 0];
const A = at([0.6, -0.2, 0.5], DOWN);
const B = at([0.5, 0.3, 0.6], multiply(fromAxisAngle([0, 0, 1], 0.5), multiply(fromAxisAngle([0, 1, 0], 0.2), DOWN)));
/** A posture near A, by which the wrist is not upside down. */
const NEAR = [0, -0.9, 2.2, 0, 0.6, 0];

function drive(
  line: TimedLine,
  fps: number,
): { readonly verdicts: FrameVerdict[]; readonly check: FrameCheck; readonly fastest: number } {
  const check = new FrameCheck(robot, NEAR);
  const verdicts: FrameVerdict[] = [];
  const frames = Math.round(line.duration_s * fps);
  let fastest = 0;
  for (let k = 0; k <= frames; k++) {
    verdicts.push(check.frame(line.at(k / fps) as Pose<"base", "flange">, 1 / fps));
    fastest = Math.max(fastest, ...check.qd_rad_s.map(Math.abs));
  }
  return { verdicts, check, fastest };
}

describe("the timed line of the lead-through paper", () => {
  test("L-50 stays on its chord", () => {
    const line = new TimedLine(A, B, 2);
    const way = subtract(B.position, A.position);
    const length = distance(A.position, B.position);
    for (let k = 0; k <= 1000; k++) {
      const p = subtract(line.at(k * 2e-3).position, A.position);
      const along = (p[0] * way[0] + p[1] * way[1] + p[2] * way[2]) / length;
      expect(Math.sqrt(Math.max(0, p[0] * p[0] + p[1] * p[1] + p[2] * p[2] - along * along))).toBeLessThan(1e-7);
    }
  });

  test("L-51 G-07 rests at both ends, is half way at half time, and is fastest there with 1.5 / T of the way", () => {
    const line = new TimedLine(A, B, 2);
    const length = distance(A.position, B.position);
    const speedAt = (t: number): number => distance(line.at(t - 1e-5).position, line.at(t + 1e-5).position) / 2e-5;
    expect(line.at(0).position).toEqual(A.position);
    expect(distance(line.at(2).position, B.position)).toBeLessThan(1e-15);
    expect(distance(line.at(1).position, A.position)).toBeCloseTo(length / 2, 12);
    expect(speedAt(1)).toBeCloseTo((1.5 / 2) * length, 7);
    for (const t of [0.3, 0.7, 1.4]) expect(speedAt(t)).toBeLessThan(speedAt(1));
    // Acceleration at the start: 6 / T² of the way.
    expect((2 * distance(line.at(1e-4).position, A.position)) / 1e-8).toBeCloseTo((6 / 4) * length, 3);
  });

  test("L-52 E-24 turn angles go by the same cubic, or evenly when asked", () => {
    const a = toEulerAngles("yxz", A.quaternion);
    const b = toEulerAngles("yxz", B.quaternion);
    const mixed = (share: number): Quaternion =>
      fromEulerAngles(
        "yxz",
        ...([0, 1, 2].map(i => {
          const d = b[i]! - a[i]!;
          return a[i]! + Math.atan2(Math.sin(d), Math.cos(d)) * share;
        }) as [number, number, number]),
      );
    for (const tau of [0.1, 0.25, 0.5, 0.8]) {
      expect(
        angleBetween(new TimedLine(A, B, 3).at(3 * tau).quaternion, mixed(tau * tau * (3 - 2 * tau))),
      ).toBeLessThan(1e-7);
      expect(
        angleBetween(new TimedLine(A, B, 3, { angles: "linear" }).at(3 * tau).quaternion, mixed(tau)),
      ).toBeLessThan(1e-7);
    }
  });

  test("L-53 half the time is twice the speed", () => {
    const slow = drive(new TimedLine(A, B, 4), 500).fastest;
    const fast = drive(new TimedLine(A, B, 2), 1000).fastest;
    expect(fast / slow).toBeCloseTo(2, 6);
  });

  test("L-54 30, 60, 90 and jittered frames see the same path at the same instants", () => {
    const random = seededRandom(8);
    const line = new TimedLine(A, B, 2);
    const jittered = new TimedLine(A, B, 2);
    for (let t = 0, k = 0; t < 2; t += random() * 0.05, k++) jittered.at(t);
    for (const fps of [30, 60, 90]) {
      for (let k = 0; k <= 2 * fps; k += fps / 30)
        expect(line.at(k / fps)).toEqual(jittered.at(Math.round((k * 30) / fps) / 30));
    }
  });

  test("L-25 L-55 the six steps: define, sample, solve each frame, check positions, differentiate, check speeds", () => {
    const line = new TimedLine(A, B, 2);
    const { verdicts, check } = drive(line, 60);
    expect(verdicts).toHaveLength(121);
    expect(verdicts.every(({ kind }) => kind === "fine")).toBe(true);
    expect(distance(flangePose(robot.arm, check.q_rad).position, B.position)).toBeLessThan(1e-9);
    const before = new FrameCheck(robot, NEAR);
    const h = 1 / 60;
    before.frame(line.at(1) as Pose<"base", "flange">, h);
    const q = before.q_rad.slice();
    before.frame(line.at(1 + h) as Pose<"base", "flange">, h);
    before.qd_rad_s.forEach((rate, j) => {
      expect(rate).toBeCloseTo((before.q_rad[j]! - q[j]!) / h, 12);
    });
  });

  test("L-26 L-56 a move that is too fast names the joint and its speed", () => {
    const found = drive(new TimedLine(A, B, 0.1), 240).verdicts.find(({ kind }) => kind !== "fine");
    expect(found).toMatchObject({ kind: "speed" });
    if (found?.kind !== "speed") return;
    expect(Math.abs(found.value)).toBeGreaterThan(found.limit);
    expect(found.limit).toBe(robot.arm.joints[found.joint - 1]!.limits.speed_rad_s);
    expect(found.sentence).toMatch(
      new RegExp(`^Joint speed q̇${found.joint} out of limit: -?[0-9.]+°/s, its limit is [0-9.]+°/s\\.$`),
    );
  });

  test("L-56 a posture beyond a limit names the joint and its angle", () => {
    const narrow = {
      ...robot,
      arm: {
        ...robot.arm,
        joints: robot.arm.joints.map((joint, j) =>
          j === 3 ? { ...joint, limits: { ...joint.limits, lower_rad: 0.9, upper_rad: 1 } } : joint,
        ),
      },
    };
    const over = new FrameCheck(narrow, NEAR).frame(flangePose(robot.arm, [0.2, -0.9, 2.2, 0.5, 0.6, 0.1]), 0.01);
    expect(over).toMatchObject({ kind: "position", joint: 4 });
    if (over.kind === "position")
      expect(over.sentence).toMatch(/^Joint position q4 out of limit: -?[0-9.]+°, its limit is [0-9.]+°\.$/);
  });

  test("a pose out of reach says why", () => {
    expect(new FrameCheck(robot, NEAR).frame(at([2, 0, 0.4], DOWN) as Pose<"base", "flange">, 0.01)).toMatchObject({
      kind: "unreachable",
      reach: { kind: "too-far" },
    });
  });
});
