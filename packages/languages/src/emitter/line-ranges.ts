import type { SignalLine, Step } from "@twincell/core";

/** From the first to the last number, both included. */
export type LineRange = readonly [first: number, last: number];

/** The numbers that a controller has for each kind of line; a kind that is not there has none. */
export type LineRanges = Readonly<Partial<Record<SignalLine["kind"], readonly LineRange[]>>>;

/** KSS 8: $IN, $OUT, $ANIN, $ANOUT. */
export const KRL_LINES: LineRanges = {
  "digital-in": [[1, 4096]],
  "digital-out": [[1, 4096]],
  "analogue-in": [[1, 32]],
  "analogue-out": [[1, 32]],
};
/** YRC1000: 512 groups of 8 general inputs and outputs; 40 analogue ones. */
export const INFORM_LINES: LineRanges = {
  "digital-in": [[1, 4096]],
  "digital-out": [[1, 4096]],
  "analogue-in": [[1, 40]],
  "analogue-out": [[1, 40]],
};
/** The widest that R-30iB can be set up with: a controller may have fewer. */
export const FANUC_LINES: LineRanges = {
  "digital-in": [[1, 2048]],
  "digital-out": [[1, 2048]],
  "analogue-in": [[1, 64]],
  "analogue-out": [[1, 64]],
};
/** V+ counts outputs from 1, inputs from 1001 and soft signals, which are both, from 2001. */
export const VPLUS_LINES: LineRanges = {
  "digital-in": [
    [1001, 1512],
    [2001, 2512],
  ],
  "digital-out": [
    [1, 512],
    [2001, 2512],
  ],
};

const WORDS: Readonly<Record<SignalLine["kind"], string>> = {
  "digital-in": "inputs",
  "digital-out": "outputs",
  "analogue-in": "analogue inputs",
  "analogue-out": "analogue outputs",
};

/** Why a line cannot be written with its number, and the way out; undefined when it can. */
export function outOfRange(
  language: string,
  ranges: LineRanges,
  step: Step,
  signal: string,
  { kind, address }: SignalLine,
): { readonly sentence: string; readonly hint: string } | undefined {
  if (address === undefined) return undefined;
  const allowed = ranges[kind] ?? [];
  if (Number.isInteger(address) && allowed.some(([first, last]) => address >= first && address <= last))
    return undefined;
  const numbers = allowed.map(([first, last]) => `${first} to ${last}`).join(" or ");
  return {
    sentence: `Step ${step.name ?? step.id} uses the signal "${signal}" with the number ${address}; ${WORDS[kind]} of ${language} are ${numbers}.`,
    hint: `Give the signal a number from ${numbers}.`,
  };
}
