import type { Scheduler } from "./ports.ts";

/** A clock that stands still until it is told to move: for tests, and for running a virtual robot faster than time. */
export interface ManualScheduler extends Scheduler {
  /** Moves the clock on and runs every tick that falls due, in order, each at its own time. */
  advance(seconds: number): void;
  /** The same, and after each tick the code that awaited something runs before the clock moves on. */
  elapse(seconds: number): Promise<void>;
}

interface Timer {
  readonly from_s: number;
  readonly period_s: number;
  readonly tick: () => void;
  ticks: number;
}

/** Turns of the microtask queue after a tick: enough for this many nested `await`s to return. */
const TURNS = 16;

export function manualScheduler(start_s = 0): ManualScheduler {
  let now_s = start_s;
  const timers = new Set<Timer>();
  // Multiplied, not summed: a thousand periods of 4 ms end at 4 s, not beside it.
  const due_s = (timer: Timer): number => timer.from_s + (timer.ticks + 1) * timer.period_s;

  /** Runs the earliest tick that is due by then; the first that was asked for goes first among equals. */
  function runNext(end_s: number): boolean {
    let next: Timer | undefined;
    let at_s = Infinity;
    for (const timer of timers)
      if (due_s(timer) < at_s) {
        next = timer;
        at_s = due_s(timer);
      }
    if (!next || at_s > end_s + 1e-12) return false;
    next.ticks++;
    now_s = Math.max(now_s, at_s);
    next.tick();
    return true;
  }

  return {
    now_s: () => now_s,
    every(period_s, tick) {
      const timer: Timer = { from_s: now_s, period_s, tick, ticks: 0 };
      timers.add(timer);
      return () => {
        timers.delete(timer);
      };
    },
    advance(seconds) {
      const end_s = now_s + seconds;
      while (runNext(end_s));
      now_s = Math.max(now_s, end_s);
    },
    async elapse(seconds) {
      const end_s = now_s + seconds;
      const letOthersRun = async () => {
        for (let turn = 0; turn < TURNS; turn++) await Promise.resolve();
      };
      await letOthersRun();
      while (runNext(end_s)) await letOthersRun();
      now_s = Math.max(now_s, end_s);
    },
  };
}
