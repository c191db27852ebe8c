import type { Program, Step, StepVerdict, Verdict } from "@twincell/core";
import { worse } from "../../stores/play.ts";

/** One line of the program list: a step, or the head of a run of steps of one group. */
export type ProgramRow =
  | { readonly kind: "step"; readonly key: string; readonly step: Step; readonly index: number; readonly inside: boolean; readonly verdict: StepVerdict }
  | { readonly kind: "group"; readonly key: string; readonly group: string; readonly name: string; readonly steps: readonly Step[]; readonly first: number; readonly open: boolean; readonly verdict: StepVerdict };

/** Steps that follow one another in the same group are one line until it is opened. */
export function programRows(program: Program, verdict: Verdict | null, open: ReadonlySet<string>): readonly ProgramRow[] {
  const verdicts = new Map(verdict?.steps.map(report => [report.id, report.verdict]));
  const of = (step: Step): StepVerdict => verdicts.get(step.id) ?? "unknown";
  const rows: ProgramRow[] = [];
  for (let at = 0; at < program.steps.length;) {
    const step = program.steps[at]!, { group } = step;
    if (group === undefined) { rows.push({ kind: "step", key: step.id, step, index: at, inside: false, verdict: of(step) }); at++; continue; }
    let end = at;
    while (program.steps[end]?.group === group) end++;
    const steps = program.steps.slice(at, end), isOpen = open.has(step.id);
    const key = `group ${group} ${step.id}`;
    rows.push({
      kind: "group", key, group, name: program.groups[group]?.name ?? group, steps, first: at, open: isOpen,
      verdict: steps.reduce<StepVerdict>((so, each) => worse(so, of(each)), of(step)),
    });
    if (isOpen) for (const [i, each] of steps.entries()) rows.push({ kind: "step", key: each.id, step: each, index: at + i, inside: true, verdict: of(each) });
    at = end;
  }
  return rows;
}
export const idsOf = (row: ProgramRow): readonly string[] => (row.kind === "step" ? [row.step.id] : row.steps.map(step => step.id));
/** PTP, LIN, … of a row; "" where there is none or they differ. */
export function pathOf(row: ProgramRow): "ptp" | "lin" | "circ" | "spline" | "" {
  const paths = new Set((row.kind === "step" ? [row.step] : row.steps).map(step => (step.type === "move" ? step.path : "")));
  return paths.size === 1 ? [...paths][0]! : "";
}
