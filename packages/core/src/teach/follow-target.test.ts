import { describe, expect, test } from "vitest";
import {
  angleBetween,
  compose,
  distance,
  flangePose,
  followScratch,
  followTarget,
  fromAxisAngle,
  identity,
  pose,
  robotById,
  type JogCell,
  type Pose,
  type Vector3,
} from "../index.ts";

const DT = 1 / 60;
const tcpOf = (cell: JogCell, q: ArrayLike<number>): Pose<"world", "tcp"> =>
  compose(compose(cell.worldFromBase, flangePose(cell.robot.arm, q)), cell.flangeFromTcp);
/** A path on a sphere about the start: a spiral from its equator up, the tool swaying with it. */
const onSphere = (start: Pose<"world", "tcp">, radius_m: number, angle: number): Pose<"world", "tcp"> => {
  const up = 0.5 * Math.sin(angle / 3);
  const shift: Vector3 = [
    radius_m * (Math.cos(angle) * Math.cos(up) - 1),
    radius_m * Math.sin(angle) * Math.cos(up),
    radius_m * Math.sin(up),
  ];
  return compose(
    pose<"world", "world">([start.position[0] + shift[0], start.position[1] + shift[1], start.position[2] + shift[2]]),
    pose<"world", "tcp">(
      [0, 0, 0],
      compose(pose([0, 0, 0], fromAxisAngle([0, 0, 1], 0.2 * Math.sin(angle))), pose([0, 0, 0], start.quaternion))
        .quaternion,
    ),
  );
};
const arms = [
  ["staubli_rx90l", [0.3, -1.2, 2.4, 0.2, 0.6, 0]],
  ["ur10e", [0.3, -1.2, 1.8, -2.1, -1.4, 0.2]],
  ["kuka_lbr_iiwa_14_r820", [0.2, 0.5, 0.1, -1.2, 0.3, 0.9, 0]],
] as const;

describe.each(arms)("%s", (id, start_rad) => {
  const robot = robotById(id)!;
  const cell: JogCell = {
    robot,
    worldFromBase: pose([0.5, 0.2, 0], fromAxisAngle([0, 0, 1], 0.4)),
    flangeFromTcp: pose([0, 0.02, 0.1]),
  };
  const within = (before: ArrayLike<number>, q: ArrayLike<number>): boolean =>
    robot.arm.joints.every(
      ({ limits }, j) =>
        Math.abs(q[j]! - before[j]!) <= limits.speed_rad_s * DT * (1 + 1e-9) &&
        q[j]! >= limits.lower_rad - 1e-9 &&
        q[j]! <= limits.upper_rad + 1e-9,
    );

  test("X-18 the tip follows a target along a sphere, exactly while the joints are fast enough", () => {
    const q = Float64Array.from(start_rad);
    const start = tcpOf(cell, q);
    const scratch = followScratch(robot);
    for (let frame = 1; frame <= 600; frame++) {
      const target = onSphere(start, 0.1, frame * 0.02);
      const before = q.slice();
      expect(followTarget(cell, target, q, DT, q, scratch)).toEqual({ kind: "on-target" });
      const tcp = tcpOf(cell, q);
      expect(distance(tcp.position, target.position)).toBeLessThan(3e-9);
      expect(angleBetween(tcp.quaternion, target.quaternion)).toBeLessThan(3e-9);
      expect(within(before, q)).toBe(true);
    }
  });

  test("X-18 a target that runs ahead is followed at joint speed with a bounded lag, and met where it stops", () => {
    const q = Float64Array.from(start_rad);
    const start = tcpOf(cell, q);
    const scratch = followScratch(robot);
    let behind = 0;
    let angle = 0;
    for (let frame = 1; frame <= 200; frame++) {
      if (frame < 120) angle += 0.6; // 3.6 m/s
      const target = onSphere(start, 0.1, angle);
      const before = q.slice();
      const followed = followTarget(cell, target, q, DT, q, scratch);
      if (followed.kind === "behind") {
        behind++;
        expect(followed.position_m).toBeLessThan(0.25);
        expect(followed.joint).toBeGreaterThan(0);
      }
      expect(within(before, q)).toBe(true);
      if (frame > 150) expect(followed.kind).toBe("on-target");
    }
    expect(behind).toBeGreaterThan(10);
  });

  test("X-18 a target out of reach is approached as near as can be and the reason told; back in reach it is met again", () => {
    const q = Float64Array.from(start_rad);
    const start = tcpOf(cell, q);
    const scratch = followScratch(robot);
    const away = pose<"world", "tcp">([start.position[0] + 4, start.position[1], start.position[2]], start.quaternion);
    let last = followTarget(cell, away, q, DT, q, scratch);
    for (let frame = 0; frame < 200; frame++) {
      const before = q.slice();
      last = followTarget(cell, away, q, DT, q, scratch);
      expect(within(before, q)).toBe(true);
    }
    expect(last).toMatchObject({ kind: "out-of-reach" });
    expect(last.kind === "out-of-reach" && last.sentence).toMatch(/^[A-Z].*\d.*\.$/);
    expect(distance(tcpOf(cell, q).position, away.position)).toBeLessThan(4);
    for (let frame = 0; frame < 300; frame++) last = followTarget(cell, start, q, DT, q, scratch);
    expect(last).toEqual({ kind: "on-target" });
    expect(followTarget(cell, pose([NaN, 0, 0]), q, DT, q, scratch)).toMatchObject({
      kind: "out-of-reach",
      sentence: "A coordinate of the pose is not a finite number.",
    });
    expect(q.every(Number.isFinite)).toBe(true);
  });
});

test("L-25 inverse kinematics runs at each rendered frame, with a limit check, in a small part of it", () => {
  const robot = robotById("staubli_rx90l")!;
  const cell: JogCell = { robot, worldFromBase: identity(), flangeFromTcp: identity() };
  const q = Float64Array.from([0.3, -1.2, 2.4, 0.2, 0.6, 0]);
  const start = tcpOf(cell, q);
  const scratch = followScratch(robot);
  let inside = 0;
  const began = performance.now();
  const FRAMES = 2000;
  for (let frame = 1; frame <= FRAMES; frame++) {
    followTarget(cell, onSphere(start, 0.25, frame * 0.01), q, DT, q, scratch);
    if (robot.arm.joints.every(({ limits }, j) => q[j]! >= limits.lower_rad - 1e-9 && q[j]! <= limits.upper_rad + 1e-9))
      inside++;
  }
  expect(inside).toBe(FRAMES);
  expect((performance.now() - began) / FRAMES).toBeLessThan(2); // ms; a frame has 16
});
