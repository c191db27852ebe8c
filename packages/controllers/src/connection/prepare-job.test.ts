import {
  boxMesh,
  emptyProgram,
  flangePose,
  manualScheduler,
  pose,
  robotById,
  type Dialect,
  type MoveStep,
  type Program,
} from "@twincell/core";
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

test("T-45 a program of 600 motions whose last touches a post is not sent: long programs are checked like short ones", async () => {
  const scheduler = manualScheduler();
  const ended = endedOn(scheduler);
  const ahead = robot.home_rad.map((q, i) => (i === 1 ? q + 0.8 : q));
  const turned = (by_rad: number): number[] => ahead.map((q, i) => (i === 0 ? q + by_rad : q));
  const [x, y] = flangePose(robot.arm, turned(0.7)).position;
  const long: Program = {
    ...emptyProgram(robot.id, "Long"),
    steps: [
      ...Array.from({ length: 600 }, (_, i) => ({ ...move(`s${i}`, 0), target: { q: turned(i % 2 === 0 ? 0.1 : 0) } })),
      { ...move("into", 0), target: { q: turned(1.4) } },
    ],
  };
  const opened = await openRobotConnection({
    id: "s",
    brand: driverKindById("ur")!,
    robot,
    scheduler,
    dialect,
    cell: {},
    readCell: () => ({
      kind: "cell",
      cell: {
        worldFromBase: pose(),
        allowedPairs: [],
        shapeError_m: robot.shapeError_m,
        objects: [{ id: "post", name: "Post", worldFromObject: pose([x, y, 1]), mesh: boxMesh([0.06, 0.06, 2]) }],
      },
    }),
  });
  if (opened.kind === "refused") throw new Error(opened.why.sentence);
  const { station } = opened;
  const seat = station.commander("you");
  expect(await ended(station.connect())).toEqual({ kind: "done" });
  seat.acquireLease();
  expect(await ended(station.run(seat, long, false))).toMatchObject({
    kind: "refused",
    why: { code: expect.stringMatching(/^collision\./) as string },
  });
  station.close();
});

test("a program that cannot be planned to its end is refused with the reason, and its first motions are not sent", async () => {
  const scheduler = manualScheduler();
  const ended = endedOn(scheduler);
  const opened = await openRobotConnection({ id: "s", brand: driverKindById("ur")!, robot, scheduler, dialect });
  if (opened.kind === "refused") throw new Error(opened.why.sentence);
  const { station } = opened;
  const said: string[] = [];
  station.onNotice(({ code }) => said.push(code));
  const seat = station.commander("you");
  expect(await ended(station.connect())).toEqual({ kind: "done" });
  expect(said, "that no cell is known is said").toEqual(["station.no-cell"]);
  seat.acquireLease();
  const before = Array.from(seat.robot.jointAngles());
  const far: MoveStep = {
    ...move("far", 0),
    path: "lin",
    target: { pose: pose([9, 0, 0.5]), frame: "world", tool: "flange" },
  };
  const outcome = await ended(station.run(seat, { ...program, steps: [move("a", 0.3), far] }, false));
  expect(outcome).toMatchObject({ kind: "refused" });
  if (outcome.kind === "refused") expect(outcome.why.sentence).toMatch(/far|9/);
  expect(Array.from(seat.robot.jointAngles())).toEqual(before);
  station.close();
});
