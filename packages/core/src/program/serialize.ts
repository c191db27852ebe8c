import type { Program, Step } from "./program.ts";
import { versionOf } from "./version.ts";

/** Tables that programs had before others: always written. The others are left out when they are empty. */
const ALWAYS: ReadonlySet<string> = new Set(["tools", "frames", "groups"]);

/** The program as JSON text, one step a line, so that a version control shows which steps changed. */
export function serializeProgram(program: Program): string {
  const { steps, routines, ...others } = program;
  const rest = { ...others, version: versionOf(program) };
  const kept = Object.entries(rest).filter(
    ([key, value]) => ALWAYS.has(key) || typeof value !== "object" || Object.keys(value).length > 0,
  );
  const head = JSON.stringify(Object.fromEntries(kept), undefined, 1).replace(/\n\}$/, "");
  const named = Object.entries(routines).map(([name, list]) => `  ${JSON.stringify(name)}: ${written(list, "  ")}`);
  const called = named.length === 0 ? "" : `,\n "routines": {\n${named.join(",\n")}\n }`;
  return `${head}${called},\n "steps": ${written(steps, " ")}\n}\n`;
}

function written(steps: readonly Step[], indent: string): string {
  if (steps.length === 0) return "[]";
  const deeper = `${indent} `;
  return `[\n${steps.map(step => deeper + line(step, deeper)).join(",\n")}\n${indent}]`;
}

/** A block opens on its own line, with its steps below it. */
function line(step: Step, indent: string): string {
  switch (step.type) {
    case "wait-for": {
      const { late, ...rest } = step;
      return late === undefined ? JSON.stringify(step) : `${opened(rest)}, "late": ${written(late, indent)}}`;
    }
    case "repeat":
    case "while":
    case "pallet": {
      const { steps, ...rest } = step;
      return `${opened(rest)}, "steps": ${written(steps, indent)}}`;
    }
    case "if": {
      const { then, else: otherwise, ...rest } = step;
      return `${opened(rest)}, "then": ${written(then, indent)}${otherwise === undefined ? "" : `, "else": ${written(otherwise, indent)}`}}`;
    }
    default:
      return JSON.stringify(step);
  }
}

const opened = (fields: object): string => JSON.stringify(fields).slice(0, -1);
