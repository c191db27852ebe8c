import {
  boxMesh,
  distance,
  emptyProgram,
  flangePose,
  manualScheduler,
  pose,
  robotById,
  samplePlan,
  type Dialect,
  type MoveStep,
  type Program,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { driverKindById } from "../brands.ts";
import { endedOn } from "../testing/index.ts";
import { prepareJob, openRobotConnection, type JobQuestion, type PrepareJob } from "./index.ts";

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

describe("T-63 the plan that a robot is watched along is what it will do", () => {
  const gp8 = robotById("yaskawa_gp8")!;
  const posture = (s: number, l: number): number[] => gp8.home_rad.map((q, i) => q + [s, l, 0, 0, 0, 0][i]!);
  const corner = posture(0.4, 0);
  const step = (id: string, q: readonly number[], blend_m: number): MoveStep => ({
    ...move(id, 0),
    target: { q },
    blend_m,
  });
  const rounded: Program = {
    ...emptyProgram(gp8.id),
    steps: [step("a", corner, 0.004), step("b", posture(0.4, 0.4), 0)],
  };
  const question = { program: rounded, robot: gp8, start_rad: Float64Array.from(gp8.home_rad) };
  const inform = { id: "inform", name: "INFORM", emit: () => ({ kind: "emitted", files: [] }) } as unknown as Dialect;
  /** How near the flange comes to the corner [m]. */
  function nearest_m(asked: JobQuestion): number {
    const { plan } = prepareJob(asked);
    const q = new Float64Array(6);
    const at = flangePose(gp8.arm, corner).position;
    let least_m = Infinity;
    for (let t_s = 0; t_s <= plan!.duration_s; t_s += 0.002) {
      samplePlan(plan!, t_s, q);
      least_m = Math.min(least_m, distance(flangePose(gp8.arm, q).position, at));
    }
    return least_m;
  }

  test("steps that are sent one by one stop at each point", () => {
    expect(nearest_m(question)).toBeLessThan(1e-4);
  });
  test("a text rounds as its language does: INFORM makes PL=1 of 4 mm, which is 12.5 mm", () => {
    const own_m = nearest_m({ ...question, dialect: { ...inform, id: "krl" } });
    expect(nearest_m({ ...question, dialect: inform }) / own_m).toBeCloseTo(12.5 / 4, 1);
  });
  test("what lies in the sharp corner, and beside the planned curve, makes the run's check red", () => {
    const at = flangePose(gp8.arm, corner).position;
    const cell = {
      worldFromBase: pose<"world", "base">(),
      objects: [
        { id: "pin", name: "Pin", worldFromObject: pose<"world", "object">(at), mesh: boxMesh([0.004, 0.004, 0.004]) },
      ],
      tool: { name: "Tip", mesh: boxMesh([0.001, 0.001, 0.001]) },
      allowedPairs: ["link 4", "link 5", "link 6"].map(link => [link, "pin"] as const),
      shapeError_m: 0,
    };
    const wide = { ...rounded, steps: [step("a", corner, 0.1), step("b", posture(0.4, 0.4), 0)] };
    const codes = (asked: Omit<JobQuestion, "robot" | "start_rad">): readonly string[] =>
      prepareJob({ ...question, ...asked }).bad.map(({ code }) => code);
    expect(codes({ program: wide, cell, dialect: inform })).toEqual(["collision.corner"]);
    expect(codes({ program: wide, cell })).toEqual(["collision.contact", "collision.contact"]);
  });
});
