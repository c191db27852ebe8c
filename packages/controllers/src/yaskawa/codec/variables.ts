import { COMMAND } from "./commands.ts";
import { POSITION_BYTES } from "./state.ts";

/** What a kind of value takes on the wire; numbers of the first and the last one. */
export interface ValueKind {
  readonly command: number;
  readonly bytes: number;
  readonly first: number;
  readonly last: number;
  readonly whole: boolean;
}

/** Variables and registers, as many as a controller has by default. Positions are read and written whole. */
export const KINDS: readonly ValueKind[] = [
  { command: COMMAND.register, bytes: 2, first: 0, last: 999, whole: false },
  { command: COMMAND.byte, bytes: 1, first: 0, last: 99, whole: false },
  { command: COMMAND.integer, bytes: 2, first: 0, last: 99, whole: false },
  { command: COMMAND.double, bytes: 4, first: 0, last: 99, whole: false },
  { command: COMMAND.real, bytes: 4, first: 0, last: 99, whole: false },
  { command: COMMAND.string, bytes: 16, first: 0, last: 99, whole: false },
  { command: COMMAND.robotPosition, bytes: POSITION_BYTES, first: 0, last: 127, whole: true },
  { command: COMMAND.basePosition, bytes: 36, first: 0, last: 127, whole: true },
  { command: COMMAND.externalAxis, bytes: 36, first: 0, last: 127, whole: true },
];

/** Groups of eight lines, by the logical number of the first one divided by ten. */
export const IO_GROUPS = [
  { name: "general input", first: 1, last: 512 },
  { name: "general output", first: 1001, last: 1512 },
  { name: "external input", first: 2001, last: 2128 },
  { name: "network input", first: 2701, last: 2956 },
  { name: "external output", first: 3001, last: 3128 },
  { name: "network output", first: 3701, last: 3956 },
  { name: "specific input", first: 4001, last: 4160 },
  { name: "specific output", first: 5001, last: 5300 },
  { name: "panel input", first: 6001, last: 6064 },
  { name: "auxiliary relay", first: 7001, last: 7999 },
  { name: "control status", first: 8001, last: 8512 },
  { name: "pseudo input", first: 8701, last: 8720 },
] as const;
export type IoName = (typeof IO_GROUPS)[number]["name"];

export const ioGroupOf = (group: number): (typeof IO_GROUPS)[number] | undefined =>
  IO_GROUPS.find(({ first, last }) => group >= first && group <= last);

/**
 * Group and bit of a line by its logical number, e.g. 27013: group 2701, bit 3. Undefined for a number that ends in 8
 * or 9.
 */
export const lineAt = (logical: number): { readonly group: number; readonly bit: number } | undefined =>
  Number.isInteger(logical) && logical >= 10 && logical % 10 < 8
    ? { group: Math.floor(logical / 10), bit: logical % 10 }
    : undefined;

/**
 * Network input that the ladder of the example passes on to OT#(1), the next one to OT#(2) and so on, as many as there
 * are groups.
 */
export const EXAMPLE_OUTPUTS = 27_170;
export const EXAMPLE_OUTPUT_GROUPS = 16;
