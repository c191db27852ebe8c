/*
 * Point files (.pts) of RC+, as the controller writes them: blocks of `name=value`. What a program calls P1, or by the
 * label of the point, stands there.
 */
import type { TextPlace } from "@twincell/core";

/** A taught point: X, Y, Z [mm], U, V, W [°], the local it counts in, and what it asks for of the posture. */
export interface TaughtPoint extends TextPlace {
  readonly number: number;
  readonly label: string;
  readonly values: readonly [number, number, number, number, number, number];
  readonly local: number;
  /** `R` or `L`, `A` or `B`, `NF` or `F`; none for an arm of four joints. */
  readonly posture: readonly string[];
}

const HEAD = /^\s*(?:ENVT\d+\s*,|sVersion\s*=|n(?:DisplayMode|NumberOfJoints|NumberOfPoints)\s*=|bDisplay[RST]\s*=)/;
const BLOCK = /^\s*Point\d+\s*\{/;

/** The points of a text, and the text with their lines left empty. */
export function takePoints(text: string): { readonly code: string; readonly points: readonly TaughtPoint[] } {
  if (!/^\s*Point\d+\s*\{/m.test(text)) return { code: text, points: [] };
  const ends = text.match(/\r\n|\n|\r/g) ?? [];
  const lines = text.split(/\r\n|\n|\r/);
  const points: TaughtPoint[] = [];
  let joints = 6;
  let fields: Map<string, string> | undefined;
  let from = 1;
  for (const [i, line] of lines.entries()) {
    if (fields === undefined && BLOCK.test(line)) {
      fields = new Map();
      from = i + 1;
    } else if (fields === undefined && HEAD.test(line)) {
      joints = Number(/nNumberOfJoints\s*=\s*(\d+)/.exec(line)?.[1] ?? joints);
    } else if (fields === undefined) continue;
    else if (line.trim() === "}") {
      const point = pointOf(fields, joints, { line: from, column: 1 });
      if (point !== undefined) points.push(point);
      fields = undefined;
    } else {
      const found = /^\s*(\w+)\s*=\s*(.*?)\s*$/.exec(line);
      if (found !== null) fields.set(found[1]!, found[2]!);
    }
    lines[i] = "";
  }
  return { code: lines.map((line, i) => line + (ends[i] ?? "")).join(""), points };
}

function pointOf(fields: ReadonlyMap<string, string>, joints: number, at: TextPlace): TaughtPoint | undefined {
  const number = (name: string): number => Number(fields.get(name) ?? 0);
  const values = ["rX", "rY", "rZ", "rU", "rV", "rW"].map(number) as unknown as TaughtPoint["values"];
  if (number("nUndefined") !== 0 || !values.every(Number.isFinite) || !Number.isInteger(number("nNumber")))
    return undefined;
  const posture =
    joints < 6
      ? []
      : [number("nHand") === 2 ? "l" : "r", number("nElbow") === 2 ? "b" : "a", number("nWrist") === 2 ? "f" : "nf"];
  const label = (fields.get("sLabel") ?? "").replace(/^"|"$/g, "").trim();
  return { ...at, number: number("nNumber"), label, values, local: number("nLocal"), posture };
}
