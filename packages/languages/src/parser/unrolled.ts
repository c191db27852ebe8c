import type { Executed, Group, Program, SignalLine, Signals, Step, TextFault } from "@twincell/core";
import { numberedSteps, repeatedWarnings, writtenOut } from "../reading/written-out.ts";

/** What a language calls its programs and their lines, for sentences. */
export interface Words {
  readonly program: string;
  readonly statement: string;
}
/** What a program did when it was executed to its end: its steps, each with the line it came from, by its id. */
export interface Unrolled {
  readonly kind: "unrolled";
  readonly steps: readonly Step[];
  readonly from: ReadonlyMap<string, number>;
  /** Steps that wait where the text goes round until an input changes. */
  readonly waits: ReadonlySet<string>;
  /** Lines that were executed more than once. */
  readonly repeated: readonly TextFault[];
}

/**
 * Executes a program with its motions written down, so that loops, calls and shifts come out as what they do, and
 * decisions by inputs as decisions.
 *
 * @param kinds  the lines of the controller, by name; filled while the program is executed.
 */
export function unrolled(
  run: (signals: Signals) => Iterator<Executed, unknown>,
  kinds: Readonly<Record<string, SignalLine>>,
  { program, statement }: Words,
): Unrolled | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] } {
  let why: TextFault | undefined;
  for (const merged of [true, false]) {
    const written = writtenOut(run, kinds, { merged, called: program });
    if (written.kind === "cannot") {
      why ??= written.fault;
      continue;
    }
    const from = new Map<string, number>();
    const waits = new Set<string>();
    const steps = numberedSteps(written.steps, from, waits);
    return { kind: "unrolled", steps, from, waits, repeated: repeatedWarnings(written.repeated, statement) };
  }
  return { kind: "not-understood", faults: [why!] };
}

/**
 * What a comment says: a name of the step behind it, a remark of its own, a heading over the steps up to the next one,
 * or a fold around steps. A heading or a fold without a name holds nothing together.
 */
export type Comment =
  | { readonly kind: "name" | "remark" | "heading" | "fold"; readonly text: string }
  | { readonly kind: "end-of-fold" }
  | { readonly kind: "new-part" };

/**
 * Gives steps the names and groups that stand in the comments of their text.
 *
 * @param from  the line of each step, by its id; a step inside a decision has its own.
 * @param say   what a line says, if it is a comment or begins another part of the text
 */
export function withComments(
  lines: readonly string[],
  { steps, from }: { readonly steps: readonly Step[]; readonly from: ReadonlyMap<string, number> },
  say: (line: string) => Comment | undefined,
): Pick<Program, "steps" | "groups"> {
  const stepLines = new Set(from.values());
  const names = new Map<number, string>();
  const groupOf = new Map<number, string>();
  const before = new Map<number, readonly string[]>();
  const groups: Record<string, Group> = {};
  let name: string | undefined;
  let said: string[] = [];
  let count = 0;
  let open: (string | undefined)[] = [];
  for (const [i, line] of lines.entries()) {
    const comment = say(line);
    switch (comment?.kind) {
      case "name":
        name = comment.text;
        break;
      case "remark":
        said.push(comment.text);
        break;
      case "heading":
      case "fold": {
        const id = comment.text === "" ? undefined : `g${++count}`;
        if (comment.kind === "heading") open = [];
        open.push(id);
        if (id !== undefined) groups[id] = { name: comment.text };
        break;
      }
      case "end-of-fold":
        open.pop();
        break;
      case "new-part":
        open = [];
        name = undefined;
        said = [];
        break;
      case undefined:
        break;
    }
    if (!stepLines.has(i + 1)) continue;
    const group = open.findLast(each => each !== undefined);
    if (name !== undefined) names.set(i + 1, name);
    if (group !== undefined) groupOf.set(i + 1, group);
    if (said.length > 0) before.set(i + 1, said);
    name = undefined;
    said = [];
  }
  const dressed = (inside: readonly Step[]): Step[] => inside.flatMap(dress);
  const dress = (step: Step): Step[] => {
    const line = from.get(step.id)!;
    const called = names.get(line);
    const group = groupOf.get(line);
    const member = group === undefined ? {} : { group };
    const texts = before.get(line) ?? [];
    before.delete(line);
    const remarks = texts.map((text, k): Step => ({ id: `${step.id}.${k + 1}`, type: "comment", text, ...member }));
    const own: Step = { ...step, ...(called === undefined ? {} : { name: called }), ...member };
    if (own.type !== "if") return [...remarks, own];
    const then = dressed(own.then);
    return [...remarks, { ...own, then, ...(own.else === undefined ? {} : { else: dressed(own.else) }) }];
  };
  const list = dressed(steps);
  const used = new Set(groupOf.values());
  return { groups: Object.fromEntries(Object.entries(groups).filter(([id]) => used.has(id))), steps: list };
}

/** `name`, `== heading`, `* remark`: what the comments of our own texts say. An empty one says nothing. */
export function headingOr(comment: string | undefined): Comment | undefined {
  const said = comment?.trim() ?? "";
  if (said === "") return undefined;
  if (said.startsWith("==")) return { kind: "heading", text: said.replace(/^=+\s*/, "") };
  return said.startsWith("*") ? { kind: "remark", text: said.slice(1).trim() } : { kind: "name", text: said };
}
