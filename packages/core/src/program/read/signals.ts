import type { SignalLine } from "../program.ts";
import { keys, type Reader } from "../../json/reader.ts";

const KINDS = ["digital-in", "digital-out", "analogue-in", "analogue-out"] as const;

export function readSignals(reader: Reader, value: unknown): Readonly<Record<string, SignalLine>> {
  if (value === undefined) return {};
  const fields = reader.object(value, "signals", "the table of signals");
  const entries: [string, SignalLine][] = [];
  for (const [name, entry] of Object.entries(fields ?? {})) {
    const path = `signals.${name}`;
    const what = `the signal “${name}”`;
    const line = reader.object(entry, path, what);
    if (name === "") reader.fault(path, "A signal has a name that is not empty.");
    if (line === undefined) continue;
    reader.onlyKeys(line, path, what, keys<SignalLine>()("kind", "address"));
    const kind = KINDS.find(known => known === line.kind);
    const { address } = line;
    if (kind === undefined) {
      reader.fault(
        `${path}.kind`,
        `${what} is of kind ${reader.shown(line.kind)}; a signal is one of ${KINDS.join(", ")}.`,
      );
      continue;
    }
    if (address === undefined) {
      entries.push([name, { kind }]);
      continue;
    }
    if (typeof address === "number" && Number.isInteger(address) && address >= 0)
      entries.push([name, { kind, address }]);
    else
      reader.fault(
        `${path}.address`,
        `the address of ${what} is a whole number from 0; here it is ${reader.shown(address)}.`,
      );
  }
  return Object.fromEntries(entries);
}
