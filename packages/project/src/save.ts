import { versionOf } from "@twincell/core";
import type { CellDocument } from "./document.ts";

/**
 * Keys in this order come first; the others follow by alphabet. So a saved cell reads from top to bottom and two
 * versions differ only where they differ.
 */
const FIRST = [
  "format",
  "version",
  "id",
  "type",
  "name",
  "kind",
  "role",
  "group",
  "path",
  "training",
  "robot",
  "language",
  "main",
  "files",
  "encoding",
  "text",
  "worldFromBase",
  "errors",
  "flangeFromTcp",
  "worldFromObject",
  "worldFromFrame",
  "attachedTo",
  "position",
  "quaternion",
  "q",
  "pose",
  "frame",
  "tool",
  "target",
  "via",
  "speed",
  "blend_m",
  "tools",
  "objects",
  "frames",
  "allowedPairs",
  "pairs",
  "programs",
  "program",
];
/** A list of numbers or words up to this long stays on one line. */
const LINE = 140;

/**
 * The document as text: stable key order, two blanks of indentation, short lists on one line, a line end at the end. A
 * program says the lowest version that can say it.
 */
export function saveDocument(document: CellDocument): string {
  const programs = document.programs.map(program => {
    if (!("steps" in program)) return program;
    const version = versionOf(program);
    return version === program.version ? program : { ...program, version };
  });
  return `${written({ ...document, programs }, "")}\n`;
}

function written(value: unknown, indent: string): string {
  if (typeof value !== "object" || value === null) return JSON.stringify(value);
  const deeper = `${indent}  `;
  const entries = Array.isArray(value)
    ? value.map((item: unknown) => written(item, deeper))
    : Object.entries(value)
        .filter(([, item]) => item !== undefined)
        .sort(([a], [b]) => order(a, b))
        .map(([key, item]) => `${JSON.stringify(key)}: ${written(item, deeper)}`);
  const [open, close] = Array.isArray(value) ? ["[", "]"] : ["{", "}"];
  const line = Array.isArray(value)
    ? `${open}${entries.join(", ")}${close}`
    : entries.length === 0
      ? "{}"
      : `${open} ${entries.join(", ")} ${close}`;
  if (entries.length === 0 || (line.length <= LINE && !line.includes("\n"))) return line;
  return `${open}\n${entries.map(entry => deeper + entry).join(",\n")}\n${indent}${close}`;
}

function order(a: string, b: string): number {
  const ia = FIRST.indexOf(a);
  const ib = FIRST.indexOf(b);
  if (ia !== ib) return (ia < 0 ? FIRST.length : ia) - (ib < 0 ? FIRST.length : ib);
  return a < b ? -1 : a > b ? 1 : 0;
}
