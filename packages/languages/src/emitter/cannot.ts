import type { Capability, Dialect, Emitted, Program, Robot, Step } from "@twincell/core";
import { capabilitiesUsed } from "@twincell/core";

export type Cannot = Extract<Emitted, { kind: "cannot" }>;

/** Ends the writing of a program: nothing of it is kept. Caught at the door of the dialect. */
export class UnsupportedStep extends Error {
  readonly answer: Cannot;
  constructor(step: string, sentence: string, hint: string) {
    super(sentence);
    this.answer = { kind: "cannot", step, sentence, hint };
  }
}

/** A program that is longer than the controller holds: it may be written in parts. */
export class TooLong extends UnsupportedStep {}

export const called = ({ id, name }: Pick<Step, "id" | "name">): string => `Step ${name ?? id}`;

const WORDS: Partial<Record<Capability, string>> = {
  circ: "is a circ move",
  spline: "is a spline move",
  duration: "is given a duration",
  acceleration: "is given an acceleration",
  search: "is a search move",
  timeout: "waits with a time limit",
  pulse: "is a pulse",
};

/** The first step that asks for what the dialect declares it cannot. */
export function undeclared(program: Program, cannot: Dialect["cannot"]): Cannot | undefined {
  const used = capabilitiesUsed(program);
  for (const { what, because } of cannot) {
    const step = used.get(what);
    if (step !== undefined)
      return {
        kind: "cannot",
        step: step.id,
        sentence: `${called(step)} ${WORDS[what] ?? `asks for ${what}`}. ${because}`,
        hint: "Say it in another way, or take the step out.",
      };
  }
  return undefined;
}

/** Writes, or says why not. */
export function writtenOr(write: () => Emitted): Emitted {
  try {
    return write();
  } catch (cause) {
    if (!(cause instanceof UnsupportedStep)) throw cause;
    return cause.answer;
  }
}

export const tellsRobot = (program: Program, robot: Robot): string[] =>
  program.robot === robot.id ? [] : [`The program was taught on ${program.robot} and is written for ${robot.id}.`];
