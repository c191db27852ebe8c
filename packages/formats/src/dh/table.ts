import {
  armFromDh,
  dhFromArm,
  degrees,
  radians,
  pose,
  type DhConvention,
  type DhRow,
  type DhTable,
  type Joint,
  type Pose,
  type SerialArm,
} from "@twincell/core";
import { limitsWith } from "../limits.ts";
import { answering, Refusal, type NotUnderstood } from "../refusal.ts";
import { rowsFromJson } from "./json.ts";
import { rowsFromText } from "./rows.ts";
import type { WrittenRow, WrittenTable } from "./written.ts";

export interface DhRead {
  readonly kind: "read";
  readonly arm: SerialArm;
  readonly table: DhTable;
  /** What had to be assumed, one sentence each. */
  readonly assumptions: readonly string[];
}

/** Neither arms nor their wrists are larger: a length above it is in other units. */
const LARGEST_M = 100;

/**
 * Reads a Denavit–Hartenberg table. Convention and units are stated in the file, nothing is guessed.
 *
 * JSON:
 * `{"convention":"modified","units":{"length":"mm","angle":"deg"},
 *   "rows":[{"a":0,"alpha":0,"d":420,"theta":0,"lower":-160,…}]}`
 * Text: `# convention: modified`, `# units: mm deg`, a line of column names, a line per joint; commas, semicolons, tabs
 * or spaces between.
 *
 * Columns: a, alpha, d; theta (offset, 0), sense (1 or −1, 1), sigma (0 turns, 1 slides; 0), lower, upper, speed,
 * acceleration, name. Limits of a row that slides are in the unit of lengths. A modified row holds
 * Craig's a and α of the link before.
 */
