import type { Routine, Variable } from "../read/syntax.ts";
import { real, whole, type Structure, type Value } from "./values.ts";

/** A routine that is being executed, with its place, its loops and its own variables. */
export interface Frame {
  readonly routine: Routine;
  at: number;
  readonly last: number[];
  readonly step: number[];
  readonly chosen: (Value | undefined)[];
  readonly own: ReadonlySet<string>;
  readonly values: Map<string, Value>;
  readonly types: ReadonlyMap<string, string>;
  /** Where the values of parameters go that are handed back. */
  readonly back: readonly { readonly from: string; readonly to: Variable; readonly frame: Frame | undefined }[];
  /** Parameters that stand for a line of the controller: with the key of the line. */
  readonly lines: ReadonlyMap<string, string>;
  result: Value | undefined;
}

/** Axis values as a structure. */
export const axesOf = (axes_deg: readonly number[]): Structure => ({
  kind: "structure",
  type: "E6AXIS",
  fields: new Map(axes_deg.map((value, i) => [`A${i + 1}`, real(value)])),
});

/** A structure with one member changed, which may lie inside others. */
export function within(structure: Structure, [name, ...rest]: readonly string[], value: Value): Structure {
  if (name === undefined) return structure;
  const inner = structure.fields.get(name);
  const changed =
    rest.length === 0
      ? value
      : within(
          inner?.kind === "structure" ? inner : { kind: "structure", type: undefined, fields: new Map() },
          rest,
          value,
        );
  return { ...structure, fields: new Map(structure.fields).set(name, changed) };
}

/** A value as a variable of that type holds it. */
export function typed(value: Value, type: string | undefined): Value {
  if (value.kind === "number" && type === "INT" && !value.whole) return whole(Math.round(value.value));
  if (value.kind === "number" && type === "REAL" && value.whole) return real(value.value);
  return value.kind === "structure" && value.type === undefined && type !== undefined ? { ...value, type } : value;
}
