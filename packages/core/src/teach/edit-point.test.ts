import { describe, expect, test } from "vitest";
import {
  angleBetween,
  compose,
  distance,
  emptyProgram,
  flangePose,
  fromAxisAngle,
  identity,
  pose,
  robotById,
  solveAll,
  type Pose,
  type Target,
  type Vector3,
} from "../index.ts";
import { seededRandom } from "../random.ts";
import { nearestTo, snapPoint, taughtAgain, type SnapPoint } from "./edit-point.ts";

const robot = robotById("staubli_rx90l")!;
const point = (id: string, x: number, bad: boolean): SnapPoint => ({
  id,
  worldFromTcp: pose<"world", "tcp">([x, 0, 0], [0, 0, 0, 1]),
  bad,
});
const tip: Vector3 = [0, 0, 0];

describe("L-42 the point that EDIT snaps to", () => {
  test("is the nearest bad one within the radius, also where a good one is nearer", () => {
    const points = [point("good", 0.01, false), point("bad far", 0.11, true), point("bad", 0.08, true)];
    expect(snapPoint(points, tip, 0.12)).toMatchObject({ kind: "snapped", point: { id: "bad" } });
    expect(snapPoint(points.toReversed(), tip, 0.12)).toMatchObject({ kind: "snapped", point: { id: "bad" } });
  });
  test("is the nearest of all where no bad one is within the radius; beyond it nothing is snapped to", () => {
    const points = [point("bad", 0.2, true), point("good", 0.05, false)];
    expect(snapPoint(points, tip, 0.12)).toMatchObject({ kind: "snapped", point: { id: "good" }, distance_m: 0.05 });
    expect(snapPoint(points, tip, 0.04)).toMatchObject({ kind: "too-far", point: { id: "good" }, distance_m: 0.05 });
    expect(snapPoint([], tip, 1)).toEqual({ kind: "none" });
  });
});

test("a pose that can be reached is reached; one that cannot is gone towards until nothing more is to be had", () => {
  const random = seededRandom(42);
  for (let i = 0; i < 200; i++) {
    const near = robot.home_rad.map((home, j) => home + (j === 0 ? 1 : 0.4) * (2 * random() - 1));
    const from = flangePose(robot.arm, near);
    const wanted = pose<"base", "flange">(
      [0, 1, 2].map(k => from.position[k as 0] + 1.2 * (2 * random() - 1)) as Vector3,
      from.quaternion,
    );
    const { q_rad, short_m } = nearestTo(robot, wanted, near);
    const there = flangePose(robot.arm, q_rad);
    expect(distance(there.position, wanted.position)).toBeCloseTo(short_m, 6);
    if (solveAll(robot, wanted).kind === "reached") expect(short_m).toBeLessThan(1e-6);
    else {
      expect(short_m).toBeGreaterThan(0);
      expect(short_m).toBeLessThanOrEqual(distance(from.position, wanted.position) + 1e-9);
    }
  }
});

test("a target taught again is where the robot stands, in the frame, the tool and the form it had", () => {
  const random = seededRandom(7);
  const worldFromBase = pose<"world", "base">([0.4, -0.2, 0.6], fromAxisAngle([0, 0, 1], 0.7));
  const frames = { table: pose<"world", "frame">([1, 0.3, 0.2], fromAxisAngle([0, 1, 0], 0.4)) };
  const tools = { torch: pose<"flange", "tcp">([0.02, 0, 0.15], fromAxisAngle([1, 0, 0], 0.2)) };
  const program = { ...emptyProgram(robot.id), frames, tools };
  const target: Target = { pose: identity(), frame: "table", tool: "torch" };
  for (let i = 0; i < 100; i++) {
    const q_rad = robot.home_rad.map(home => home + 2 * random() - 1);
    const again = taughtAgain(target, robot, q_rad, program, worldFromBase);
    if (!("pose" in again)) throw new Error("The form changed.");
    expect([again.frame, again.tool, again.branch]).toEqual(["table", "torch", undefined]);
    const is: Pose = compose(compose(worldFromBase, flangePose(robot.arm, q_rad)), tools.torch);
    const says: Pose = compose(frames.table, again.pose);
    expect(distance(is.position, says.position)).toBeLessThan(1e-12);
    expect(angleBetween(is.quaternion, says.quaternion)).toBeLessThan(1e-7);
    expect(taughtAgain({ q: [1], tool: "torch" }, robot, q_rad, program, worldFromBase)).toEqual({
      q: q_rad,
      tool: "torch",
    });
  }
});
