import {
  boxMesh,
  CellCollider,
  compose,
  emptyProgram,
  flangePose,
  inverse,
  linkSolids,
  manualScheduler,
  pose,
  type CellObject,
  type Dialect,
  type Pose,
  type Program,
  type Robot,
  type Step,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { DRIVER_KINDS, openRobotConnection, robotsOf, type CellDefinition, type DriverKind } from "../index.ts";
import { endedOn } from "../testing/index.ts";

/** An arm that is upright at home leans forward, so that turning joint 1 takes its flange somewhere. */
function ready(robot: Robot): number[] {
  const [x, y] = flangePose(robot.arm, robot.home_rad).position;
  return robot.home_rad.map((q, i) => (i === 1 && Math.hypot(x, y) < 0.2 ? q + 0.8 : q));
}
const turned = (robot: Robot, by_rad: number): number[] => ready(robot).map((q, i) => (i === 0 ? q + by_rad : q));
const beforeFlange = (robot: Robot, q_rad: readonly number[], z_m: number): Pose<"world", "object"> =>
  compose(flangePose(robot.arm, q_rad), pose([0, 0, z_m])) as Pose as Pose<"world", "object">;
/** A bar from 100 to 500 mm before the flange, as it stands at the ready posture. */
const bar = (robot: Robot): CellObject => ({
  id: "bar",
  name: "Bar",
  worldFromObject: beforeFlange(robot, ready(robot), 0.3),
  mesh: boxMesh([0.02, 0.02, 0.4]),
  graspable: true,
});
/** A block that only a bar in the gripper meets on the way. */
const block = (robot: Robot): CellObject => ({
  id: "block",
  name: "Block",
  worldFromObject: beforeFlange(robot, turned(robot, 0.7), 0.45),
  mesh: boxMesh([0.1, 0.1, 0.1]),
});
const cellOf = (...objects: CellObject[]): CellDefinition => ({
  worldFromBase: pose(),
  allowedPairs: [],
  shapeError_m: 0,
  flangeFromGrip: pose([0, 0, 0.15]),
  objects,
});
const gripper = (closed: boolean): Step => ({ id: closed ? "take" : "let go", type: "gripper", closed });
const turn = (robot: Robot, id: string, by_rad: number): Step => ({
  id,
  type: "move",
  path: "ptp",
  target: { q: turned(robot, by_rad) },
  speed: { ratio: 0.5 },
  blend_m: 0,
});
const programOf = (robot: Robot, ...steps: Step[]): Program => ({ ...emptyProgram(robot.id, "Carry"), steps });
const dialect = { interpret: () => ({ kind: "not-understood", faults: [] }) } as unknown as Dialect;

async function bench(brand: DriverKind, cellFor: (robot: Robot) => CellDefinition) {
  const robot = robotsOf(brand).find(({ arm }) => arm.joints.length === 6)!;
  const scheduler = manualScheduler();
  const ended = endedOn(scheduler, 0.02);
  const cell = cellFor(robot);
  const opened = await openRobotConnection({
    id: "s",
    brand,
    robot,
    scheduler,
    dialect,
    deadMan: false,
    cell,
    readCell: document => ({ kind: "cell", cell: document as CellDefinition }),
  });
  if (opened.kind === "refused") throw new Error(opened.why.sentence);
  const { station } = opened;
  expect(await ended(station.connect())).toEqual({ kind: "done" });
  await scheduler.elapse(0.2);
  const seat = station.commander("you");
  seat.acquireLease();
  expect(await ended(seat.robot.moveJoints(ready(robot)))).toEqual({ kind: "done" });
  /** Samples in which the bar, carried from where the flange took it, touched the block. */
  const collider = new CellCollider({ ...cell, links: linkSolids(robot) }, robot.arm);
  const flangeFromBar = compose(
    inverse(flangePose(robot.arm, ready(robot))),
    beforeFlange(robot, ready(robot), 0.3) as Pose as Pose<"base", "object">,
  );
  collider.attach("bar", flangeFromBar as Pose as Pose<"flange", "object">);
  let touched = 0;
  let farthest_rad = 0;
  station.onSample(({ q_rad, gripperClosed }) => {
    if (gripperClosed && collider.check(q_rad).some(({ a, b }) => [a, b].sort().join() === "bar,block")) touched++;
    farthest_rad = Math.max(farthest_rad, Math.abs(q_rad[0]! - ready(robot)[0]!));
  });
  return { robot, cell, scheduler, station, seat, ended, touched: () => touched, farthest_rad: () => farthest_rad };
}

/** Drivers that say of the gripper without being told first which output it hangs on. */
const gripping = DRIVER_KINDS.filter(({ id }) => ["ur", "yaskawa", "abb"].includes(id));

describe.each(gripping.map(brand => [brand.id, brand] as const))("a part in the gripper of %s", (_, brand) => {
  const withBlock = (robot: Robot): CellDefinition => cellOf(bar(robot), block(robot));

  test("T-45 M-49 moves with the flange for the guard: moved by hand the robot is stopped before the part touches; let go of, it is held no more", async () => {
    const { robot, scheduler, station, seat, ended, ...seen } = await bench(brand, withBlock);
    expect(await ended(station.run(seat, programOf(robot, gripper(true)), false))).toEqual({ kind: "done" });
    await scheduler.elapse(0.3);
    expect(await ended(seat.robot.moveJoints(turned(robot, 1.4)))).toMatchObject({
      kind: "stopped",
      why: { code: "guard.clearance" },
    });
    await scheduler.elapse(6);
    expect(seen.touched()).toBe(0);
    expect(seen.farthest_rad()).toBeGreaterThan(0.1);
    expect(await ended(seat.robot.moveJoints(turned(robot, 0.7)))).toMatchObject({
      kind: "refused",
      why: { code: "guard.clearance" },
    });
    expect(await ended(seat.robot.moveJoints(ready(robot)))).toEqual({ kind: "done" });
    expect(await ended(station.run(seat, programOf(robot, gripper(false)), false))).toEqual({ kind: "done" });
    await scheduler.elapse(0.3);
    expect(await ended(seat.robot.moveJoints(turned(robot, 1.4)))).toEqual({ kind: "done" });
    station.close();
  });

  test("T-45 M-49 counts in the check of a program that begins with it, and still after the cell was given anew", async () => {
    const { robot, cell, scheduler, station, seat, ended, ...seen } = await bench(brand, withBlock);
    expect(await ended(station.run(seat, programOf(robot, gripper(true)), false))).toEqual({ kind: "done" });
    await scheduler.elapse(0.3);
    const through = programOf(robot, turn(robot, "there", 1.4));
    expect(station.setCell(cell)).toEqual({ kind: "done" });
    expect(await ended(station.run(seat, through, false))).toMatchObject({
      kind: "refused",
      why: { code: "collision.contact", sentence: expect.stringContaining("held “Bar”") as string },
    });
    expect(await ended(station.run(seat, through, false, ["collision.contact"]))).toMatchObject({
      kind: "stopped",
      why: { code: "guard.clearance" },
    });
    await scheduler.elapse(6);
    expect(seen.touched()).toBe(0);
    station.close();
  });

  test("M-49 lifted from one table and set down on another it stops nothing, twice", async () => {
    /** A table just below the bar at that turn of joint 1: below in the direction of the flange. */
    const table = (robot: Robot, id: string, by_rad: number): CellObject => ({
      id,
      name: id,
      worldFromObject: beforeFlange(robot, turned(robot, by_rad), 0.5 + 0.0002 + 0.01),
      mesh: boxMesh([0.3, 0.3, 0.02]),
    });
    const near = (robot: Robot, id: string, by_rad: number, back_m: number): Step => ({
      id,
      type: "move",
      path: "lin",
      target: {
        pose: compose(flangePose(robot.arm, turned(robot, by_rad)), pose([0, 0, -back_m])) as Pose as Pose<
          "frame",
          "tcp"
        >,
        frame: "base",
        tool: "flange",
      },
      speed: { mps: 0.15 },
      blend_m: 0,
    });
    const above = (robot: Robot, id: string, by_rad: number): Step =>
      ({ ...near(robot, id, by_rad, 0.1), path: "ptp", speed: { ratio: 0.3 } }) as Step;
    const { robot, station, seat, ended, scheduler } = await bench(brand, robot =>
      cellOf(bar(robot), table(robot, "first", 0), table(robot, "second", 0.9)),
    );
    const program = programOf(
      robot,
      gripper(true),
      near(robot, "lift", 0, 0.1),
      above(robot, "over", 0.9),
      near(robot, "down", 0.9, 0),
      gripper(false),
      near(robot, "away", 0.9, 0.1),
      above(robot, "home", 0),
      near(robot, "back", 0, 0),
    );
    for (let i = 0; i < 2; i++) {
      expect(await ended(station.run(seat, program, false))).toEqual({ kind: "done" });
      await scheduler.elapse(0.3);
    }
    station.close();
  });
});
