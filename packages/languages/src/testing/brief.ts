import type { MoveStep } from "@twincell/core";
import type { executeText } from "../patch/index.ts";

type Answer = ReturnType<typeof executeText>;
const rounded = (value: number): number => Math.round(value * 100) / 100 + 0;

/** Path, then joints in degrees or the place in mm with its frame. */
function pathAndTarget({ path, target }: MoveStep): string {
  if ("q" in target) return `${path} ${target.q.map(rad => rounded((rad * 180) / Math.PI)).join(" ")}°`;
  const within = target.frame === "world" ? "" : ` in ${target.frame}`;
  return `${path} ${target.pose.position.map(m => rounded(m * 1000)).join(" ")}${within}`;
}

/**
 * What a text does, each step in a few words, or its first fault with the line.
 *
 * @param motion  what is said of a motion.
 */
export function told(answer: Answer, motion: (step: MoveStep) => unknown = pathAndTarget): unknown {
  if (answer.kind === "not-understood") return `line ${answer.faults[0]!.line}: ${answer.faults[0]!.sentence}`;
  return answer.program.steps.map(step => {
    switch (step.type) {
      case "move":
        return motion(step);
      case "set":
        return `${step.signal}=${String(step.to)}`;
      case "wait":
        return `wait ${step.s}`;
      case "wait-for":
        return `until ${"signal" in step.when ? step.when.signal : "an expression"}`;
      default:
        return step.type;
    }
  });
}

/** What was left out or taken for granted, with its line. */
export const noticesOf = (answer: Answer): readonly string[] =>
  answer.kind === "executed" ? answer.notExecuted.map(({ line, sentence }) => `${line}: ${sentence}`) : [];
