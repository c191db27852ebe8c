import type { Plan, Tracking } from "@twincell/core";
import { cellStore } from "../../stores/cell.ts";
import { programOf, robotOf } from "../../stores/document.ts";
import { words } from "../../messages/index.ts";
import { BackgroundSearch } from "./planner.ts";

const study = new BackgroundSearch();

/**
 * Drives the plan at parts of its speed, away from the page (row X-45).
 *
 * @param progress  0 … 1.
 * @returns ends the study.
 */
export function accuracyOverSpeed(
  plan: Plan,
  progress: (fraction: number) => void,
  done: (tracking: Tracking) => void,
): () => void {
  const { document } = cellStore.getState();
  const program = programOf(document);
  const robot = robotOf(document);
  if (!document || !program || !robot) return () => undefined;
  const { worldFromBase } = document.robot;
  study.begin({ kind: "accuracy", plan, program, robot: robot.id, worldFromBase }, message => {
    if (message.kind === "progress") progress(message.share);
    else if (message.kind === "accuracy") done(message.tracking);
    else if (message.kind === "trouble") done({ kind: "unknown", sentence: message.sentence || words.collide.trouble });
  });
  return () => {
    study.cancel();
  };
}
