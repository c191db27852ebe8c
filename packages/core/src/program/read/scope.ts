import type { Pose } from "../../spatial/pose.ts";
import type { ExpressionScope } from "../expression/typing.ts";
import type { ValueType } from "../expression/expression.ts";
import type { Pallet } from "../pallet.ts";
import type { SignalLine } from "../program.ts";

/** What a step may refer to. */
export interface ProgramScope {
  readonly robot: string;
  readonly joints: number | undefined;
  readonly tools: Readonly<Record<string, Pose<"flange", "tcp">>>;
  readonly frames: Readonly<Record<string, Pose<"world", "frame">>>;
  readonly pallets: Readonly<Record<string, Pallet>>;
  /** Names of all routines, read or not. */
  readonly routines: ReadonlySet<string>;
  readonly signals: Readonly<Record<string, SignalLine>>;
  readonly variables: Readonly<Record<string, ValueType>>;
  /** Values that routines are given, by the routine. */
  readonly parameters: Readonly<Record<string, Readonly<Record<string, ValueType>>>>;
  /** The routine these steps are of, if any. */
  readonly routine: string | undefined;
  /** Ids met so far, with the number of the step. */
  readonly seen: Map<string, number>;
  /** Pallets whose steps these are. */
  readonly open: readonly string[];
  /** Blocks around these steps. */
  readonly depth: number;
}

/** What names mean in an expression of these steps. */
export function scopeOf({
  variables,
  parameters,
  routine,
  signals,
}: Pick<ProgramScope, "variables" | "parameters" | "routine" | "signals">): ExpressionScope {
  const own = routine !== undefined && Object.hasOwn(parameters, routine) ? parameters[routine]! : {};
  return {
    variable: name =>
      Object.hasOwn(own, name) ? own[name] : Object.hasOwn(variables, name) ? variables[name] : undefined,
    signal: name =>
      !Object.hasOwn(signals, name) ? "unknown" : signals[name]!.kind.startsWith("digital") ? "digital" : "analogue",
  };
}
