import {
  Fault,
  SignalTable,
  emptyProgram,
  identity,
  type Dialect,
  type Executed,
  type Pose,
  type Program,
  type Robot,
  type Skipped,
  type Step,
  type TextFault,
} from "@twincell/core";
import { isMissingProgram, TextError, WaitsOutside } from "../parser/index.ts";

export interface ExecuteOptions {
  /** What inputs say from the start; others are off. */
  readonly inputs?: Readonly<Record<string, boolean | number>>;
  readonly skipUnknown?: boolean;
  /** See `ReadOptions`. */
  readonly missingPrograms?: "leave-out";
  /** More steps than this are cut off, and said. */
  readonly maxSteps?: number;
}

export type ExecutedText =
  | {
      readonly kind: "executed";
      /** What the text does, step by step in the order of execution: loops, calls and decisions are carried out. */
      readonly program: Program;
      /** Line of the text that each step came from. */
      readonly lines: ReadonlyMap<string, number>;
      /** Why the text goes on where the program ends; undefined when it came to its end. */
      readonly cut?: string;
      readonly skipped: readonly Skipped[];
      /** What is kept and shown but not executed; nothing of it moves the robot. */
      readonly notExecuted: readonly TextFault[];
    }
  | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] };

const MAX_STEPS = 20_000;
/** Statements in a row without a step: a loop that only counts. */
const MAX_IDLE = 200_000;

/**
 * Carries a text out with its vendor's conventions and writes down what it does, so that it is planned, checked and
 * played as a taught program is. The text decides by `inputs`; nothing of it is converted for keeping.
 */
export function executeText(
  dialect: Pick<Dialect, "interpret">,
  text: string,
  name: string,
  robot: Robot,
  worldFromBase: Pose<"world", "base"> = identity(),
  { inputs = {}, skipUnknown = false, maxSteps = MAX_STEPS, missingPrograms }: ExecuteOptions = {},
): ExecutedText {
  const interpreted = dialect.interpret(text, robot, worldFromBase, {
    skipUnknown,
    ...(missingPrograms === undefined ? {} : { missingPrograms }),
  });
  if (interpreted.kind === "not-understood") return interpreted;
  const { context, skipped = [], notExecuted = [] } = interpreted;
  const run: Iterator<Executed, void> = interpreted.run(new SignalTable(Object.entries(inputs)));
  const steps: Step[] = [];
  const lines = new Map<string, number>();
  const rounds = new Map<number, number>();
  let idle = 0;
  let line = 1;
  let cut: string | undefined;
  try {
    for (let next = run.next(); next.done !== true; next = run.next()) {
      ({ line } = next.value);
      const { step } = next.value;
      if (step === undefined) {
        if (++idle < MAX_IDLE) continue;
        cut = `Line ${line}: ${MAX_IDLE} statements were executed without a motion, wait or signal; the text was left there.`;
        break;
      }
      idle = 0;
      if (steps.length >= maxSteps) {
        cut = `Line ${line}: the text goes on after ${maxSteps} steps; these are planned and checked.`;
        break;
      }
      const round = (rounds.get(line) ?? 0) + 1;
      rounds.set(line, round);
      const id = round === 1 ? `line ${line}` : `line ${line} (${round})`;
      lines.set(id, line);
      steps.push({ ...step, id });
    }
  } catch (cause) {
    if (!(cause instanceof Fault)) throw cause;
    // It goes on when an input changes: what was done up to there is what it does until then.
    if (cause instanceof WaitsOutside) return executed(`${cause.message} ${cause.hint}`.trim());
    return notUnderstood(cause, line);
  }
  return executed(cut);

  function executed(why: string | undefined): ExecutedText {
    return {
      kind: "executed",
      program: {
        ...emptyProgram(robot.id, name),
        tools: { ...context.tools },
        frames: { ...context.frames },
        signals: { ...context.signals },
        steps,
      },
      lines,
      ...(why === undefined ? {} : { cut: why }),
      skipped,
      notExecuted,
    };
  }
}

const notUnderstood = (cause: Fault, line: number): ExecutedText => ({
  kind: "not-understood",
  faults: [
    cause instanceof TextError && isMissingProgram(cause)
      ? cause.fault
      : {
          line,
          column: 1,
          expected: "a statement that can be executed",
          sentence: `${cause.message} ${cause.hint}`.trim(),
        },
  ],
});
