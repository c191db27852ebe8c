import { capabilitiesOf, type Dialect, type Program, type SetStep, type SignalLine, type Step } from "@twincell/core";
import { UnsupportedStep, called, type Cannot } from "./cannot.ts";
import { linesLookedAt } from "./expressions.ts";
import { outOfRange, type LineRanges } from "./line-ranges.ts";

/** What a language lacks, told of the first step that asks for it, with its way out. */
export interface Lack {
  readonly language: string;
  readonly cannot: Dialect["cannot"];
  readonly hints: Readonly<Record<string, string>>;
}

/** Whether a step asks for what the language lacks. */
export function lacking(step: Step, { language, cannot, hints }: Lack): Cannot | undefined {
  for (const capability of capabilitiesOf(step)) {
    const why = cannot.find(({ what }) => what === capability);
    if (why !== undefined)
      return {
        kind: "cannot",
        step: step.id,
        sentence: `${called(step)} asks for what ${language} lacks. ${why.because}`,
        hint: hints[capability]!,
      };
  }
  return undefined;
}

export const arcWithoutVia = (step: Step): Cannot | undefined =>
  step.type === "move" && step.path === "circ" && step.via === undefined
    ? {
        kind: "cannot",
        step: step.id,
        sentence: `${called(step)} is an arc without a point to pass through.`,
        hint: "Teach the point in the middle of the arc.",
      }
    : undefined;

/** How a language counts its lines. */
export interface NumberedLines {
  readonly language: string;
  readonly ranges: LineRanges;
  /** "$IN and $OUT count from 1". */
  readonly counting: string;
}

/** A name of a step that leads nowhere: a signal without an address, a routine or a pallet that is not there. */
export function unresolved(program: Program, step: Step, lines: NumberedLines): Cannot | undefined {
  for (const name of linesOf(step)) {
    const flaw = unresolvedLine(program, step, name, lines);
    if (flaw !== undefined) return flaw;
  }
  if (step.type === "call" && !Object.hasOwn(program.routines, step.routine))
    return {
      kind: "cannot",
      step: step.id,
      sentence: `${called(step)} calls "${step.routine}", which the program does not have.`,
      hint: "Add the routine to the program.",
    };
  if (step.type === "pallet" && !Object.hasOwn(program.pallets, step.pallet))
    return {
      kind: "cannot",
      step: step.id,
      sentence: `${called(step)} uses the pallet "${step.pallet}", which the program does not have.`,
      hint: "Add the pallet to the program.",
    };
  return undefined;
}

function unresolvedLine(
  { signals }: Program,
  step: Step,
  name: string,
  { language, ranges, counting }: NumberedLines,
): Cannot | undefined {
  const line = Object.hasOwn(signals, name) ? signals[name] : undefined;
  if (line === undefined)
    return {
      kind: "cannot",
      step: step.id,
      sentence: `${called(step)} uses the signal "${name}", which the program does not have.`,
      hint: "Add the signal to the program.",
    };
  if (line.address === undefined)
    return {
      kind: "cannot",
      step: step.id,
      sentence: `${called(step)} uses the signal "${name}", whose number on the controller is not given.`,
      hint: `Give the signal the number of its line: ${counting}.`,
    };
  const wrong = outOfRange(language, ranges, step, name, line);
  return wrong === undefined ? undefined : { kind: "cannot", step: step.id, ...wrong };
}

/** The lines that a step uses: those it sets, looks at, or searches by. */
function linesOf(step: Step): readonly string[] {
  switch (step.type) {
    case "set":
      return [step.signal];
    case "move":
      return step.until === undefined ? [] : [step.until.when.signal];
    default:
      return [...linesLookedAt(step)];
  }
}

/** The first of these steps that something is wrong with. */
export function firstFlaw(steps: readonly Step[], flawOf: (step: Step) => Cannot | undefined): Cannot | undefined {
  for (const step of steps) {
    const flaw = flawOf(step);
    if (flaw !== undefined) return flaw;
  }
  return undefined;
}

/** "1 step", "2 steps". */
export const counted = (count: number, one: string, more: string): string => `${count} ${count === 1 ? one : more}`;

/** What kind of line a signal of the list is. @throws {UnsupportedStep} where the list does not have it. */
export function lineKind({ signals }: Program, signal: string, step: Step): SignalLine["kind"] {
  if (!Object.hasOwn(signals, signal))
    throw new UnsupportedStep(
      step.id,
      `${called(step)} uses the line ${signal}, which is not in the list of signals.`,
      "Add it to the list.",
    );
  return signals[signal]!.kind;
}

/** @throws {UnsupportedStep} where a step sets an input, or a line to what it cannot hold. */
export function checkSetting(step: SetStep, kind: SignalLine["kind"]): void {
  const { to } = step;
  if (kind.endsWith("in"))
    throw new UnsupportedStep(
      step.id,
      `${called(step)} writes the line ${step.signal}, which is an input.`,
      "Choose an output.",
    );
  if (kind.startsWith("digital") !== (typeof to === "boolean"))
    throw new UnsupportedStep(
      step.id,
      `${called(step)} writes ${String(to)} to the line ${step.signal}, which is ${kind}.`,
      "Choose a value of that line.",
    );
}
