import type { Refusal } from "@twincell/core";
import { COMMAND, SERVICE, ioGroupOf, lineAt } from "../codec/index.ts";
import type { Client } from "./client.ts";
import { noLine, notDigital, notTaken, notWritable } from "./words.ts";

/** Of an order that may be said twice without harm [s]. */
const PATIENCE_S = [0.3, 0.5, 1];

/** Lines by name, as bits of groups of eight. What was read last is what a written bit is put into. */
export interface LineTable {
  /** Groups that hold lines with names. */
  readonly groups: readonly number[];
  /** Starts the writing; `complain` is told when the controller refuses. */
  write(client: Client, signal: string, value: boolean | number, complain: (why: Refusal) => void): Refusal | null;
  /** Keeps what a group was read as. */
  take(group: number, value: number): void;
  read(signal: string): boolean;
}

export function lineTable(signals: Readonly<Record<string, number>>, changed: (signal: string, on: boolean) => void): LineTable {
  const places = Object.entries(signals).flatMap(([signal, logical]) => { const at = lineAt(logical); return at ? [{ signal, logical, ...at }] : []; });
  const groups = [...new Set(places.map(({ group }) => group))], values = new Map<number, number>();
  const find = (signal: string) => places.find(place => place.signal === signal);
  const isOn = ({ group, bit }: { readonly group: number; readonly bit: number }): boolean => ((values.get(group) ?? 0) & (1 << bit)) !== 0;
  const take = (group: number, value: number): void => {
    values.set(group, value);
    for (const place of places) if (place.group === group) changed(place.signal, isOn(place));
  };
  return {
    groups, take,
    read(signal) { const place = find(signal); return place !== undefined && isOn(place); },
    write(client, signal, value, complain) {
      const place = find(signal);
      if (!place) return noLine(signal);
      if (typeof value !== "boolean") return notDigital(signal);
      if (ioGroupOf(place.group)?.name !== "network input") return notWritable(signal, place.logical);
      const was = values.get(place.group) ?? 0, to = value ? was | (1 << place.bit) : was & ~(1 << place.bit);
      take(place.group, to);
      void client.ask({ command: COMMAND.io, instance: place.group, attribute: 1, service: SERVICE.setOne, data: Uint8Array.of(to), patience_s: PATIENCE_S }).then(answer => {
        if (answer.kind === "answer" && answer.reply.status === 0) return;
        // Nothing else is known to have changed it.
        take(place.group, was);
        complain(notTaken(`Writing "${signal}"`, answer));
      });
      return null;
    },
  };
}
