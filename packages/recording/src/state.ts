import type { JointSample } from "@twincell/core";

/** What changes seldom: written when it changes and at the head of every chunk. */
export type RobotState = Pick<
  JointSample,
  "moving" | "mode" | "safety" | "override" | "gripperClosed" | "step" | "message"
>;

export const STATE_SCHEMA = {
  name: "twincell.RobotState",
  encoding: "jsonschema",
  text: JSON.stringify({
    title: "twincell.RobotState",
    type: "object",
    properties: {
      moving: { type: "boolean" },
      mode: { type: "string", enum: ["manual", "automatic", "remote"] },
      safety: { type: "string", enum: ["normal", "guard-stop", "protective-stop", "emergency-stop"] },
      override: { type: "number", minimum: 0, maximum: 1 },
      gripperClosed: { type: "boolean" },
      step: { type: "string" },
      message: { type: "string" },
    },
  }),
} as const;

export type EventLevel = "info" | "warning" | "error";
/** Something that happened during the run, in words. */
export interface RunEvent {
  readonly at_s: number;
  readonly kind: string;
  readonly level: EventLevel;
  readonly sentence: string;
}

/** `foxglove.Log`: the log panel of Foxglove shows it. */
export const EVENT_SCHEMA = {
  name: "foxglove.Log",
  encoding: "jsonschema",
  text: JSON.stringify({
    title: "foxglove.Log",
    type: "object",
    properties: {
      timestamp: {
        type: "object",
        title: "time",
        properties: {
          sec: { type: "integer", minimum: 0 },
          nsec: { type: "integer", minimum: 0, maximum: 999_999_999 },
        },
      },
      level: { type: "integer" },
      message: { type: "string" },
      name: { type: "string" },
      file: { type: "string" },
      line: { type: "integer", minimum: 0 },
    },
  }),
} as const;
export const LEVELS: Readonly<Record<EventLevel, number>> = { info: 2, warning: 3, error: 4 };

export const sameState = (a: RobotState, b: RobotState): boolean =>
  a.moving === b.moving &&
  a.mode === b.mode &&
  a.safety === b.safety &&
  a.override === b.override &&
  a.gripperClosed === b.gripperClosed &&
  a.step === b.step &&
  a.message === b.message;

export const copyState = (from: RobotState): RobotState => ({
  moving: from.moving,
  mode: from.mode,
  safety: from.safety,
  override: from.override,
  gripperClosed: from.gripperClosed,
  step: from.step,
  message: from.message,
});

const oneOf = <T extends string>(value: unknown, all: readonly T[], otherwise: T): T =>
  all.find(known => known === value) ?? otherwise;
const text = (value: unknown): string => (typeof value === "string" ? value : "");

/** A state from a file; what is missing or strange reads as its quiet default. */
export function stateFrom(json: unknown): RobotState {
  const of: Record<string, unknown> = typeof json === "object" && json !== null ? { ...json } : {};
  return {
    moving: of["moving"] === true,
    mode: oneOf(of["mode"], ["manual", "automatic", "remote"], "automatic"),
    safety: oneOf(of["safety"], ["normal", "guard-stop", "protective-stop", "emergency-stop"], "normal"),
    override: typeof of["override"] === "number" ? Math.min(1, Math.max(0, of["override"])) : 1,
    gripperClosed: of["gripperClosed"] === true,
    step: text(of["step"]),
    message: text(of["message"]),
  };
}

/** An event from a file. */
export function eventFrom(json: unknown, at_s: number): RunEvent {
  const of: Record<string, unknown> = typeof json === "object" && json !== null ? { ...json } : {};
  const level = of["level"];
  return {
    at_s,
    kind: text(of["name"]),
    sentence: text(of["message"]),
    level: typeof level === "number" && level >= 4 ? "error" : level === 3 ? "warning" : "info",
  };
}
