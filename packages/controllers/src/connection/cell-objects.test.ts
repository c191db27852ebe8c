import {
  boxMesh,
  CellCollider,
  compose,
  emptyProgram,
  flangePose,
  linkSolids,
  manualScheduler,
  pose,
  type CellObject,
  type Dialect,
  type MoveStep,
  type Pose,
  type Program,
  type Robot,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { DRIVER_KINDS, openRobotConnection, robotsOf, type DriverKind, type CellDefinition } from "../index.ts";
import { endedOn } from "../testing/index.ts";

/** An arm that is upright at home leans forward, so that turning joint 1 takes its flange somewhere. */
function ready(robot: Robot): number[] {
  const [x, y] = flangePose(robot.arm, robot.home_rad).position;
  return robot.home_rad.map((q, i) => (i === 1 && Math.hypot(x, y) < 0.2 ? q + 0.8 : q));
}
const turned = (robot: Robot, by_rad: number): number[] => ready(robot).map((q, i) => (i === 0 ? q + by_rad : q));
const empty = (robot: Robot): CellDefinition => ({
  worldFromBase: pose(),
  allowedPairs: [],
  shapeError_m: robot.shapeError_m,
  objects: [],
});
/** A post where the flange passes when joint 1 has turned by that much from home. */
function post(robot: Robot, by_rad: number): CellObject {
  const [x, y] = flangePose(robot.arm, turned(robot, by_rad)).position;
  return { id: "post", name: "Post", worldFromObject: pose([x, y, 1]), mesh: boxMesh([0.06, 0.06, 2]) };
}
const dialect = { interpret: () => ({ kind: "not-understood", faults: [] }) } as unknown as Dialect;

async function bench(brand: DriverKind, cellOf: (robot: Robot) => CellDefinition) {
  const robot = robotsOf(brand).find(({ arm }) => arm.joints.length === 6)!;
  const scheduler = manualScheduler();
  const ended = endedOn(scheduler, 0.02);
  const opened = await openRobotConnection({
    id: "s",
    brand,
    robot,
    scheduler,
    dialect,
    deadMan: false,
    cell: cellOf(robot),
    readCell: document => ({ kind: "cell", cell: document as CellDefinition }),
  });
  if (opened.kind === "refused") throw new Error(opened.why.sentence);
  const { station } = opened;
  expect(await ended(station.connect())).toEqual({ kind: "done" });
  await scheduler.elapse(0.2);
  const seat = station.commander("you");
  seat.acquireLease();
  expect(await ended(seat.robot.moveJoints(ready(robot)))).toEqual({ kind: "done" });
  /** Samples in which it touched the post. */
  const withPost = { ...empty(robot), objects: [post(robot, 0.7)], links: linkSolids(robot) };
  const collider = new CellCollider(withPost, robot.arm);
  let touched = 0;
  let farthest_rad = 0;
  station.onSample(({ q_rad }) => {
    if (collider.check(q_rad).some(({ a, b }) => a === "post" || b === "post")) touched++;
    farthest_rad = Math.max(farthest_rad, Math.abs(q_rad[0]! - robot.home_rad[0]!));
  });
  return {
    robot,
    scheduler,
    station,
    seat,
    ended,
    get touched() {
      return touched;
    },
    get farthest_rad() {
      return farthest_rad;
    },
  };
}
const through = (robot: Robot): Program => {
  const step = (id: string, by_rad: number): MoveStep => ({
    id,
    type: "move",
    path: "ptp",
    target: { q: turned(robot, by_rad) },
    speed: { ratio: 1 },
    blend_m: 0,
  });
  return { ...emptyProgram(robot.id, "Through the post"), steps: [step("there", 1.4), step("back", 0)] };
};

describe.each(DRIVER_KINDS.map(brand => [brand.id, brand] as const))(
  "the cell of a connected robot of %s",
  (_, brand) => {
    test("T-43 T-45 T-63 a move at 100 % through an object is stopped before it is touched, and goes back", async () => {
      const cell = await bench(brand, robot => ({ ...empty(robot), objects: [post(robot, 0.7)] }));
      const { robot, scheduler, station, seat, ended } = cell;
      expect(await ended(seat.robot.moveJoints(turned(robot, 1.4)))).toMatchObject({
        kind: "stopped",
        why: { code: "guard.clearance" },
      });
      await scheduler.elapse(6);
      expect(cell.touched).toBe(0);
      expect(cell.farthest_rad).toBeGreaterThan(0.05);
      expect(station.guard.state).toMatchObject({ motion: "at-rest", trip: "none" });
      station.close();
    });

    test("T-45 a program through an object is not sent, and a point in it is not moved to", async () => {
      const cell = await bench(brand, robot => ({ ...empty(robot), objects: [post(robot, 0.7)] }));
      const { robot, station, seat, ended } = cell;
      expect(await ended(station.run(seat, through(robot), false))).toMatchObject({
        kind: "refused",
        why: { code: expect.stringMatching(/^collision\./) as string },
      });
      expect(await ended(seat.robot.moveJoint(1, turned(robot, 0.7)[0]!))).toMatchObject({
        kind: "refused",
        why: { code: "guard.clearance" },
      });
      expect(cell.farthest_rad).toBeLessThan(0.001);
      station.close();
    });

    test("T-64 a post that stands up to 40 mm from where the cell says is not touched when the registration error says so", async () => {
      const placeError_m = 0.04;
      const cell = await bench(brand, robot => ({ ...empty(robot), objects: [post(robot, 0.7)], placeError_m }));
      const { robot, scheduler, station, seat, ended } = cell;
      // Wherever it truly stands within its error, it stands in this.
      const grown = { ...post(robot, 0.7), mesh: boxMesh([0.06 + 2 * placeError_m, 0.06 + 2 * placeError_m, 2]) };
      const collider = new CellCollider({ ...empty(robot), objects: [grown], links: linkSolids(robot) }, robot.arm);
      let near = 0;
      station.onSample(({ q_rad }) => {
        if (collider.check(q_rad).some(({ a, b }) => a === "post" || b === "post")) near++;
      });
      expect(await ended(seat.robot.moveJoints(turned(robot, 1.4)))).toMatchObject({
        kind: "stopped",
        why: { code: "guard.clearance" },
      });
      await scheduler.elapse(6);
      expect([near, cell.touched]).toEqual([0, 0]);
      station.close();
    });

    test("T-43 an object that is put in the way of a robot that moves stops it before it is touched", async () => {
      const cell = await bench(brand, empty);
      const { robot, scheduler, station, seat, ended } = cell;
      const moving = seat.robot.moveJoints(turned(robot, 1.4));
      for (let i = 0; i < 500 && cell.farthest_rad < 0.02; i++) await scheduler.elapse(0.02);
      expect(station.setCell({ ...empty(robot), objects: [post(robot, 0.7)] })).toEqual({ kind: "done" });
      expect(await ended(moving)).toMatchObject({ kind: "stopped", why: { code: "guard.clearance" } });
      await scheduler.elapse(6);
      expect(cell.touched).toBe(0);
      station.close();
    });

    test("T-59 a tool that is given while connected counts: what it would touch is refused", async () => {
      const cell = await bench(brand, empty);
      const { robot, station, seat, ended } = cell;
      // A block before the flange that only a long tool meets.
      const baseFromFlange = flangePose(robot.arm, turned(robot, 0.3));
      const block: CellObject = {
        id: "block",
        name: "Block",
        worldFromObject: compose(baseFromFlange, pose([0, 0, 0.45])) as Pose as Pose<"world", "object">,
        mesh: boxMesh([0.1, 0.1, 0.1]),
      };
      const tool = { name: "Long", mesh: boxMesh([0.02, 0.02, 1]) };
      const there = async (definition: CellDefinition): Promise<string> => {
        expect(station.setCell(definition)).toEqual({ kind: "done" });
        const { kind } = await ended(seat.robot.moveJoints(turned(robot, 0.3)));
        if (kind === "done") expect(await ended(seat.robot.moveJoints(ready(robot)))).toEqual({ kind: "done" });
        return kind;
      };
      expect(await there({ ...empty(robot), objects: [block] })).toBe("done");
      expect(await there({ ...empty(robot), tool })).toBe("done");
      expect(await there({ ...empty(robot), objects: [block], tool })).toBe("refused");
      station.close();
    });
  },
);
