import {
  everyStep,
  listsOf,
  withLists,
  type ListPlace,
  type Program,
  type Step,
  type StepVerdict,
  type Verdict,
} from "@twincell/core";
import { worse } from "../../stores/play.ts";
import { stepWords } from "../../stores/program.ts";
import { words } from "../../messages/index.ts";

interface Base {
  readonly key: string;
  /** Blocks around it. */
  readonly depth: number;
  readonly verdict: StepVerdict;
}
/** One line of the program list: a step, the head of a run of steps of one group, or the head of a list of steps. */
export type ProgramRow =
  | (Base & { readonly kind: "step"; readonly step: Step; readonly index: number; readonly inside: boolean })
  | (Base & {
      readonly kind: "group";
      readonly group: string;
      readonly name: string;
      readonly steps: readonly Step[];
      readonly first: number;
      readonly open: boolean;
    })
  /** "Otherwise", or a routine. `before`: the list that ends above it. */
  | (Base & {
      readonly kind: "head";
      readonly name: string;
      readonly before: ListPlace;
      readonly routine?: string;
    });

/**
 * Steps that follow one another in the same group are one line until it is opened; steps inside blocks stand below
 * them.
 */
export function programRows(
  program: Program,
  verdict: Verdict | null,
  open: ReadonlySet<string>,
): readonly ProgramRow[] {
  const verdicts = new Map(verdict?.steps.map(report => [report.id, report.verdict]));
  const rows: ProgramRow[] = [];
  const of = (step: Step): StepVerdict => verdicts.get(step.id) ?? "unknown";
  let index = 0;
  const add = (step: Step, depth: number, inside: boolean): void => {
    rows.push({ kind: "step", key: step.id, step, index: index++, inside, depth, verdict: of(step) });
    for (const [side, steps] of listsOf(step).entries()) {
      if (side === 1)
        rows.push({
          kind: "head",
          key: `else ${step.id}`,
          name: words.step.else,
          before: { block: step.id, side: "then" },
          depth,
          verdict: of(step),
        });
      list(steps, depth + 1);
    }
  };
  const list = (steps: readonly Step[], depth: number): void => {
    for (let at = 0; at < steps.length; ) {
      const step = steps[at]!;
      const { group } = step;
      if (group === undefined) {
        add(step, depth, false);
        at++;
        continue;
      }
      let end = at;
      while (steps[end]?.group === group) end++;
      const members = steps.slice(at, end);
      const isOpen = open.has(step.id);
      rows.push({
        kind: "group",
        key: `group ${group} ${step.id}`,
        group,
        name: program.groups[group]?.name ?? group,
        steps: members,
        first: index,
        open: isOpen,
        depth,
        verdict: members.reduce<StepVerdict>((so, each) => worse(so, of(each)), of(step)),
      });
      if (isOpen) for (const each of members) add(each, depth, true);
      else index += members.reduce((sum, each) => sum + sizeOf(each), 0);
      at = end;
    }
  };
  list(program.steps, 0);
  let previous: ListPlace = "main";
  for (const [name, steps] of Object.entries(program.routines)) {
    rows.push({
      kind: "head",
      key: `routine ${name}`,
      name: words.step.routine(name),
      before: previous,
      routine: name,
      depth: 0,
      verdict: steps.reduce<StepVerdict>((so, step) => worse(so, of(step)), "ok"),
    });
    list(steps, 1);
    previous = { routine: name };
  }
  return rows;
}
/**
 * Lines of the steps in which a text is found: in what they are called or say, in names of signals, variables, frames,
 * tools, routines and pallets.
 */
export function foundRows(program: Program, verdict: Verdict | null, query: string): readonly ProgramRow[] {
  const wanted = query.trim().toLowerCase();
  const all = programRows(program, verdict, new Set(Array.from(everyStep(program), step => step.id)));
  return all.filter(row => row.kind === "step" && textOfStep(program, row.step, row.index).includes(wanted));
}
function textOfStep(program: Program, step: Step, index: number): string {
  const { id: _id, type: _type, group, ...own } = withLists(step, () => []);
  const names: string[] = [stepWords(step, index), program.groups[group ?? ""]?.name ?? ""];
  const collect = (value: unknown): void => {
    if (typeof value === "string") names.push(value);
    else if (typeof value === "object" && value !== null) Object.values(value).forEach(collect);
  };
  collect(own);
  return names.join("\n").toLowerCase();
}
/** The step and all that are inside it. */
const sizeOf = (step: Step): number =>
  listsOf(step)
    .flat()
    .reduce((sum, each) => sum + sizeOf(each), 1);

export const stepsOf = (row: ProgramRow): readonly Step[] =>
  row.kind === "step" ? [row.step] : row.kind === "group" ? row.steps : [];
export const idsOf = (row: ProgramRow): readonly string[] => stepsOf(row).map(step => step.id);
/** PTP, LIN, … of a row; "" where there is none or they differ. */
export function pathOf(row: ProgramRow): "ptp" | "lin" | "circ" | "spline" | "" {
  const paths = new Set(stepsOf(row).map(step => (step.type === "move" ? step.path : "")));
  return paths.size === 1 ? [...paths][0]! : "";
}
/**
 * What stands above a row when something is put there: a step to stand before, a list to end, or null for the end of
 * the program.
 */
export function anchorOf(row: ProgramRow | undefined): string | null | ListPlace {
  if (row === undefined) return null;
  return row.kind === "head" ? row.before : (idsOf(row)[0] ?? null);
}
/** The first row behind a row and all that is inside it. */
export function behind(rows: readonly ProgramRow[], at: number): number {
  const row = rows[at];
  if (row === undefined || row.kind !== "step") return at + 1;
  const deeper = rows.findIndex(
    (other, i) =>
      i > at && (other.depth < row.depth || (other.depth === row.depth && other.key !== `else ${row.step.id}`)),
  );
  return deeper < 0 ? rows.length : deeper;
}
