import type { Dialect, Interpreted, LineShapes, Parsed, Pose, Robot, Skipped, TextFault } from "@twincell/core";
import { checkedImport } from "../reading/checked-import.ts";
import { isMissingProgram, leftOutSentence, missingName } from "./missing.ts";
import { NOT_GIVEN } from "./notices.ts";
import { dryRun } from "./rehearse.ts";
import { withIdentity } from "./identity.ts";

/** A text is read again without what was not understood at most this often; each time tells up to fifty places. */
const MOST_READINGS = 400;

/**
 * The dialect with a reader that leaves out what it does not understand when it is asked to: line by line, a block with
 * all that is in it, since nobody knows when it would run. Each place is told with the fault that stands there. The
 * fault of a text that is no program at all, or that stays when its line is left out, remains.
 */
export function skippingDialect(given: Dialect, isPlaces?: (text: string) => boolean): Dialect {
  const dialect = withIdentity(given);
  const { lines } = dialect;
  const checked = (text: string, robot: Robot, worldFromBase?: Pose<"world", "base">): Parsed =>
    checkedImport({ ...dialect, ...(isPlaces === undefined ? {} : { isPlaces }) }, text, robot, worldFromBase);
  if (lines === undefined) return { ...dialect, parse: checked };
  return {
    ...dialect,
    parse(text, robot, worldFromBase, options) {
      if (options?.skipUnknown !== true) return checked(text, robot, worldFromBase);
      return without(
        text,
        lines,
        shorter => dialect.parse(shorter, robot, worldFromBase),
        shorter => checked(shorter, robot, worldFromBase),
      );
    },
    interpret(text, robot, worldFromBase, options) {
      const tried = (shorter: string): Interpreted => {
        const answer = dialect.interpret(shorter, robot, worldFromBase);
        if (answer.kind === "not-understood") return answer;
        // Decisions may hide what is not understood: they are tried both ways.
        const fault = dryRun({
          [Symbol.iterator]: () =>
            answer.run({
              read: () => true,
              write: () => {
                /* nobody looks */
              },
            }),
        });
        return fault === undefined ? answer : { kind: "not-understood" as const, faults: [fault] };
      };
      if (options?.skipUnknown === true) return without(text, lines, tried);
      const answer = dialect.interpret(text, robot, worldFromBase);
      const isAsked = options?.missingPrograms === "leave-out";
      if (answer.kind === "ready" ? !isAsked : !answer.faults.some(isMissingProgram)) return answer;
      // All calls that lead nowhere are looked for, so that they can be told at once.
      const known = without(text, lines, tried, undefined, isMissingProgram);
      if (known.kind === "not-understood" && !known.faults.every(isMissingProgram)) return known;
      const missing = known.kind === "ready" ? known.skipped.map(({ fault }) => fault) : known.faults;
      if (known.kind === "not-understood" || !isAsked) return { kind: "not-understood", faults: missing };
      const { skipped: _, ...ready } = known;
      const leftOut = missing.map(fault => ({ ...fault, expected: NOT_GIVEN, sentence: leftOutSentence(fault) }));
      // The list grows while the text runs: it stays the same one.
      const notExecuted = (ready.notExecuted ?? []) as TextFault[];
      notExecuted.push(...leftOut);
      return { ...ready, notExecuted };
    },
  };
}

type LeftOut = Skipped & { readonly fault: TextFault };
type NotUnderstood = { readonly kind: "not-understood"; readonly faults: readonly TextFault[] };

