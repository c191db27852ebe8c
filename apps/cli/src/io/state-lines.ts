import type { JointSample, OperatingMode, Robot, SafetyState } from "@twincell/core";
import type { NoteKind, Notes } from "@twincell/recording";
import { UseFault } from "./usage.ts";
import { jointsAt } from "./values.ts";

/** One line of a state stream: a sample as `simulate` and `replay` write it, or something that happened. */
export type StateLine =
  | { readonly kind: "sample"; readonly sample: JointSample }
  | {
      readonly kind: "event";
      readonly code: string;
      readonly level: "info" | "warning" | "error";
      readonly sentence: string;
    }
  | { readonly kind: "note"; readonly note: NoteKind; readonly what: Notes[NoteKind] };

const MODES: readonly OperatingMode[] = ["manual", "automatic", "remote"];
const SAFETY: readonly SafetyState[] = ["normal", "guard-stop", "protective-stop", "emergency-stop"];
const isRecord = (value: unknown): value is Record<string, unknown> =>
  typeof value === "object" && value !== null && !Array.isArray(value);
const textOf = (value: unknown): string => (typeof value === "string" ? value : "");
const listOf = (value: unknown): number[] =>
  Array.isArray(value) ? value.filter(each => typeof each === "number" && Number.isFinite(each)) : [];

/**
 * Reads state lines one after the other; times may not fall back. What a line does not say is as in the line before.
 */
export function stateLines(robot: Robot): (value: unknown, line: number) => StateLine {
  let sequence = 0;
  let last: JointSample | null = null;
  return (value, line) => {
    if (!isRecord(value)) throw new UseFault(`Line ${line} wants an object such as {"t":0.01,"q":[…]}.`);
    if (isRecord(value["event"])) {
      const { code, level, sentence } = value["event"];
      return {
        kind: "event",
        code: textOf(code) || "info",
        level: level === "error" || level === "warning" ? level : "info",
        sentence: textOf(sentence),
      };
    }
    if (isRecord(value["load"])) {
      const { torque_Nm, current_A, temperature_C } = value["load"];
      return {
        kind: "note",
        note: "load",
        what: { torque_Nm: listOf(torque_Nm), current_A: listOf(current_A), temperature_C: listOf(temperature_C) },
      };
    }
    const { t } = value;
    if (typeof t !== "number" || !Number.isFinite(t))
      throw new UseFault(`Line ${line} wants "t", the time in seconds.`);
    if (last && t < last.time_s)
      throw new UseFault(`Line ${line}: the time goes back from ${last.time_s} s to ${t} s.`);
    const q_rad = Float64Array.from(jointsAt(value, `Line ${line}`, robot.arm.joints.length, robot.name));
    const before = last;
    const moving =
      typeof value["moving"] === "boolean"
        ? value["moving"]
        : before !== null && q_rad.some((q, i) => q !== before.q_rad[i]);
    const io = isRecord(value["io"]) ? value["io"] : null;
    const sample: JointSample = {
      sequence: sequence++,
      time_s: t,
      q_rad,
      moving,
      mode: MODES.find(mode => mode === value["mode"]) ?? before?.mode ?? "automatic",
      safety: SAFETY.find(safety => safety === value["safety"]) ?? before?.safety ?? "normal",
      override:
        typeof value["override"] === "number" ? Math.min(1, Math.max(0, value["override"])) : (before?.override ?? 1),
      gripperClosed: io ? io["gripper"] === true : (before?.gripperClosed ?? false),
      step: typeof value["step"] === "string" ? value["step"] : (before?.step ?? ""),
      message: typeof value["message"] === "string" ? value["message"] : (before?.message ?? ""),
      signals: io
        ? new Map(
            Object.entries(io).filter(
              (entry): entry is [string, boolean | number] =>
                entry[0] !== "gripper" && (typeof entry[1] === "boolean" || typeof entry[1] === "number"),
            ),
          )
        : (before?.signals ?? new Map()),
    };
    last = sample;
    return { kind: "sample", sample };
  };
}
