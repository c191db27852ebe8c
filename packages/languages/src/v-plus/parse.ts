import { type Pose, type Robot, type Step } from "@twincell/core";
import { headingOr, plainText, textFault, textLines, type Comment, programOfExecution } from "../parser/index.ts";
import type { ReadSteps } from "../reading/checked-import.ts";
import { openVPlus } from "./interpret.ts";
import { structuredProgram } from "./read/structure.ts";

/** Share of the full speed at which the points of a point list are passed; the list says nothing about it. */
const POINT_LIST_RATIO = 0.2;

const POINT = /^\s*(?:DO\s+)?DECOMPOSE\s+([A-Z][A-Z0-9_.]*)\s*\[\s*([0-9]+)\s*\]\s*=\s*#PPOINT\s*\(/i;

/**
 * The neutral program that a V+ text amounts to. Loops, calls, decisions and pallets that a neutral program has too are
 * kept. Any other text is executed and its motions written down, so its loops and arrays come out as what they do. A
 * point list moves nothing: each of its points becomes a joint move.
 */
export function parseVPlus(text: string, robot: Robot, worldFromBase: Pose<"world", "base">): ReadSteps {
  const lines = textLines(text).map(plainText);
  const isList = isPointList(text);
  const structured = isList ? undefined : structuredProgram(text, lines, robot, worldFromBase, nameOf(lines));
  if (structured?.kind === "program") return { kind: "parsed", program: structured.program, warnings: [] };
  if (structured?.kind === "not-understood") return structured;
  const source = isList ? lines.map(asMove).join("\n") : text;
  const opened = openVPlus(source, robot, worldFromBase);
  if (opened.kind === "not-understood") return opened;
  const { start, declared, ready } = opened;
  return programOfExecution(text, robot, {
    start: signals => ({ steps: start(signals) }),
    declared,
    executable: () => ready,
    words: { program: "program", statement: "a statement" },
    title: nameOf,
    comment,
    warnings: () => (isList ? [MOVES_NOTHING] : []),
    meant: done => (isList ? { ...done, steps: done.steps.map(atPointListSpeed) } : done),
  });
}

const MOVES_NOTHING = textFault(
  { line: 1, column: 1 },
  "a program with MOVE",
  "A point list fills an array and moves nothing: each of its points became a joint move.",
);

const atPointListSpeed = (step: Step): Step =>
  step.type === "move" ? { ...step, speed: { ratio: POINT_LIST_RATIO } } : step;

/**
 * The line of a point list as the move to its point, every character of the point in its column. Other lines stay as
 * they are.
 */
const asMove = (line: string): string =>
  POINT.test(line) ? "MOVE".padEnd(line.indexOf("#")) + line.slice(line.indexOf("#")) : line;

/** What a person called the program: the comment behind its name, or its name. */
function nameOf(lines: readonly string[]): string {
  const header = lines.find(line => /^\s*\.PROGRAM\b/i.test(line));
  if (header === undefined) return "Point list";
  const comment = /;(.*)/.exec(header)?.[1]?.trim() ?? "";
  return comment !== "" ? comment : (/\.PROGRAM\s+([^\s(;]+)/i.exec(header)?.[1] ?? "Program");
}

/** `;name` before a step, `;== name` before a group of steps; `;*` is neither. */
function comment(line: string): Comment | undefined {
  const said = headingOr(/^\s*;(.*)/.exec(line)?.[1]);
  return said?.kind === "remark" ? undefined : said;
}

/** Whether a text fills arrays with points and is no program: it moves nothing. */
export function isPointList(text: string): boolean {
  const lines = textLines(text).map(plainText);
  return lines.some(line => POINT.test(line)) && !lines.some(line => /^\s*\.PROGRAM\b/i.test(line));
}