function without<A extends { readonly kind: string }>(
  text: string,
  shapes: LineShapes,
  read: (text: string) => A | NotUnderstood,
  confirm?: (text: string) => A | NotUnderstood,
  only?: (fault: TextFault) => boolean,
): (Omit<A, "skipped"> & { readonly skipped: readonly LeftOut[] }) | NotUnderstood {
  const ends = text.match(/\r\n|\n|\r/g) ?? [];
  const lines = text.split(/\r\n|\n|\r/);
  const skipped: LeftOut[] = [];
  const gone = new Set<number>();
  const blank = shapes.blank ?? (() => "");
  /** Where the end of a block is not understood, all of the block goes: nobody knows how often it runs. */
  const skipBlock = (fault: TextFault): Skipped => {
    const at = fault.line - 1;
    const from = firstOf(lines, at, shapes);
    const last = Math.max(at, lastOf(lines, from, shapes));
    const column = from === at ? fault.column : 1;
    const said = told({ ...fault, line: from + 1, column }, lines[from]!, lines.slice(from, last + 1), shapes);
    for (let i = from; i <= last; i++) {
      lines[i] = blank(lines[i]!);
      gone.add(i);
    }
    return said;
  };
  /** Takes a call out of a line that holds more than it. */
  const callGoes = (fault: TextFault): boolean => {
    const line = lines[fault.line - 1];
    const rest = line === undefined ? undefined : withoutCall(line, fault, shapes);
    if (line === undefined || rest === undefined) return false;
    skipped.push({ ...told(fault, line, [line], shapes), fault });
    lines[fault.line - 1] = rest;
    return true;
  };
  let faults: readonly TextFault[] = [];
  let first: readonly TextFault[] | undefined;
  for (let reading = 0; reading < MOST_READINGS; reading++) {
    const shorter = lines.map((line, i) => line + (ends[i] ?? "")).join("");
    const understood = read(shorter);
    // Where nothing stays there was no program.
    if (first !== undefined && lines.every(line => line.trim() === ""))
      return { kind: "not-understood", faults: first };
    if (!isNotUnderstood(understood)) {
      const answer = confirm === undefined ? understood : confirm(shorter);
      return isNotUnderstood(answer) ? answer : { ...answer, skipped: skipped.toSorted((a, b) => a.line - b.line) };
    }
    ({ faults } = understood);
    first ??= faults;
    if (only !== undefined && !faults.every(only)) return { kind: "not-understood", faults };
    let isShorter = false;
    for (const fault of faults) {
      const at = fault.line - 1;
      const line = lines[at];
      if (only !== undefined && callGoes(fault)) {
        isShorter = true;
        continue;
      }
      if (line === undefined || gone.has(at) || !mayGo(line, shapes, only !== undefined)) continue;
      skipped.push({ ...skipBlock(fault), fault });
      isShorter = true;
      // A block that was not understood throws the ends of all that follows out of step: they are looked at again.
      if (isOfBlock(line, shapes)) break;
    }
    if (!isShorter) break;
  }
  return { kind: "not-understood", faults };
}

/** The line with nothing in place of a call, where it holds more than that: all else in it stays. */
function withoutCall(line: string, fault: TextFault, { callInLine }: LineShapes): string | undefined {
  if (callInLine === undefined) return undefined;
  const name = missingName(fault).replace(/[.*+?^${}()|[\]\\]/g, "\\$&");
  const rest = line.replace(callInLine.call(name), callInLine.instead);
  return rest === line || rest.trim() === callInLine.instead ? undefined : rest;
}

/** Opens a block, goes on to another part of it, or closes it. */
const isOfBlock = (line: string, { opens, parts, closes }: LineShapes): boolean =>
  [opens, parts, closes].some(shape => shape.test(line));

/** A call that decides more than itself is not left out where only calls are. */
const mayGo = (line: string, shapes: LineShapes, callsOnly: boolean): boolean =>
  line.trim() !== "" && !shapes.keeps.test(line) && !(callsOnly && isOfBlock(line, shapes));

const isNotUnderstood = (answer: { readonly kind: string }): answer is NotUnderstood =>
  answer.kind === "not-understood";

/** The line that opened what a line closes, or the line itself. */
function firstOf(lines: readonly string[], at: number, { opens, closes, keeps }: LineShapes): number {
  if (!closes.test(lines[at]!) || opens.test(lines[at]!)) return at;
  for (let i = at - 1, depth = 1; i >= 0; i--) {
    if (keeps.test(lines[i]!)) return at;
    if (closes.test(lines[i]!)) depth++;
    if (opens.test(lines[i]!) && --depth === 0) return i;
  }
  return at;
}

/** The last line that goes with a line: the end of a block, or where its next part begins. */
function lastOf(lines: readonly string[], at: number, { opens, parts, closes, keeps }: LineShapes): number {
  const isOpening = opens.test(lines[at]!);
  const isPart = parts.test(lines[at]!);
  if (!isOpening && !isPart) return at;
  for (let i = at + 1, depth = 1; i < lines.length; i++) {
    const line = lines[i]!;
    if (keeps.test(line)) return at;
    if (isPart && depth === 1 && (parts.test(line) || closes.test(line))) return i - 1;
    if (opens.test(line)) depth++;
    if (closes.test(line) && --depth === 0) return i;
  }
  return at;
}

function told(fault: TextFault, text: string, block: readonly string[], { motion, opens, parts }: LineShapes): Skipped {
  const { line } = fault;
  const lastLine = line + block.length - 1;
  const moves = block.filter(each => motion.test(each)).length;
  if (opens.test(text) || parts.test(text)) {
    const which =
      block.length > 1
        ? `Lines ${line} to ${lastLine} are left out with all that they do`
        : `The branch in line ${line} is left out`;
    return {
      ...fault,
      what: "branch",
      text,
      lastLine,
      sentence: `${which}${moves === 0 ? "" : `, ${moves === 1 ? "a motion" : `${moves} motions`} among it`}. ${fault.sentence}`,
    };
  }
  if (moves > 0)
    return {
      ...fault,
      what: "motion",
      text,
      lastLine,
      sentence: `The motion in line ${line} is left out: the robot goes on to the next point from where it is. ${fault.sentence}`,
    };
  return { ...fault, what: "statement", text, lastLine, sentence: `Line ${line} is left out. ${fault.sentence}` };
}
