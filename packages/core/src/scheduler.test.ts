import { expect, test } from "vitest";
import { manualScheduler } from "./scheduler.ts";

test("ticks fall at their own times, in order, and stop when told", () => {
  const clock = manualScheduler();
  const log: string[] = [];
  const stop = clock.every(0.004, () => {
    log.push(`a ${clock.now_s().toFixed(3)}`);
  });
  clock.every(0.006, () => {
    log.push(`b ${clock.now_s().toFixed(3)}`);
  });
  clock.advance(0.012);
  expect(log).toEqual(["a 0.004", "b 0.006", "a 0.008", "a 0.012", "b 0.012"]);
  stop();
  clock.advance(0.006);
  expect(log.length).toBe(6);
  expect(clock.now_s()).toBeCloseTo(0.018, 12);
});

test("periods do not drift", () => {
  const clock = manualScheduler();
  let ticks = 0;
  clock.every(0.004, () => {
    ticks++;
  });
  for (let i = 0; i < 1000; i++) clock.advance(0.1);
  expect(ticks).toBe(25_000);
});

test("elapse lets waiting code run between ticks", async () => {
  const clock = manualScheduler();
  const seen: number[] = [];
  const after = (seconds: number): Promise<void> =>
    new Promise(resolve => {
      const stop = clock.every(seconds, () => {
        stop();
        resolve();
      });
    });
  const work = (async () => {
    for (let i = 0; i < 3; i++) {
      await after(0.1);
      seen.push(clock.now_s());
    }
  })();
  await clock.elapse(0.35);
  await work;
  expect(seen.map(t => t.toFixed(6))).toEqual(["0.100000", "0.200000", "0.300000"]);
});
