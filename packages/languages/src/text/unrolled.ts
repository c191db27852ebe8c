import type { Executed, Group, Program, Step, TextFault } from "@twincell/core";
import { TextError, textFault } from "./faults.ts";
import { WaitsOutside } from "./waits-outside.ts";

/** A program with more steps than this is taken to repeat itself for ever. */
const MOST_STEPS = 200_000;

/** What a language calls its programs and their lines, for sentences. */
export interface Words {
  readonly program: string;
  readonly statement: string;
}
/** What a program did when it was executed to its end: its steps, each with the line it came from. */
export interface Unrolled {
  readonly kind: "unrolled";
  readonly steps: readonly Step[];
  readonly from: readonly number[];
  /** A wait for something outside ended it early. */
  readonly waits: readonly TextFault[];
  /** Lines that were executed more than once. */
  readonly repeated: readonly TextFault[];
}

/** Executes a program with its motions written down, so that loops, calls and shifts come out as what they do. */
export function unrolled(
  run: Iterator<Executed, unknown>,
  { program, statement }: Words,
): Unrolled | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] } {
  const steps: Step[] = [];
  const from: number[] = [];
  const met = new Set<number>();
  const again = new Set<number>();
  const waits: TextFault[] = [];
  try {
    for (let next = run.next(); next.done !== true; next = run.next()) {
      const { line, step } = next.value;
      if (step === undefined) continue;
      if (steps.length >= MOST_STEPS)
        throw new TextError(
          { line, column: 1 },
          `a ${program} that ends`,
          `The ${program} has more than ${MOST_STEPS} steps: it repeats itself for ever.`,
        );
      if (met.has(line)) again.add(line);
      met.add(line);
      from.push(line);
      steps.push({ ...step, id: `s${steps.length + 1}` });
    }
  } catch (cause) {
    if (cause instanceof WaitsOutside)
      waits.push(
        textFault({ line: 1, column: 1 }, `a ${program} that goes on by itself`, `${cause.message} ${cause.hint}`),
      );
    else if (cause instanceof TextError) return { kind: "not-understood", faults: [cause.fault] };
    else throw cause;
  }
  const repeated = [...again].map(line =>
    textFault(
      { line, column: 1 },
      `${statement} that is executed once`,
      `Line ${line} is executed more than once: every time became a step of its own.`,
    ),
  );
  return { kind: "unrolled", steps, from, waits, repeated };
}

/**
 * What a comment says: a name of the step behind it, a remark of its own, a heading over the steps up to the next one, or a
 * fold around steps. A heading or a fold without a name holds nothing together.
 */
export type Comment =
  | { readonly kind: "name" | "remark" | "heading" | "fold"; readonly text: string }
  | { readonly kind: "end-of-fold" }
  | { readonly kind: "new-part" };

/**
 * Gives steps the names and groups that stand in the comments of their text.
 *
 * @param say  what a line says, if it is a comment or begins another part of the text
 */
export function withComments(
  lines: readonly string[],
  { steps, from }: Unrolled,
  say: (line: string) => Comment | undefined,
): Pick<Program, "steps" | "groups"> {
  const stepLines = new Set(from);
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
  const list: Step[] = [];
  for (const [i, step] of steps.entries()) {
    const line = from[i]!;
    const called = names.get(line);
    const group = groupOf.get(line);
    const member = group === undefined ? {} : { group };
    const texts = before.get(line) ?? [];
    before.delete(line);
    for (const [k, text] of texts.entries()) list.push({ id: `${step.id}.${k + 1}`, type: "comment", text, ...member });
    list.push({ ...step, ...(called === undefined ? {} : { name: called }), ...member });
  }
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
