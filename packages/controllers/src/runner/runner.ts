import type { CommandOutcome, Program, RobotController, Scheduler, Step } from "@twincell/core";

/** From the end of one command to the sending of the next (row T-34). */
export const COMMAND_GAP_S = 0.032875;

export interface PacedRun {
  readonly outcome: CommandOutcome;
  /** When each command was sent and when it ended, on the scheduler's clock [s]. */
  readonly sent_s: readonly number[];
  readonly ended_s: readonly number[];
}
export interface PacedOptions {
  readonly robot: Pick<RobotController, "run">;
  readonly scheduler: Scheduler;
  readonly gap_s?: number;
  readonly onSent?: (step: Step, at_s: number) => void;
}

/**
 * Sends a program step by step, as controllers without a program memory are driven: one command, its end, a gap, the
 * next. A late clock is made good at the next gap, so that the mean gap stays what it should be. Ends with the first
 * command that is not done. A wait lasts as long as it says; the gap comes on top.
 */
export async function runPaced(
  steps: Iterable<Step>,
  context: Pick<Program, "tools" | "frames">,
  options: PacedOptions,
): Promise<PacedRun> {
  const { robot, scheduler } = options;
  const gap_s = options.gap_s ?? COMMAND_GAP_S;
  const sent_s: number[] = [];
  const ended_s: number[] = [];
  let owed_s = 0;
  let outcome: CommandOutcome = { kind: "done" };
  for (const step of steps) {
    const last_s = ended_s.at(-1);
    if (last_s !== undefined) {
      await pause(scheduler, gap_s - owed_s);
      owed_s += scheduler.now_s() - last_s - gap_s;
    }
    sent_s.push(scheduler.now_s());
    options.onSent?.(step, scheduler.now_s());
    outcome = await robot.run([step], context);
    ended_s.push(scheduler.now_s());
    if (outcome.kind !== "done") break;
  }
  return { outcome, sent_s, ended_s };
}

/** Joint points as steps that a paced run sends. */
export const pointSteps = (points_rad: readonly ArrayLike<number>[], ratio = 1): Step[] =>
  points_rad.map((q, i) => ({
    id: `point ${i + 1}`,
    type: "move",
    path: "ptp",
    target: { q: Array.from(q) },
    speed: { ratio },
    blend_m: 0,
  }));

const pause = (scheduler: Scheduler, seconds: number): Promise<void> =>
  seconds <= 0
    ? Promise.resolve()
    : new Promise(resolve => {
        const stop = scheduler.every(seconds, () => {
          stop();
          resolve();
        });
      });
