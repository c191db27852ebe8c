import { armScratch, flangePose, manualScheduler, robotById, type JointSample } from "@twincell/core";
import { expect, test } from "vitest";
import {
  compareTraces,
  createRunRecorder,
  dashboardOf,
  memoryFiles,
  openHistory,
  playHistory,
  traceOf,
  type FilePort,
  type History,
  type RunRecorder,
} from "../index.ts";

const robot = robotById("ur10e")!;
const n = robot.arm.joints.length;
const base: JointSample = {
  sequence: 0,
  time_s: 0,
  q_rad: new Float64Array(n),
  moving: false,
  mode: "automatic",
  safety: "normal",
  override: 1,
  gripperClosed: false,
  step: "",
  message: "",
};

/** One joint that swings there and back in a cycle, then waits for a while. */
const swing = (t_s: number, takes_s: number, by = 1): number =>
  by * (t_s < takes_s ? (1 - Math.cos((2 * Math.PI * t_s) / takes_s)) / 2 : 0);
async function historyOf(fill: (recorder: RunRecorder) => void): Promise<{ history: History; port: FilePort }> {
  const port = memoryFiles();
  const recorder = createRunRecorder(port.create("a.mcap"), { robot, startedAt_ns: 0n, program: "P", cell: "C" });
  fill(recorder);
  recorder.finish();
  const opened = await openHistory(port);
  if (opened.kind !== "history") throw new Error(opened.sentence);
  return { history: opened.history, port };
}
/** Cycles of 6 s of motion and as much rest as fills the period; each is as long as it says. */
function cycles(
  recorder: RunRecorder,
  periods_s: readonly number[],
  more: (at_s: number, cycle: number) => Partial<JointSample> = () => ({}),
): void {
  let from_s = 0;
  let sequence = 0;
  periods_s.forEach((period_s, cycle) => {
    for (let t_s = 0; t_s < period_s - 1e-9; t_s += 0.05) {
      const q_rad = new Float64Array(n);
      q_rad[0] = swing(t_s, 6);
      recorder.record({
        ...base,
        sequence: sequence++,
        time_s: from_s + t_s,
        q_rad,
        moving: t_s < 6,
        step: t_s < 3 ? "out" : "back",
        ...more(from_s + t_s, cycle),
      });
    }
    from_s += period_s;
  });
}

test("T-56 cycle times, use, travel: what the dashboard says is what the robot did", async () => {
  const { history } = await historyOf(recorder => {
    cycles(recorder, new Array<number>(60).fill(10));
  });
  const board = dashboardOf(history, { serviceTravel: [1000, 0, 0, 0, 0, 0] });
  expect(board.cycles.count).toBe(59);
  expect(board.cycles.median_s).toBeCloseTo(10, 1);
  expect(board.use.recorded_s).toBeCloseTo(600, 0);
  expect(board.use.moving_s / board.use.recorded_s).toBeCloseTo(0.6, 2);
  // There and back, one radian each, in every one of 60 cycles; the others stood.
  expect(board.travel[0]!.travel).toBeCloseTo(120, 1);
  expect(board.travel.slice(1).every(joint => joint.travel === 0)).toBe(true);
  expect(board.travel[0]!.perHour).toBeCloseTo(720, 0);
  expect(board.travel[0]!.service).toMatchObject({
    kind: "reported",
    value: { share: expect.closeTo(0.12, 3) as number, hoursLeft: expect.closeTo(880 / 720, 1) as number },
  });
  expect(board.travel[1]!.service).toEqual({ kind: "not-reported" });
  expect(board.hints).toEqual([]);
});

test("T-56 what the source does not give is not reported, and never made up", async () => {
  const { history } = await historyOf(recorder => {
    cycles(recorder, [10, 10]);
  });
  const board = dashboardOf(history);
  expect(board.load).toEqual({ kind: "not-reported" });
  expect(board.temperature).toEqual({ kind: "not-reported" });
  expect(board.travel.every(({ service }) => service.kind === "not-reported")).toBe(true);
});

