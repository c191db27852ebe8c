import { readFileSync } from "node:fs";
import {
  boxMesh,
  brakingDistance_m,
  CellCollider,
  flangePose,
  linkSolids,
  manualScheduler,
  parseRobot,
  pose,
  robotAndCell,
  robotById,
  type CellGeometry,
  type Robot,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { createVirtualController } from "../virtual/index.ts";
import { clearOf } from "./clear-of.ts";
import { createGuard } from "./guard.ts";

const MARGIN_M = 0.03;
/** A robot that comes as one data file alone. */
function fromData(name: string): Robot {
  const read = parseRobot(
    JSON.parse(readFileSync(new URL(`../../../../examples/robots/${name}.json`, import.meta.url), "utf8")),
  );
  if (read.kind !== "robot") throw new Error(JSON.stringify(read.faults));
  return read.robot;
}

/** A tall post where the flange passes when joint 1 turns by 1 rad from home, and the stand under the robot. */
function cellFor(robot: Robot): CellGeometry {
  const [x, y] = flangePose(
    robot.arm,
    robot.home_rad.map((q, k) => (k === 0 ? q + 1 : q)),
  ).position;
  return {
    worldFromBase: pose(),
    links: linkSolids(robot),
    allowedPairs: [],
    shapeError_m: robot.shapeError_m,
    objects: [
      { id: "post", name: "Post", worldFromObject: pose([x, y, 1]), mesh: boxMesh([0.06, 0.06, 2]) },
      { id: "stand", name: "Stand", worldFromObject: pose([0, 0, -0.3]), mesh: boxMesh([0.3, 0.3, 0.4]) },
    ],
  };
}
const turned = (robot: Robot, by: number): number[] => robot.home_rad.map((q, k) => (k === 0 ? q + by : q));

describe.each([
  ["ur10e", robotById("ur10e")!],
  ["kuka_kr6r900sixx", robotById("kuka_kr6r900sixx")!],
  ["a robot read from data", fromData("small-arm")],
] as const)("T-45 T-68 %s is protected by one call, from the model alone", (_, robot) => {
  const cell = cellFor(robot);
  const clear = clearOf(cell, robot, { margin_m: MARGIN_M });
  const bench = () => {
    const scheduler = manualScheduler();
    const real = createVirtualController({ robot, scheduler, start_rad: robot.home_rad });
    const guard = createGuard({ controller: real, scheduler, isSafe: clear.isSafe });
    const me = guard.seat("me");
    const collider = new CellCollider(cell, robot.arm);
    me.acquireLease();
    collider.allowContactsAt(robot.home_rad);
    const seen = { least_m: Infinity, stoppedAt: 0 };
    real.onSample(({ q_rad }) => {
      seen.least_m = Math.min(seen.least_m, collider.clearance(q_rad, 0.4, undefined, robotAndCell).distance_m);
    });
    return { scheduler, real, guard, me, seen };
  };

  test("T-42 a point in the post is refused with its reason, one beyond it is not", async () => {
    const { guard, me } = bench();
    expect(guard.pointRefusal(robot.home_rad)).toBe(null);
    expect(guard.pointRefusal(turned(robot, 1))).toMatchObject({ code: "guard.clearance" });
    expect(guard.pointRefusal(turned(robot, 2))).toBe(null);
    expect(clear.inTheWay(turned(robot, 1))).toMatchObject({ b: "post", between: "other" });
    expect(await me.robot.moveJoints(turned(robot, 1))).toMatchObject({ kind: "refused" });
  });

  test("T-43 T-63 at 100 % speed it stops before contact within its braking distance, goes back, and has room", async () => {
    const { scheduler, real, guard, me, seen } = bench();
    const command = me.robot.moveJoints(turned(robot, 2));
    let speed_mps = 0;
    let trippedAt: number[] | null = null;
    let before = real.jointAngles();
    for (let i = 0; i < 2000 && guard.state.trip === "none"; i++) {
      await scheduler.elapse(0.004);
      const here = real.jointAngles();
      const [a, b] = [flangePose(robot.arm, before).position, flangePose(robot.arm, here).position];
      if (guard.state.trip === "none")
        speed_mps = Math.max(speed_mps, Math.hypot(...a.map((v, k) => v - b[k]!)) / 0.004);
      trippedAt = [...here];
      before = here;
    }
    expect(guard.state.trip).not.toBe("none");
    while (guard.state.motion === "stopping") await scheduler.elapse(0.004);
    const stood = real.jointAngles();
    const [a, b] = [flangePose(robot.arm, trippedAt!).position, flangePose(robot.arm, stood).position];
    // What the screen shows as the braking distance is not exceeded, and nothing was touched.
    expect(Math.hypot(...a.map((v, k) => v - b[k]!))).toBeLessThanOrEqual(brakingDistance_m(robot, speed_mps) + 0.002);
    await scheduler.elapse(4);
    expect((await command).kind).toBe("stopped");
    expect(seen.least_m).toBeGreaterThan(0);
    expect(guard.state).toMatchObject({ motion: "at-rest", trip: "none" });
    expect(clear.isSafe(real.jointAngles())).toBe(true);
  });
});

describe("T-64 what is kept is never less than what is not known", () => {
  const robot = robotById("ur10e")!;
  const cell = cellFor(robot);

  test("margin, registration error and shape error add up, and are told", () => {
    expect(clearOf(cell, robot, { margin_m: 0.01, registrationError_m: 0.004 }).kept_m).toBeCloseTo(
      0.014 + robot.shapeError_m,
      12,
    );
    expect(clearOf(cell, robot, { margin_m: 0, registrationError_m: 0.004 }).kept_m).toBeGreaterThanOrEqual(0.004);
  });

  test("a worse registration refuses points that a better one takes", () => {
    let taken = 0;
    let refused = 0;
    const good = clearOf(cell, robot, { margin_m: 0.005 });
    const bad = clearOf(cell, robot, { margin_m: 0.005, registrationError_m: 0.05 });
    for (let by = 0; by < 1; by += 0.01) {
      const q = turned(robot, by);
      if (bad.isSafe(q)) expect(good.isSafe(q)).toBe(true);
      if (good.isSafe(q)) taken++;
      if (good.isSafe(q) && !bad.isSafe(q)) refused++;
    }
    expect(taken).toBeGreaterThan(50);
    expect(refused).toBeGreaterThan(2);
  });
});

test("T-44 a robot in direct control is kept from its own stand", () => {
  const robot = robotById("ur10e")!;
  const clear = clearOf(cellFor(robot), robot, { margin_m: 0.01 });
  // Folded down beside itself the hand meets the stand.
  const hit = Array.from({ length: 400 }, (_, i) => [
    0,
    0.2 + (i % 20) * 0.08,
    1.2 + Math.floor(i / 20) * 0.08,
    0,
    0,
    0,
  ])
    .map(q => clear.inTheWay(q))
    .filter(contact => contact?.b === "stand");
  expect(hit.length).toBeGreaterThan(0);
  expect(clear.isSafe(robot.home_rad)).toBe(true);
});
