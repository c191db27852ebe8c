import { onPreview } from "../../stores/seek.ts";
import { theRobot } from "../../stores/document.ts";
import { interpolateTo } from "../jog/joint-interpolation.ts";
import { theLive } from "../live.ts";
import { solveStep } from "../jog/solve.ts";

/** Shows where the robot would stand with a repair, and brings it back. */
export function startPreview(): () => void {
  let before: Float64Array | null = null;
  return onPreview(step => {
    const robot = theRobot();
    if (!robot) return;
    if (step === null) {
      if (before) interpolateTo(robot, before);
      before = null;
      return;
    }
    if (step.type !== "move") return;
    const there = solveStep(step, theLive().q_rad);
    if (there.kind !== "reached") return;
    before ??= Float64Array.from(theLive().q_rad);
    interpolateTo(robot, there.q_rad);
  });
}
