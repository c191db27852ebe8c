import {
  GRIPPER_S,
  holds,
  predicateText,
  type CommandOutcome,
  type PlanContext,
  type Refusal,
  type Robot,
  type Scheduler,
  type Signals,
  type Step,
} from "@twincell/core";
import type { ControllerAdapter, AdapterMotion } from "./adapter.ts";
import { MotionMaker } from "./motion.ts";
import { stepRefusal, stepsRefusal } from "./sayable.ts";
import { noPayload, notPrimitive, waitedInVain } from "./words.ts";
import { DONE } from "../outcomes.ts";

const LOOK_S = 0.004;
const refusedBy = (why: Refusal | null): CommandOutcome => (why ? { kind: "refused", why } : DONE);

export interface StepsOptions {
  readonly robot: Robot;
  readonly face: ControllerAdapter;
  readonly scheduler: Scheduler;
  readonly signals: Signals;
  readonly context: PlanContext;
  /** Where the robot stands now; copied. */
  readonly measured_rad: () => Float64Array;
  /** Ends waits: true as soon as nothing more may begin. */
  readonly ended: () => boolean;
  readonly onStep: (id: string) => void;
  readonly onMessage: (text: string) => void;
  readonly onMotion?: (q_rad: Float64Array) => void;
}

/**
 * Sends one primitive step after the other, each when the one before has ended. Ends with the first that is not done.
 * Steps that are known beforehand are all looked at before the first: one that cannot be told refuses them all.
 */
export async function sendSteps(steps: Iterable<Step>, options: StepsOptions): Promise<CommandOutcome> {
  const { face: adapter, robot, scheduler, signals, ended } = options;
  const maker = new MotionMaker(robot);
  const cannotCarryOut = (step: Step): Refusal | null => stepRefusal(step, adapter, robot);

  const until = (so: () => boolean): Promise<void> =>
    new Promise(resolve => {
      if (so() || ended()) {
        resolve();
        return;
      }
      const stop = scheduler.every(LOOK_S, () => {
        if (so() || ended()) {
          stop();
          resolve();
        }
      });
    });
  const pause = (seconds: number): Promise<void> => {
    const end_s = scheduler.now_s() + seconds;
    return until(() => scheduler.now_s() >= end_s - 1e-9);
  };
  function move(motion: AdapterMotion): Promise<CommandOutcome> {
    options.onMotion?.(motion.q_rad);
    return adapter.move(motion);
  }

  async function send(step: Step): Promise<CommandOutcome> {
    const unsaid = cannotCarryOut(step);
    if (unsaid) return refusedBy(unsaid);
    switch (step.type) {
      case "move": {
        const made = maker.make(step, options.context, options.measured_rad());
        return made.kind === "refused" ? made : move(made.motion);
      }
      case "wait":
        await pause(step.s);
        return DONE;
      case "gripper": {
        const why = adapter.setGripper(step.closed);
        if (!why) await pause(GRIPPER_S);
        return refusedBy(why);
      }
      case "set": {
        const why = adapter.setSignal(step.signal, step.to);
        if (!why && step.pulse_s !== undefined) {
          const stop = scheduler.every(step.pulse_s, () => {
            stop();
            adapter.setSignal(step.signal, typeof step.to === "number" ? 0 : !step.to);
          });
        }
        return refusedBy(why);
      }
      case "wait-for": {
        const { timeout_s = Infinity } = step;
        const begun_s = scheduler.now_s();
        await until(() => holds(step.when, signals) || scheduler.now_s() - begun_s >= timeout_s - 1e-9);
        return ended() || step.late !== undefined || holds(step.when, signals)
          ? DONE
          : { kind: "stopped", why: waitedInVain(step.id, predicateText(step.when), timeout_s) };
      }
      case "payload":
        return refusedBy(adapter.setPayload ? adapter.setPayload(step.mass_kg, step.center_m) : noPayload(robot));
      case "message":
        options.onMessage(step.text);
        return DONE;
      case "comment":
      case "stop":
        return DONE;
      default:
        return { kind: "refused", why: notPrimitive(step) };
    }
  }

  const known = Array.isArray(steps) ? stepsRefusal(steps as readonly Step[], { cannotCarryOut }) : null;
  if (known) return refusedBy(known);
  let first = true;
  for (const step of steps) {
    if (ended()) break;
    options.onStep(step.id);
    const outcome = await send(step);
    // What fails on the way was begun: the program was stopped, not turned away.
    if (outcome.kind !== "done") return first ? outcome : { kind: "stopped", why: outcome.why };
    if (step.type === "stop") break;
    first = false;
  }
  return DONE;
}