export function readDhTable(text: string, name = "arm"): DhRead | NotUnderstood {
  return answering(() => {
    if (text.length > 1_000_000)
      throw new Refusal(`The file has ${text.length} characters; a D-H table has at most 1000000.`);
    const written = /^\s*\{/.test(text) ? rowsFromJson(text) : rowsFromText(text);
    const assumptions: string[] = [];
    if (written.rows.length === 0) throw new Refusal("The table has no rows.");
    if (written.rows.length > 100)
      throw new Refusal(`The table has ${written.rows.length} rows; at most 100 are read.`);
    const names = written.rows.map((row, i) => row.name ?? `joint_${i + 1}`);
    const twice = names.find((each, i) => names.indexOf(each) !== i);
    if (twice !== undefined) throw new Refusal(`Two rows are called ${twice}.`);
    const table: DhTable = {
      convention: written.convention,
      rows: written.rows.map((row, i) => rowOf(row, names[i]!, written)),
      baseFromFirst: (written.base ?? pose()) as Pose<"base", "first">,
      lastFromFlange: (written.flange ?? pose()) as Pose<"last", "flange">,
    };
    const joints = written.rows.map((row, i) => ({
      name: names[i]!,
      limits: limitsOf(row, names[i]!, written, assumptions),
    }));
    return { kind: "read", table, assumptions, arm: armFromDh(written.name ?? name, table, joints) };
  });
}

const inRadians = (value: number, { angle }: WrittenTable): number => (angle === "deg" ? radians(value) : value);

function rowOf({ numbers, line }: WrittenRow, name: string, table: WrittenTable): DhRow {
  for (const column of ["a", "alpha", "d"] as const)
    if (numbers[column] === undefined) throw new Refusal(`The row of ${name} has no ${column}.`, line);
  const metres = (column: "a" | "d"): number => {
    const value = (numbers[column] ?? 0) * (table.length === "mm" ? 0.001 : 1);
    if (Math.abs(value) > LARGEST_M)
      throw new Refusal(`The ${column} of ${name} would be ${value} m; the table is read in ${table.length}.`, line);
    return value;
  };
  const sense = numbers.sense ?? 1;
  if (sense !== 1 && sense !== -1) throw new Refusal(`The sense of ${name} is ${sense}; it is 1 or -1.`, line);
  const sigma = numbers.sigma ?? 0;
  if (sigma !== 0 && sigma !== 1)
    throw new Refusal(
      `The sigma of ${name} is ${sigma}; it is 0 for a joint that turns or 1 for one that slides.`,
      line,
    );
  return {
    ...(sigma === 1 ? { slides: true as const } : {}),
    a_m: metres("a"),
    alpha_rad: inRadians(numbers.alpha ?? 0, table),
    d_m: metres("d"),
    thetaOffset_rad: inRadians(numbers.theta ?? 0, table),
    sense,
  };
}

function limitsOf(
  { numbers, line }: WrittenRow,
  name: string,
  table: WrittenTable,
  assumptions: string[],
): Joint["limits"] {
  const { lower, upper, speed, acceleration } = numbers;
  const slides = numbers.sigma === 1;
  const inside = (value: number | undefined): number | undefined =>
    value === undefined ? undefined : slides ? value * (table.length === "mm" ? 0.001 : 1) : inRadians(value, table);
  if (lower !== undefined && upper !== undefined && lower > upper)
    throw new Refusal(`The lower limit of ${name}, ${lower}, is above its upper limit, ${upper}.`, line);
  for (const [what, value] of [
    ["speed", speed],
    ["acceleration", acceleration],
  ] as const)
    if (value !== undefined && value < 0) throw new Refusal(`The ${what} of ${name} is ${value}, below 0.`, line);
  return limitsWith(
    name,
    {
      lower_rad: inside(lower),
      upper_rad: inside(upper),
      speed_rad_s: inside(speed),
      acceleration_rad_s2: acceleration === 0 ? undefined : inside(acceleration),
    },
    assumptions,
    slides ? "prismatic" : undefined,
  );
}

/** The D-H table of an arm as a JSON file, in metres and radians with every digit. */
export function writeDhTable(arm: SerialArm, convention: DhConvention): string {
  const table = dhFromArm(arm, convention);
  const lines = table.rows.map((row, i) => {
    const { name, limits } = arm.joints[i]!;
    const numbers = {
      a: row.a_m,
      alpha: row.alpha_rad,
      d: row.d_m,
      theta: row.thetaOffset_rad,
      ...(row.slides === true ? { sigma: 1 } : {}),
      lower: limits.lower_rad,
      upper: limits.upper_rad,
      speed: limits.speed_rad_s,
      acceleration: limits.acceleration_rad_s2,
    };
    return `    ${JSON.stringify({ name, ...numbers })}`;
  });
  return `{\n  "name": ${JSON.stringify(arm.name)},\n  "convention": "${convention}",\n  "units": {"length": "m", "angle": "rad"},\n  "rows": [\n${lines.join(",\n")}\n  ],\n  "base": ${JSON.stringify(table.baseFromFirst)},\n  "flange": ${JSON.stringify(table.lastFromFlange)}\n}\n`;
}

/** The table as a person reads it: millimetres and degrees, four decimals. */
export function dhTableText(table: DhTable, names: readonly string[]): string {
  const cells = table.rows.map((row, i) => [
    names[i] ?? "",
    ...[row.a_m * 1000, degrees(row.alpha_rad), row.d_m * 1000, degrees(row.thetaOffset_rad)].map(numberText),
  ]);
  const all = [["name", "a", "alpha", "d", "theta"], ...cells];
  const widths = all[0]!.map((_, k) => Math.max(...all.map(line => line[k]!.length)));
  return `# convention: ${table.convention}\n# units: mm deg\n${all.map(line => line.map((cell, k) => (k === 0 ? cell.padEnd(widths[k]!) : cell.padStart(widths[k]!))).join("  ")).join("\n")}\n`;
}

/** Four decimals at most, no −0. */
const numberText = (value: number): string => String(Math.round(value * 1e4) / 1e4 || 0);
