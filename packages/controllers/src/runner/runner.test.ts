import { manualScheduler, robotById, type RobotController, type Scheduler } from "@twincell/core";
import { expect, test } from "vitest";
import { createVirtualController } from "../testing/index.ts";
import { COMMAND_GAP_S, pointSteps, runPaced, type PacedRun } from "./runner.ts";

const robot = robotById("staubli_rx90l")!;
const none = { tools: {}, frames: {} };
const points = (count: number): number[][] =>
  Array.from({ length: count }, (_, i) => robot.home_rad.map(q => q + 0.01 * (i % 3)));
/** A robot that is done with everything at once: only the pacing takes time. */
const immediate = (scheduler: Scheduler): RobotController => ({
  ...createVirtualController({ robot, scheduler }),
  run: () => Promise.resolve({ kind: "done" }),
});

async function paced(
  count: number,
  make: (scheduler: Scheduler) => RobotController,
  lasting_s: number,
): Promise<PacedRun> {
  const scheduler = manualScheduler();
  const run = runPaced(pointSteps(points(count)), none, { robot: make(scheduler), scheduler });
  await scheduler.elapse(lasting_s);
  return run;
}
const gaps_ms = ({ sent_s, ended_s }: PacedRun): number[] =>
  sent_s.slice(1).map((sent, i) => 1000 * (sent - ended_s[i]!));
const mean = (values: readonly number[]): number => values.reduce((sum, value) => sum + value, 0) / values.length;

test("G-11 three commands span 65.75 ms, a hundred span 3254.6 ms", async () => {
  const three = await paced(3, immediate, 1);
  const hundred = await paced(100, immediate, 5);
  expect(1000 * (three.sent_s.at(-1)! - three.sent_s[0]!)).toBeCloseTo(65.75, 6);
  expect(1000 * (hundred.sent_s.at(-1)! - hundred.sent_s[0]!)).toBeCloseTo(3254.625, 6);
  expect(hundred.sent_s.length).toBe(100);
});

test("T-34 the mean gap from the end of a command to the next is 32.875 ms, however long moves take", async () => {
  const run = await paced(20, scheduler => createVirtualController({ robot, scheduler }), 20);
  expect(run.outcome).toEqual({ kind: "done" });
  expect(run.sent_s.length).toBe(20);
  expect(Math.abs(mean(gaps_ms(run)) - 32.875)).toBeLessThanOrEqual(0.001);
});

test("T-34 a clock that ticks late, as in a browser, keeps the mean within 1 ms", async () => {
  const clock = manualScheduler();
  const late: Scheduler = {
    now_s: () => clock.now_s(),
    every: (period_s, tick) => clock.every(Math.ceil(period_s / 0.016) * 0.016, tick),
  };
  const run = runPaced(pointSteps(points(100)), none, { robot: immediate(clock), scheduler: late });
  await clock.elapse(10);
  expect(Math.abs(mean(gaps_ms(await run)) - 1000 * COMMAND_GAP_S)).toBeLessThanOrEqual(1);
});

test("T-30, T-32 waits are measured without the gap; a program of points, waits and gripper actions runs", async () => {
  const scheduler = manualScheduler();
  const virtual = createVirtualController({ robot, scheduler });
  const gripper: boolean[] = [];
  virtual.onSample(lent => {
    if (gripper.at(-1) !== lent.gripperClosed) gripper.push(lent.gripperClosed);
  });
  const [first] = pointSteps(points(1));
  const run = runPaced(
    [
      first!,
      { id: "close", type: "gripper", closed: true },
      { id: "wait", type: "wait", s: 0.5 },
      { id: "open", type: "gripper", closed: false },
    ],
    none,
    { robot: virtual, scheduler },
  );
  await scheduler.elapse(5);
  const { outcome, sent_s, ended_s } = await run;
  expect(outcome).toEqual({ kind: "done" });
  expect(Math.abs(ended_s[2]! - sent_s[2]! - 0.5)).toBeLessThanOrEqual(0.01);
  expect(gripper).toEqual([false, true, false]);
});

test("the first command that is not done ends the run", async () => {
  const scheduler = manualScheduler();
  const virtual = createVirtualController({ robot, scheduler });
  const far = robot.home_rad.map(() => 9);
  const run = runPaced(pointSteps([robot.home_rad, far, robot.home_rad]), none, { robot: virtual, scheduler });
  await scheduler.elapse(5);
  const { outcome, sent_s } = await run;
  expect(outcome.kind).toBe("refused");
  expect(sent_s.length).toBe(2);
});
