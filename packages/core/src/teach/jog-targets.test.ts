import { compose, distance, flangePose, fromAxisAngle, identity, robotById, rotate } from "../index.ts";
import { expect, test } from "vitest";
import { cartesianTarget, jointTarget, shiftFlange } from "./jog-targets.ts";

const robot = robotById("ur10e")!;
const q_rad = robot.home_rad;
const limits = (joint: number) => robot.arm.joints[joint - 1]!.limits;

test("a joint step turns one joint by that much and a held joint ends 0.001 rad inside its limit", () => {
  const step = jointTarget(robot, q_rad, 2, 0.02);
  expect(step.map((angle, j) => angle - q_rad[j]!)).toEqual([0, expect.closeTo(0.02, 12), 0, 0, 0, 0]);
  expect(jointTarget(robot, q_rad, 3, Infinity)[2]).toBeCloseTo(limits(3).upper_rad - 1e-3, 12);
  expect(jointTarget(robot, q_rad, 3, -Infinity)[2]).toBeCloseTo(limits(3).lower_rad + 1e-3, 12);
});

test("a joint that stands at its limit is not turned back by a jog towards it", () => {
  const at = Array.from(q_rad);
  at[0] = limits(1).upper_rad;
  expect(jointTarget(robot, at, 1, 0.1)).toEqual(at);
});

test("T-38 ten Cartesian steps of 10 mm along each base axis move the flange 100 mm along it and turn nothing", () => {
  for (const axis of [0, 1, 2] as const) {
    let at = Array.from(q_rad);
    for (let i = 0; i < 10; i++) at = cartesianTarget(robot, at, axis, -0.01, "base")!;
    const from = flangePose(robot.arm, q_rad);
    const to = flangePose(robot.arm, at);
    for (const i of [0, 1, 2]) expect(to.position[i]! - from.position[i]!).toBeCloseTo(i === axis ? -0.1 : 0, 7);
    for (const i of [0, 1, 2, 3]) expect(Math.abs(to.quaternion[i]!)).toBeCloseTo(Math.abs(from.quaternion[i]!), 7);
  }
});

test("a jog in the flange's axes goes along its own z, one in the base's along the base's", () => {
  const from = flangePose(robot.arm, q_rad);
  const down = shiftFlange(from, 2, 0.1, "flange");
  const z = [
    down.position[0] - from.position[0],
    down.position[1] - from.position[1],
    down.position[2] - from.position[2],
  ];
  expect(Math.hypot(...z)).toBeCloseTo(0.1, 12);
  expect(shiftFlange(from, 2, 0.1, "base").position[2] - from.position[2]).toBeCloseTo(0.1, 12);
});

test("a held Cartesian jog ends where the arm ends, and a whole step beyond reach is none", () => {
  const held = cartesianTarget(robot, q_rad, 0, Infinity, "base");
  expect(held).not.toBeNull();
  const from = flangePose(robot.arm, q_rad).position[0];
  const gone_m = flangePose(robot.arm, held!).position[0] - from;
  expect(gone_m).toBeGreaterThan(0.005);
  expect(gone_m).toBeLessThan(0.5 + 1e-9);
  let at = held!;
  for (let presses = 0; presses < 10; presses++) at = cartesianTarget(robot, at, 0, Infinity, "base") ?? at;
  expect(cartesianTarget(robot, at, 0, 0.01, "base")).toBeNull();
});

test("a step farther than one held press goes its whole way, or none of it", () => {
  const from = flangePose(robot.arm, q_rad).position[1];
  const far = cartesianTarget(robot, q_rad, 1, 0.6, "base");
  expect(far === null ? null : flangePose(robot.arm, far).position[1] - from).toBeCloseTo(0.6, 7);
  expect(cartesianTarget(robot, q_rad, 1, 60, "base")).toBeNull();
});

test("axes of their own: a step goes along them, a turn leaves the tool centre point where it is", () => {
  const flangeFromTcp = { ...identity<"flange", "tcp">(), position: [0, 0.05, 0.2] as [number, number, number] };
  const axes = { baseFromAxes: fromAxisAngle([0, 0, 1], Math.PI / 2), flangeFromTcp };
  const tcp = (q: ArrayLike<number>) => compose(flangePose(robot.arm, q), flangeFromTcp);
  const from = tcp(q_rad);
  const moved = tcp(cartesianTarget(robot, q_rad, 0, -0.02, axes)!);
  const along = rotate(axes.baseFromAxes, [1, 0, 0]);
  for (const i of [0, 1, 2]) expect(moved.position[i]! - from.position[i]!).toBeCloseTo(-0.02 * along[i]!, 7);
  const turned = tcp(cartesianTarget(robot, q_rad, 5, 0.1, axes)!);
  expect(distance(turned.position, from.position)).toBeLessThan(1e-7);
  const x = rotate(turned.quaternion, [1, 0, 0]);
  const x0 = rotate(from.quaternion, [1, 0, 0]);
  expect(Math.hypot(x[0] - x0[0], x[1] - x0[1], x[2] - x0[2])).toBeGreaterThan(0.01);
});
