import { emptyProgram, manualScheduler, robotById, type Dialect, type MoveStep, type Program } from "@twincell/core";
import { expect, test } from "vitest";
import { driverKindById } from "../brands.ts";
import { endedOn } from "../testing/index.ts";
import { prepareJob, openRobotConnection, type PrepareJob } from "./index.ts";

const robot = robotById("ur10e")!;
const to = (by_rad: number): number[] => robot.home_rad.map((q, i) => (i === 0 ? q + by_rad : q));
const move = (id: string, by_rad: number): MoveStep => ({
  id,
  type: "move",
  path: "ptp",
  target: { q: to(by_rad) },
  speed: { ratio: 0.5 },
  blend_m: 0,
});
const program: Program = { ...emptyProgram(robot.id, "To and fro"), steps: [move("a", 0.3), move("b", 0)] };
const dialect = {
  name: "None",
  interpret: () => ({ kind: "not-understood", faults: [] }),
  emit: () => ({ kind: "cannot", step: "a", sentence: "it has no words.", hint: "Choose another." }),
} as unknown as Dialect;

test("a program that cannot be written is told as such, with its plan; one whose steps are sent is not written at all", () => {
  const question = { program, robot, start_rad: Float64Array.from(robot.home_rad) };
  expect(prepareJob({ ...question, dialect })).toMatchObject({
    files: null,
    unwritten: { code: "station.not-emitted", sentence: "None cannot say this program: it has no words." },
  });
  expect(prepareJob(question)).toMatchObject({ files: null, unwritten: null, stuck: null, findings: [] });
});

test("a robot that is moved while its program is planned elsewhere does not begin it from where it is no more", async () => {
  const scheduler = manualScheduler();
  const ended = endedOn(scheduler);
  let go = (): void => {
    /* Nothing waits yet. */
  };
  const slow: PrepareJob = question =>
    new Promise(resolve => {
      go = () => {
        resolve(prepareJob(question));
      };
    });
  const opened = await openRobotConnection({
    id: "s",
    brand: driverKindById("ur")!,
    robot,
    scheduler,
    dialect,
    layOut: slow,
  });
  if (opened.kind === "refused") throw new Error(opened.why.sentence);
  const { station } = opened;
  const seat = station.commander("you");
  expect(await ended(station.connect())).toEqual({ kind: "done" });
  seat.acquireLease();
  await scheduler.elapse(0.2);
  const running = station.run(seat, program, false);
  expect(await ended(seat.robot.moveJoints(to(0.2)))).toEqual({ kind: "done" });
  go();
  expect(await running).toMatchObject({ kind: "refused", why: { code: "station.moved" } });
  const again = station.run(seat, program, false);
  await scheduler.elapse(0.1);
  go();
  expect(await ended(again)).toEqual({ kind: "done" });
  station.close();
});

test("T-10 a stop that comes while a program is planned elsewhere keeps it from beginning, alone or with others, and the next one begins", async () => {
  const scheduler = manualScheduler();
  const ended = endedOn(scheduler);
  let go = (): void => {
    /* Nothing waits yet. */
  };
  const slow: PrepareJob = question =>
    new Promise(resolve => {
      go = () => {
        resolve(prepareJob(question));
      };
    });
  const opened = await openRobotConnection({
    id: "s",
    brand: driverKindById("ur")!,
    robot,
    scheduler,
    dialect,
    layOut: slow,
  });
  if (opened.kind === "refused") throw new Error(opened.why.sentence);
  const { station } = opened;
  const seat = station.commander("you");
  expect(await ended(station.connect())).toEqual({ kind: "done" });
  seat.acquireLease();
  await scheduler.elapse(0.2);
  const before = Array.from(seat.robot.jointAngles());
  const running = station.run(seat, program, false);
  station.stop(false);
  go();
  expect(await ended(running)).toMatchObject({ kind: "refused", why: { code: "station.stopped" } });
  expect(Array.from(seat.robot.jointAngles())).toEqual(before);
  const preparing = station.prepare(seat, program, false);
  station.stop(false);
  go();
  expect(await ended(preparing)).toMatchObject({ kind: "refused", why: { code: "station.stopped" } });
  const again = station.run(seat, program, false);
  go();
  expect(await ended(again)).toEqual({ kind: "done" });
  station.close();
});