test("T-56 loads, temperatures, alarms and slower cycles become hints with their numbers", async () => {
  const { history } = await historyOf(recorder => {
    let last_s = -10;
    cycles(recorder, [...new Array<number>(20).fill(10), ...new Array<number>(20).fill(12)], (at_s, cycle) => {
      if (at_s - last_s >= 5) {
        last_s = at_s;
        recorder.note("load", {
          torque_Nm: [10, 20, 30 + cycle, 1, 1, 1],
          current_A: [],
          temperature_C: [30, 30, 30, 30, 30, 30 + cycle],
        });
      }
      return { safety: cycle % 10 === 3 && at_s % 10 > 8.9 ? "protective-stop" : "normal" };
    });
  });
  const board = dashboardOf(history, { serviceTravel: [90] });
  expect(board.load).toMatchObject({ kind: "reported", value: { unit: "N m" } });
  expect(board.alarms).toMatchObject([{ code: "safety.protective-stop", count: expect.any(Number) as number }]);
  const kinds = board.hints.map(hint => hint.kind);
  expect(kinds).toContain("slower");
  expect(board.hints.find(hint => hint.kind === "slower")).toMatchObject({
    from_s: expect.closeTo(10, 1) as number,
    to_s: expect.closeTo(12, 1) as number,
  });
  expect(board.hints.filter(hint => hint.kind === "load-rises")).toMatchObject([{ joint: 3 }]);
  expect(board.hints.filter(hint => hint.kind === "temperature-rises")).toMatchObject([{ joint: 6 }]);
  expect(kinds).toContain("alarm-repeats");
  expect(board.hints.find(hint => hint.kind === "service-due")).toMatchObject({
    joint: 1,
    share: expect.closeTo(80 / 90, 2) as number,
  });
});

test("X-43 two cycles laid over each other: how much longer, how far apart, and the path without the timing", async () => {
  const { history } = await historyOf(recorder => {
    // The second goes the same way in 8 s instead of 6; the third in 6 s, but farther.
    let sequence = 0;
    for (const [from_s, takes_s, by] of [
      [0, 6, 1],
      [10, 8, 1],
      [20, 6, 1.1],
    ] as const) {
      for (let t_s = 0; t_s < 10 - 1e-9; t_s += 0.01) {
        const q_rad = new Float64Array(n);
        q_rad[0] = swing(t_s, takes_s, by);
        recorder.record({ ...base, sequence: sequence++, time_s: from_s + t_s, q_rad, moving: true, step: "s" });
      }
    }
  });
  const [a, b, c] = await Promise.all([traceOf(history, 0, 6), traceOf(history, 10, 18), traceOf(history, 20, 26)]);
  const slower = compareTraces(robot, a, b);
  const farther = compareTraces(robot, a, c);
  const same = compareTraces(robot, a, a);
  expect(same).toMatchObject({ longer_s: 0, apart_m: 0, offPath_m: 0 });
  expect(slower.longer_s).toBeCloseTo(2, 6);
  expect(slower.offPath_m).toBeLessThan(2e-4);
  expect(slower.apart_m).toBeGreaterThan(0.1);
  // At the turning point joint 1 is 0.1 rad farther: the chord of that at the radius of the flange.
  const flange = flangePose(robot.arm, new Float64Array(n), undefined, armScratch()).position;
  const radius_m = Math.hypot(flange[0], flange[1]);
  expect(farther.apart_m).toBeCloseTo(2 * radius_m * Math.sin(0.05), 3);
  expect(farther.offPath_m).toBeCloseTo(farther.apart_m, 3);
  expect(farther.apartAt_s).toBeCloseTo(3, 1);
  expect(farther.joints_rad[0]).toBeCloseTo(0.1, 4);
});

test("T-54 a history plays like a live robot: at any pace, backwards, and the last wish wins", async () => {
  const { history } = await historyOf(recorder => {
    cycles(recorder, new Array<number>(6).fill(10));
  });
  const scheduler = manualScheduler();
  const player = playHistory(history, robot, scheduler);
  const seen: number[] = [];
  player.onSample(sample => {
    seen.push(sample.time_s);
  });
  const read = async (): Promise<void> => {
    for (let i = 0; i < 20; i++) await Promise.resolve();
  };
  player.timeline.seek(30);
  player.timeline.seek(50);
  await read();
  expect(seen).toEqual([50]);
  expect(player.moment).toMatchObject({ t_s: 50, recorded: true, state: { step: "out" } });
  player.timeline.seek(0);
  player.timeline.setSpeed(4);
  player.timeline.play();
  for (let i = 0; i < 20; i++) {
    scheduler.advance(0.5);
    await read();
  }
  expect(player.position_s).toBeCloseTo(40, 0);
  player.timeline.setSpeed(-10);
  for (let i = 0; i < 10; i++) {
    scheduler.advance(0.5);
    await read();
  }
  expect(player.position_s).toBe(0);
  expect(player.playing).toBe(false);
  player.close();
});

test("a file that is taken away while it is looked at is said, and playing stops", async () => {
  const { history, port } = await historyOf(recorder => {
    cycles(recorder, new Array<number>(6).fill(10));
  });
  Object.assign(port, { read: () => Promise.reject(new Error("the file is gone")) });
  const player = playHistory(history, robot, manualScheduler());
  const said: string[] = [];
  player.onTrouble(sentence => {
    said.push(sentence);
  });
  player.timeline.play();
  player.timeline.seek(30);
  for (let i = 0; i < 20; i++) await Promise.resolve();
  expect(said).toEqual(["This part of the recording cannot be read: the file is gone."]);
  expect(player.playing).toBe(false);
});
