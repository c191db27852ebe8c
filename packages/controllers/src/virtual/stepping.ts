import { Stepper, type Pose } from "@twincell/core";
import type { Execute } from "./execution.ts";

/**
 * Every kind of step, by core's stepper: joint, straight and circular moves with blends.
 *
 * @param worldFromBase  where the robot stands; targets in frames of the cell count from there.
 */
export const executeSteps = (worldFromBase?: Pose<"world", "base">): Execute => (steps, context, { robot, q_rad, gripperClosed }) => {
  const stepper = new Stepper(robot, { ...context, ...(worldFromBase === undefined ? {} : { worldFromBase }) }, steps, q_rad, { gripperClosed });
  const state = { step: "", gripperClosed, resting: false };
  return {
    get step() { return state.step; },
    get gripperClosed() { return state.gripperClosed; },
    get resting() { return state.resting; },
    advance(dt_s, rate, out_rad) {
      const now = stepper.advance(dt_s, rate, out_rad);
      state.step = now.step; state.gripperClosed = now.gripperClosed; state.resting = !now.moving;
      if (now.kind === "fault" && now.fault) return { code: now.fault.code, sentence: now.fault.sentence, hint: now.fault.hint };
      return now.kind === "running" ? "going" : "finished";
    },
  };
};
