import type { MoveStep, Predicate, Program, Step } from "./program.ts";
import { everyStep } from "./walk.ts";

/** Everything a program can ask of a robot language, so that what one cannot say has the same name everywhere. */
export const CAPABILITIES = [
  "ptp",
  "lin",
  "circ",
  "spline",
  "duration",
  "acceleration",
  "blend",
  "search",
  "tool",
  "frame",
  "payload",
  "gripper",
  "wait",
  "wait-for",
  "timeout",
  "set-digital",
  "set-analogue",
  "pulse",
  "read-analogue",
  "repeat",
  "if",
  "call",
  "pallet",
  "message",
  "stop",
  "comment",
  "assign",
  "while",
  "expression",
  "truth-values",
  "wait-expression",
  "late",
  "arguments",
] as const;
export type Capability = (typeof CAPABILITIES)[number];

/** What a step asks for by itself, without the steps inside it. */
export function* capabilitiesOf(step: Step): Generator<Capability, void> {
  switch (step.type) {
    case "move":
      return yield* capabilitiesOfMove(step);
    case "set":
      yield typeof step.to === "number" ? "set-analogue" : "set-digital";
      if (step.pulse_s !== undefined) yield "pulse";
      return;
    case "wait-for":
      yield "wait-for";
      if (step.timeout_s !== undefined) yield "timeout";
      if (step.late !== undefined) yield "late";
      if ("expression" in step.when) {
        yield "wait-expression";
        return;
      }
      return yield* read(step.when);
    case "if":
    case "while":
      yield step.type;
      return yield* read(step.when);
    case "assign":
      yield "assign";
      return;
    case "call":
      yield "call";
      if (step.arguments !== undefined) yield "arguments";
      return;
    default:
      yield step.type;
  }
}

function* capabilitiesOfMove(step: MoveStep): Generator<Capability, void> {
  yield step.path;
  if ("time_s" in step.speed) yield "duration";
  if (step.acceleration !== undefined) yield "acceleration";
  if (step.blend_m > 0 || (step.blend_ratio ?? 0) > 0) yield "blend";
  if (step.until !== undefined) {
    yield "search";
    yield* read(step.until.when);
  }
  for (const target of step.via === undefined ? [step.target] : [step.via, step.target]) {
    if (target.tool !== undefined && target.tool !== "flange") yield "tool";
    if ("pose" in target && target.frame !== "world") yield "frame";
  }
}

function* read(when: Predicate): Generator<Capability, void> {
  if ("expression" in when) yield "expression";
  else if (!("is" in when)) yield "read-analogue";
}

/** What a program asks for, each with the first step that does. */
export function capabilitiesUsed(program: Pick<Program, "steps" | "routines">): ReadonlyMap<Capability, Step> {
  const used = new Map<Capability, Step>();
  for (const step of everyStep(program))
    for (const capability of capabilitiesOf(step)) if (!used.has(capability)) used.set(capability, step);
  return used;
}
