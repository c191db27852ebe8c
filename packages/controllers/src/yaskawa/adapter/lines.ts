import type { Refusal } from "@twincell/core";
import { COMMAND, SERVICE, ioGroupOf, lineAt } from "../codec/index.ts";
import type { Client } from "./client.ts";
import { noLadder, noLine, notDigital, notTaken, notWritable } from "./words.ts";

/** Of an order that may be said twice without harm [s]. */
const PATIENCE_S = [0.3, 0.5, 1];
/** First groups of general inputs and outputs: those of IN#(1) and OT#(1). */
const GENERAL_IN = 1;
const GENERAL_OUT = 1001;
/** Lines that are watched where nobody named any. */
const WATCHED = 16;
const MOST_GROUPS = 32;

/** Lines by name, as bits of groups of eight. What was read last is what a written bit is put into. */
export interface LineTable {
  /** Groups that hold lines with names. */
  readonly groups: readonly number[];
  /** Starts the writing; `complain` is told when the controller refuses. */
  write(client: Client, signal: string, value: boolean | number, complain: (why: Refusal) => void): Refusal | null;
  /** Why that line cannot be written; null when it can. */
  cannotWrite(signal: string, value: boolean | number): Refusal | null;
  /** Keeps what a group was read as. */
  take(group: number, value: number): void;
  read(signal: string): boolean;
}
interface Place {
  readonly names: readonly string[];
  readonly logical: number;
  readonly group: number;
  readonly bit: number;
}

/**
 * The logical number of a line by its own name: `IN#(3)`, `OT#(12)` (INFORM's words; `in_3`, `out_12`), or the number
 * itself; undefined when it is none.
 */
export function logicalOf(signal: string): number | undefined {
  const match = /^(in|ou?t)(?:_([0-9]{1,4})|#\(([0-9]{1,4})\))$/i.exec(signal);
  if (!match) return /^[0-9]{2,5}$/.test(signal) ? Number(signal) : undefined;
  const n = Number(match[2] ?? match[3]) - 1;
  const first = match[1]!.toLowerCase() === "in" ? GENERAL_IN : GENERAL_OUT;
  return n < 0 ? undefined : 10 * (first + Math.floor(n / 8)) + (n % 8);
}
/** What INFORM calls a general line; "" for others. */
function ownName({ group, bit }: { readonly group: number; readonly bit: number }): string {
  const kind = ioGroupOf(group)?.name;
  return kind === "general input"
    ? `IN#(${8 * (group - GENERAL_IN) + bit + 1})`
    : kind === "general output"
      ? `OT#(${8 * (group - GENERAL_OUT) + bit + 1})`
      : "";
}
/** The first general lines, for a controller of which nobody named any. */
export const watchedLines = (): Readonly<Record<string, number>> =>
  Object.fromEntries(
    Array.from({ length: WATCHED }, (_, i) => i + 1).flatMap(n =>
      [`in_${n}`, `ot_${n}`].map(name => [name, logicalOf(name)!]),
    ),
  );

/**
 * @param outputsFrom  network input that the ladder of the controller passes on to OT#(1), the next one to OT#(2) and
 *   so on:
 *                     from outside an output is switched in no other way. Undefined when it has none.
 */
export function lineTable(
  signals: Readonly<Record<string, number>>,
  outputsFrom: number | undefined,
  changed: (signal: string, on: boolean) => void,
): LineTable {
  const places: Place[] = [];
  const groups: number[] = [];
  const values = new Map<number, number>();
  const watch = (group: number): void => {
    if (!groups.includes(group) && groups.length < MOST_GROUPS) groups.push(group);
  };
  function add(signal: string, logical: number): Place | undefined {
    const at = lineAt(logical);
    if (!at || !ioGroupOf(at.group)) return undefined;
    const own = ownName(at);
    const place: Place = { names: own === "" || own === signal ? [signal] : [signal, own], logical, ...at };
    places.push(place);
    watch(at.group);
    return place;
  }
  for (const [signal, logical] of Object.entries(signals)) add(signal, logical);

  function find(signal: string): Place | undefined {
    const known = places.find(({ names }) => names.includes(signal));
    if (known) return known;
    // One that is named for the first time is watched from then on.
    const logical = logicalOf(signal);
    return logical === undefined ? undefined : add(signal, logical);
  }
  const isOn = ({ group, bit }: Pick<Place, "group" | "bit">): boolean => ((values.get(group) ?? 0) & (1 << bit)) !== 0;
  const take = (group: number, value: number): void => {
    values.set(group, value);
    for (const place of places) if (place.group === group) for (const name of place.names) changed(name, isOn(place));
  };
  function cannotWrite(signal: string, value: boolean | number): Refusal | null {
    const place = find(signal);
    if (!place) return noLine(signal);
    if (typeof value !== "boolean") return notDigital(signal);
    const kind = ioGroupOf(place.group)?.name;
    if (kind === "general output") return outputsFrom === undefined ? noLadder(signal, place.logical) : null;
    return kind === "network input" ? null : notWritable(signal, place.logical);
  }
  return {
    groups,
    take,
    cannotWrite,
    read(signal) {
      const place = find(signal);
      return place !== undefined && isOn(place);
    },
    write(client, signal, value, complain) {
      const why = cannotWrite(signal, value);
      if (why) return why;
      const place = find(signal)!;
      const group =
        ioGroupOf(place.group)?.name === "network input"
          ? place.group
          : Math.floor(outputsFrom! / 10) + place.group - GENERAL_OUT;
      watch(group);
      const was = values.get(group) ?? 0;
      const to = value ? was | (1 << place.bit) : was & ~(1 << place.bit);
      take(group, to);
      void client
        .ask({
          command: COMMAND.io,
          instance: group,
          attribute: 1,
          service: SERVICE.setOne,
          data: Uint8Array.of(to),
          patience_s: PATIENCE_S,
        })
        .then(answer => {
          if (answer.kind === "answer" && answer.reply.status === 0) return;
          // Nothing else is known to have changed it.
          take(group, was);
          complain(notTaken(`Writing "${signal}"`, answer));
        });
      return null;
    },
  };
}
