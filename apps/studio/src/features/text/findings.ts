import type { Verdict } from "@twincell/core";
import type { LinePlace, ReadTextProgram, TextFinding } from "../../workers/text-messages.ts";

/** More than this nobody reads at once. */
const MAX_FINDINGS = 200;

/**
 * What is wrong with a text, each at its line: what could not be read, and what the check says of the motions. Bad
 * comes first.
 */
export function findingsOf(read: ReadTextProgram | null, verdict: Verdict | null): readonly TextFinding[] {
  if (read === null) return [];
  const places = new Map<string, LinePlace>(read.places);
  const said = new Set<string>();
  const checked = (verdict?.steps ?? []).flatMap(({ id, verdict: says, findings }) => {
    const place = places.get(id);
    if (place === undefined) return [];
    return findings.flatMap(({ sentence }): TextFinding[] => {
      const key = `${place.file}:${place.line}:${sentence}`;
      // A loop says the same of its line in every round.
      if (said.has(key)) return [];
      said.add(key);
      return [{ ...place, verdict: says === "bad" ? "bad" : "warn", sentence }];
    });
  });
  return [...read.findings, ...checked]
    .sort((a, b) => (a.verdict === b.verdict ? a.file - b.file || a.line - b.line : a.verdict === "bad" ? -1 : 1))
    .slice(0, MAX_FINDINGS);
}

/** The worst of each line of one file. */
export function marksOf(findings: readonly TextFinding[], file: number): ReadonlyMap<number, "bad" | "warn"> {
  const marks = new Map<number, "bad" | "warn">();
  for (const { line, verdict } of findings.filter(each => each.file === file))
    if (verdict === "bad" || !marks.has(line)) marks.set(line, verdict);
  return marks;
}
