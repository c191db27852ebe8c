import type { ManualScheduler } from "@twincell/core";

/** Lets virtual time pass until a command has ended; throws when that takes longer than `most_s`. */
export const endedOn =
  (scheduler: ManualScheduler, step_s = 0.02, most_s = 60) =>
  async <T>(command: Promise<T>): Promise<T> => {
    let over = false;
    void command.then(() => {
      over = true;
    });
    for (let t = 0; t < most_s && !over; t += step_s) await scheduler.elapse(step_s);
    if (!over) throw new Error(`The command took more than ${most_s} s.`);
    return command;
  };
