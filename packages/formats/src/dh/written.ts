import type { DhConvention, Pose } from "@twincell/core";
import { Refusal } from "../refusal.ts";
import { shorten } from "../xml.ts";

/** What a file of a D-H table holds, numbers still in its own units. */
export interface WrittenTable {
  readonly name: string | undefined;
  readonly convention: DhConvention;
  readonly length: "m" | "mm";
  readonly angle: "rad" | "deg";
  readonly rows: readonly WrittenRow[];
  /** In metres. */
  readonly base: Pose | undefined;
  readonly flange: Pose | undefined;
}
export interface WrittenRow {
  readonly name: string | undefined;
  readonly line: number | undefined;
  readonly numbers: Readonly<Partial<Record<DhColumn, number>>>;
}
export const DH_COLUMNS = [
  "a",
  "alpha",
  "d",
  "theta",
  "sense",
  "sigma",
  "lower",
  "upper",
  "speed",
  "acceleration",
] as const;
export type DhColumn = (typeof DH_COLUMNS)[number];

export function conventionOf(written: string | undefined): DhConvention {
  const plain = written?.toLowerCase();
  if (plain === "standard" || plain === "modified") return plain;
  throw new Refusal(
    plain === undefined
      ? "The table does not say its convention: standard or modified."
      : `The convention “${shorten(plain)}” is not known: standard or modified.`,
  );
}

export function unitsOf(
  length: string | undefined,
  angle: string | undefined,
): { readonly length: "m" | "mm"; readonly angle: "rad" | "deg" } {
  if ((length === "m" || length === "mm") && (angle === "rad" || angle === "deg")) return { length, angle };
  throw new Refusal("The table does not say its units: lengths in m or mm, angles in rad or deg.");
}
