import {
  boxMesh,
  emptyProgram,
  flangePose,
  linkSolids,
  manualScheduler,
  pose,
  robotById,
  CellCollider,
  type Dialect,
  type MoveStep,
  type Program,
  type Step,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { driverKindById } from "../brands.ts";
import { endedOn } from "../testing/index.ts";
import { openRobotConnection, startSynchronized, type CellDefinition } from "./index.ts";

const robot = robotById("ur10e")!;
const ready = robot.home_rad.map((q, i) => (i === 1 ? q + 0.8 : q));
const turned = (by_rad: number): number[] => ready.map((q, i) => (i === 0 ? q + by_rad : q));
const move = (id: string, by_rad: number): MoveStep => ({
  id,
  type: "move",
  path: "ptp",
  target: { q: turned(by_rad) },
  speed: { ratio: 0.5 },
  blend_m: 0,
});
const programOf = (...steps: readonly Step[]): Program => ({ ...emptyProgram(robot.id, "Red"), steps });
const dialect = { interpret: () => ({ kind: "not-understood", faults: [] }) } as unknown as Dialect;
const [x, y] = flangePose(robot.arm, turned(0.7)).position;
const withPost: CellDefinition = {
  worldFromBase: pose(),
  allowedPairs: [],
  shapeError_m: robot.shapeError_m,
  objects: [{ id: "post", name: "Post", worldFromObject: pose([x, y, 1]), mesh: boxMesh([0.06, 0.06, 2]) }],
};
const tooHeavy: Step = { id: "load", type: "payload", mass_kg: robot.payload_kg! + 1, center_m: [0, 0, 0] };

async function bench(id = "s") {
  const scheduler = manualScheduler();
  const ended = endedOn(scheduler, 0.02);
  const opened = await openRobotConnection({
    id,
    brand: driverKindById("ur")!,
    robot,
    scheduler,
    dialect,
    deadMan: false,
    cell: withPost,
    readCell: document => ({ kind: "cell", cell: document as CellDefinition }),
  });
  if (opened.kind === "refused") throw new Error(opened.why.sentence);
  const { station } = opened;
  expect(await ended(station.connect())).toEqual({ kind: "done" });
  await scheduler.elapse(0.2);
  const seat = station.commander("you");
  seat.acquireLease();
  expect(await ended(seat.robot.moveJoints(ready))).toEqual({ kind: "done" });
  let farthest_rad = 0;
  station.onSample(({ q_rad }) => {
    farthest_rad = Math.max(farthest_rad, Math.abs(q_rad[0]! - ready[0]!));
  });
  return { scheduler, ended, station, seat, farthest_rad: () => farthest_rad };
}

describe("a program whose check is red", () => {
  test("T-45 is not sent, whatever makes it red, and the sentence names what", async () => {
    const { ended, station, seat, farthest_rad } = await bench();
    expect(await ended(station.run(seat, programOf(tooHeavy, move("a", 0.3)), false))).toMatchObject({
      kind: "refused",
      why: { code: "payload.too-heavy", sentence: expect.stringContaining("kg") as string },
    });
    expect(farthest_rad()).toBeLessThan(0.001);
    station.close();
  });

  test("T-45 is not made ready for a common start either, and nobody of the group moves", async () => {
    const { scheduler, ended, station, seat, farthest_rad } = await bench();
    const through = programOf(move("there", 1.4));
    expect(await station.prepare(seat, through, false)).toMatchObject({
      kind: "refused",
      why: { code: "collision.contact" },
    });
    const group = startSynchronized(
      [{ station, prepare: () => station.prepare(seat, through, false) }],
      scheduler,
    ).then(({ outcome }) => outcome);
    expect(await ended(group)).toMatchObject({ kind: "refused", why: { code: "collision.contact" } });
    expect(farthest_rad()).toBeLessThan(0.001);
    station.close();
  });

  test("T-45 is sent when every code that makes it red is named, and only then", async () => {
    const { ended, station, seat, farthest_rad } = await bench();
    const program = programOf(tooHeavy, move("a", 0.3));
    expect(await ended(station.run(seat, program, false, ["collision.contact"]))).toMatchObject({
      kind: "refused",
      why: { code: "payload.too-heavy" },
    });
    const outcome = await ended(station.run(seat, program, false, ["payload.too-heavy"]));
    expect(outcome).toEqual({ kind: "done" });
    expect(farthest_rad()).toBeGreaterThan(0.29);
    station.close();
  });

  test("T-45 T-43 sent in spite of a contact it is stopped by the guard before it touches", async () => {
    const { scheduler, ended, station, seat } = await bench();
    const collider = new CellCollider({ ...withPost, links: linkSolids(robot) }, robot.arm);
    let touched = 0;
    station.onSample(({ q_rad }) => {
      if (collider.check(q_rad).some(({ a, b }) => a === "post" || b === "post")) touched++;
    });
    expect(await ended(station.run(seat, programOf(move("there", 1.4)), false, ["collision.contact"]))).toMatchObject({
      kind: "stopped",
      why: { code: "guard.clearance" },
    });
    await scheduler.elapse(6);
    expect(touched).toBe(0);
    station.close();
  });
});
