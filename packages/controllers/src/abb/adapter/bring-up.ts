import type { CommandOutcome, Robot, Scheduler } from "@twincell/core";
import { DONE, refused } from "../../outcomes.ts";
import { stoppedInReset } from "../../refusals.ts";
import type { RwsClient } from "./rws-client.ts";
import type { PanelState } from "./rws-state.ts";
import { pointToMain, putBack, startProgram, stopProgram } from "./text.ts";
import { manualThere, noGuiding, refusedThere } from "./words.ts";

export interface BringUpOptions {
  readonly client: RwsClient;
  readonly panel: PanelState;
  readonly scheduler: Scheduler;
  readonly robot: Robot;
  readonly ctrlstate: string;
  readonly execution: string;
  /** Modules of texts that were not taken away yet. */
  readonly left: Set<string>;
  /** Whether a program there waits for targets. */
  readonly isGuided: () => boolean;
  /** Says no once a stop came: nothing more is switched on then. */
  readonly wanted: () => boolean;
}
/** Motors come on, programs stop and start, within this time or not at all [s]. */
const PATIENCE_S = 3;
const LOOK_S = 0.02;

/**
 * What a person does after a stop: motors on, program pointer to main, the program started. In manual mode all that is
 * the pendant's.
 */
export async function bringUp({
  client,
  panel,
  scheduler,
  robot,
  ctrlstate,
  execution,
  left,
  isGuided,
  wanted,
}: BringUpOptions): Promise<CommandOutcome> {
  const pause = (): Promise<void> =>
    new Promise(resolve => {
      const stop = scheduler.every(LOOK_S, () => {
        stop();
        resolve();
      });
    });
  async function until(so: () => boolean, target?: string, name?: "ctrlstate" | "ctrlexecstate"): Promise<boolean> {
    for (const from_s = scheduler.now_s(); ; await pause()) {
      if (target !== undefined && name !== undefined) {
        const reply = await client.get(target);
        if (reply.kind !== "answer") return false;
        panel.takePanel(name, reply.states);
      }
      if (!wanted() || so()) return true;
      if (scheduler.now_s() - from_s > PATIENCE_S) return false;
    }
  }
  if (panel.mode === "manual") return refused(manualThere(robot));
  // What was told last may be older than the stop.
  await until(() => true, ctrlstate, "ctrlstate");
  if (!wanted()) return refused(stoppedInReset(robot));
  if (panel.ctrl !== "motoron") {
    const on = await client.post(`${ctrlstate}?action=setctrlstate`, { "ctrl-state": "motoron" });
    if (on.kind !== "answer")
      return refused(
        refusedThere("Switching the motors on", on.sentence, "Take away what keeps them off, then reset again."),
      );
    if (!(await until(() => panel.ctrl === "motoron", ctrlstate, "ctrlstate")))
      return refused(
        refusedThere("Switching the motors on", panel.words === "" ? "they did not come on." : panel.words),
      );
  }
  if (!wanted()) return refused(stoppedInReset(robot));
  await until(() => true, execution, "ctrlexecstate");
  if (isGuided()) return DONE;
  if (panel.isRunning) {
    await stopProgram(client);
    if (!(await until(() => !panel.isRunning, execution, "ctrlexecstate")))
      return refused(refusedThere("Stopping the program", "it goes on running."));
  }
  if (!wanted()) return refused(stoppedInReset(robot));
  // Only the program that waits for targets is started by a reset: whatever else is there would move by itself.
  const why = await putBack(client, left);
  if (why) return refused(why);
  if (!wanted()) return refused(stoppedInReset(robot));
  const pointed = await pointToMain(client);
  if (pointed.kind !== "answer")
    return refused(refusedThere("Setting the program pointer to PROC main", pointed.sentence));
  if (!wanted()) return refused(stoppedInReset(robot));
  const started = await startProgram(client, "forever");
  if (started.kind !== "answer") return refused(refusedThere("Starting the program", started.sentence));
  const guided = await until(isGuided);
  if (!wanted()) return refused(stoppedInReset(robot));
  return guided ? DONE : refused(noGuiding(robot));
}
