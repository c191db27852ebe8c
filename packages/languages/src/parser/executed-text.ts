import {
  emptyProgram,
  type Executed,
  type Interpreted,
  type Robot,
  type Signals,
  type TextFault,
} from "@twincell/core";
import type { ReadSteps } from "../reading/checked-import.ts";
import type { DeclaredCell } from "./declared-cell.ts";
import { textFault } from "./faults.ts";
import { plainText, textLines } from "./lines.ts";
import { unrolled, withComments, type Comment, type Unrolled, type Words } from "./unrolled.ts";

/** One execution of a text: its steps as they come, and what is learnt on the way. */
export interface Execution {
  readonly steps: Generator<Executed, void>;
}

/** A text that is ready to be executed, and what its comments say. */
export interface ExecutedText<Run extends Execution> {
  readonly start: (signals?: Signals) => Run;
  /** Filled while the text is executed. */
  readonly declared: DeclaredCell;
  readonly executable: () => Interpreted;
  readonly words: Words;
  /** What a person called the program. */
  readonly title: (lines: readonly string[]) => string;
  readonly comment: (line: string) => Comment | undefined;
  /** What the executions have to say. */
  readonly warnings: (runs: readonly Run[]) => readonly TextFault[];
  /** What the steps were meant to be, where the text alone does not say it. */
  readonly meant?: (done: Unrolled) => Unrolled;
}

/**
 * The neutral program that a text amounts to when it is executed and its motions are written down: loops, calls and
 * shifts come out as what they do, and decisions by inputs as decisions.
 */
export function programOfExecution<Run extends Execution>(
  text: string,
  robot: Robot,
  { start, declared, executable, words, title, comment, warnings, meant = done => done }: ExecutedText<Run>,
): ReadSteps {
  const runs: Run[] = [];
  const executed = (signals?: Signals): Run["steps"] => {
    const run = start(signals);
    runs.push(run);
    return run.steps;
  };
  const done = unrolled(executed, declared.signals, words);
  if (done.kind === "not-understood") return done;
  const lines = textLines(text).map(plainText);
  const { tools, frames, signals } = declared;
  return {
    kind: "parsed",
    waits: done.waits,
    executable,
    warnings: [...warnings(runs), ...done.repeated],
    program: {
      ...emptyProgram(robot.id, title(lines)),
      ...withComments(lines, meant(done), comment),
      tools,
      frames,
      signals,
    },
  };
}

/** @param parts  what the language counts: "axes", "joints". */
export const strangeRobot = (
  robot: Robot,
  language: string,
  parts: string,
): Extract<Interpreted, { kind: "not-understood" }> => ({
  kind: "not-understood",
  faults: [
    textFault(
      { line: 1, column: 1 },
      `a robot whose controller speaks ${language}`,
      `How ${language} counts the ${parts} of the ${robot.name} is not known.`,
    ),
  ],
});

/** What executions met by name, each name once. */
export const metByName = <Run, Value>(
  runs: readonly Run[],
  of: (run: Run) => ReadonlyMap<string, Value>,
): ReadonlyMap<string, Value> => new Map(runs.flatMap(run => [...of(run)]));
