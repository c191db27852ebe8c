import { manualScheduler, robotById, type Executed, type Step } from "@twincell/core";
import { expect, test } from "vitest";
import { createVirtualController } from "../testing/index.ts";
import { textSteps } from "./text.ts";

const robot = robotById("staubli_rx90l")!;
const move = (id: string, by: number): Step => ({
  id,
  type: "move",
  path: "ptp",
  target: { q: robot.home_rad.map(q => q + by) },
  speed: { ratio: 1 },
  blend_m: 0,
});

test("a text being executed drives the robot, and each sample's step leads back to its line", async () => {
  const scheduler = manualScheduler();
  const virtual = createVirtualController({ robot, scheduler });
  const lines: number[] = [];
  const text = textSteps(function* (): Generator<Executed, void> {
    yield { line: 1 };
    yield { line: 3, step: move("", 0.1) };
    yield { line: 4 };
    yield { line: 7, step: move("b", 0) };
  });
  virtual.onSample(lent => {
    const line = text.lineOf(lent.step);
    if (lines.at(-1) !== line) lines.push(line);
  });
  const run = virtual.run(text.steps, { tools: {}, frames: {} });
  await scheduler.elapse(3);
  expect(await run).toEqual({ kind: "done" });
  expect(lines).toEqual([3, 7, 0]);
});

test("a text that counts for ever does not stop the clock, and can be stopped", async () => {
  const scheduler = manualScheduler();
  const virtual = createVirtualController({ robot, scheduler });
  let counted = 0;
  const text = textSteps(function* (): Generator<Executed, void> {
    for (;;) {
      counted++;
      yield { line: 2 };
    }
  });
  const run = virtual.run(text.steps, { tools: {}, frames: {} });
  await scheduler.elapse(0.5);
  expect(scheduler.now_s()).toBeCloseTo(0.5, 9);
  expect(counted).toBeGreaterThan(1000);
  expect(counted).toBeLessThan(100_000);
  virtual.stop();
  await scheduler.elapse(0.5);
  expect((await run).kind).toBe("stopped");
});
