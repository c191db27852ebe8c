import type { ObjectRecord, ToolRecord } from "../document.ts";
import type { PartPiece } from "./piece.ts";

export interface PartParameter {
  readonly id: "length" | "width" | "height" | "pitch" | "speed" | "count";
  readonly quantity: "length" | "speed" | "plain";
  readonly value: number;
  readonly min: number;
  readonly max: number;
}
/** Every parameter with its number: metres, metres a second, or a count. */
export type PartNumbers = Readonly<Record<string, number>>;

/** A kind of part of the library: a file of its own each. */
export interface PartKind {
  readonly id: string;
  readonly category: "tables" | "conveyors" | "safety" | "load" | "stands" | "tools";
  readonly role: ObjectRecord["role"];
  readonly parameters: readonly PartParameter[];
  /** Shown in the list and where only one colour can be. */
  readonly color: string;
  /** Coulomb's coefficient of its surface. */
  readonly friction: number;
  readonly mass_kg: (numbers: PartNumbers) => number;
  readonly pieces: (numbers: PartNumbers) => readonly PartPiece[];
  /** What it carries where a robot stands on it. */
  readonly carries_kg?: number;
  /** It is a tool: its frame is that of the flange, and this is what follows from its numbers. */
  readonly tool?: (numbers: PartNumbers) => Pick<ToolRecord, "flangeFromTcp" | "gripper">;
  /** It moves what lies on it along its x axis, at its `speed`. */
  readonly conveys?: true;
}

export const length = (
  id: "length" | "width" | "height" | "pitch",
  value: number,
  min: number,
  max: number,
): PartParameter => ({
  id,
  quantity: "length",
  value,
  min,
  max,
});
