import { listsOf, type Program, type Step } from "@twincell/core";
import { linesLookedAt } from "../../emitter/index.ts";

/** Tools, frames and lines in the order in which steps first use them. */
export interface Used {
  readonly tools: Set<string>;
  readonly frames: Set<string>;
  readonly signals: Map<string, Step>;
  accelerates: boolean;
}

/** A share of the acceleration this near to all of it is all of it. */
const ALL = 1 - 1e-8;

export function usedNames(program: Program): Used {
  const used: Used = { tools: new Set(), frames: new Set(), signals: new Map(), accelerates: false };
  const frame = (name: string): void => {
    if (name !== "world" && !Object.hasOwn(program.pallets, name)) used.frames.add(name);
  };
  const note = (signal: string, step: Step): void => {
    if (!used.signals.has(signal)) used.signals.set(signal, step);
  };
  const look = (steps: readonly Step[]): void => {
    for (const step of steps) {
      switch (step.type) {
        case "move":
          for (const target of step.via === undefined ? [step.target] : [step.via, step.target]) {
            if (target.tool !== undefined && target.tool !== "flange") used.tools.add(target.tool);
            if ("pose" in target) frame(target.frame);
          }
          used.accelerates ||= (step.acceleration?.ratio ?? 1) < ALL;
          break;
        case "set":
          note(step.signal, step);
          break;
        case "pallet":
          if (Object.hasOwn(program.pallets, step.pallet)) frame(program.pallets[step.pallet]!.frame);
          break;
        default:
          for (const signal of linesLookedAt(step)) note(signal, step);
      }
      for (const inner of listsOf(step)) look(inner);
    }
  };
  for (const steps of [program.steps, ...Object.values(program.routines)]) look(steps);
  return used;
}
