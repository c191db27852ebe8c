import {
  Fault, SignalTable, angleBetween, compose, degrees, distance, everyStep, flangePose, flow, holds, identity, millimetres,
  type Condition, type Dialect, type EmittedFile, type Executed, type MoveStep, type Pose, type PrimitiveStep, type Program, type Robot, type Resolution, type Step, type Target, type TextFault,
} from "@twincell/core";
import { asciiText } from "./text/index.ts";

/** What a controller executes of the files of an export, as one text. */
export const runnableFile = (dialect: Dialect, files: readonly EmittedFile[]): EmittedFile | undefined => dialect.runnable?.(files) ?? files[0];

/** How far an executed text may be from the program it was made of. */
export const PROOF_TOLERANCE = { position_m: 1e-5, angle_rad: 1e-3 / 180 * Math.PI } as const;

/** A step of the program beside what the text did in its place. */
export interface ProvenStep {
  readonly id: string;
  /** Line of the file that did it. */
  readonly line: number;
  readonly deviation_m: number;
  readonly deviation_rad: number;
}
export type Proof =
  | { readonly kind: "proven"; readonly file: string; readonly steps: readonly ProvenStep[]; readonly worst_m: number; readonly worst_rad: number; readonly sentence: string }
  | { readonly kind: "differs"; readonly file: string; readonly step: string; readonly line: number; readonly sentence: string }
  | { readonly kind: "not-executed"; readonly file: string; readonly faults: readonly TextFault[]; readonly sentence: string };

/**
 * Executes an emitted text and compares it, step by step, with the program it was made of: sort of step, path, tool tip in
 * the world, joint angles where they were taught, speed, stop or no stop. This proves the text, not the emitter's intention.
 */
export function proveText(
  dialect: Dialect, file: { readonly name: string; readonly text: string }, program: Program, robot: Robot, worldFromBase: Pose<"world", "base"> = identity(),
): Proof {
  const interpreted = dialect.interpret(file.text, robot, worldFromBase);
  if (interpreted.kind === "not-understood") {
    const fault = interpreted.faults[0]!;
    return { kind: "not-executed", file: file.name, faults: interpreted.faults, sentence: `${file.name} stops in line ${fault.line}, column ${fault.column}: ${fault.sentence}` };
  }
  const { steps: wantedSteps, isWhole } = wantedOf(program), executed: (Executed & { readonly step: Step })[] = [];
  try {
    const run = interpreted.run(new SignalTable());
    // One step more than wanted is enough to see that there are too many; of a program without an end none is too many.
    for (let next = run.next(); next.done !== true && executed.length <= wantedSteps.length; next = run.next()) {
      if (next.value.step !== undefined) executed.push({ ...next.value, step: next.value.step });
    }
  } catch (cause) {
    if (!(cause instanceof Fault)) throw cause;
    return { kind: "not-executed", file: file.name, faults: [], sentence: `${file.name} stops: ${cause.message} ${cause.hint}` };
  }
  const steps: ProvenStep[] = [];
  const tips = { wanted: new Tips(program, robot, worldFromBase), done: new Tips(interpreted.context, robot, worldFromBase) };
  const { resolution = {} } = dialect, position_m = Math.max(PROOF_TOLERANCE.position_m, resolution.position_m ?? 0), angle_rad = Math.max(PROOF_TOLERANCE.angle_rad, resolution.angle_rad ?? 0);
  for (const [i, { step: wanted, stops }] of wantedSteps.entries()) {
    const done = executed[i];
    const differs = (sentence: string, line = done?.line ?? 0): Proof => ({ kind: "differs", file: file.name, step: wanted.id, line, sentence: `Step ${wanted.name ?? wanted.id}: ${sentence}` });
    if (done === undefined) return differs("the text ends before it.");
    const odd = otherwise(wanted, done.step, stops ? undefined : wantedSteps[i + 1]?.step, robot, resolution);
    if (odd !== undefined) return differs(`line ${done.line} ${odd}`);
    const [deviation_m, deviation_rad] = wanted.type === "move" && done.step.type === "move" ? deviation(wanted, done.step, tips) : [0, 0];
    if (!(deviation_m <= position_m)) return differs(`line ${done.line} ends ${millimetres(deviation_m).toFixed(3)} mm away; ${millimetres(position_m)} mm are allowed.`);
    if (!(deviation_rad <= angle_rad)) return differs(`line ${done.line} ends turned by ${degrees(deviation_rad).toFixed(4)}°; ${degrees(angle_rad).toFixed(3)}° are allowed.`);
    steps.push({ id: wanted.id, line: done.line, deviation_m, deviation_rad });
  }
  const extra = executed[wantedSteps.length];
  if (isWhole && extra !== undefined) return { kind: "differs", file: file.name, step: "", line: extra.line, sentence: `Line ${extra.line} does something after the last step.` };
  const worst_m = Math.max(0, ...steps.map(step => step.deviation_m)), worst_rad = Math.max(0, ...steps.map(step => step.deviation_rad));
  return {
    kind: "proven", file: file.name, steps, worst_m, worst_rad,
    sentence: `${file.name} was executed line by line and meets all ${steps.length} steps within ${millimetres(worst_m).toFixed(4)} mm and ${degrees(worst_rad).toFixed(5)}°.`,
  };
}

/** More than this of a program that goes on for ever is not looked at. */
const MOST_STEPS = 100_000;

/** What the program does step by step while every line is off, and after which steps the robot stands whatever they say. */
function wantedOf(program: Program): { readonly steps: readonly { readonly step: PrimitiveStep; readonly stops: boolean }[]; readonly isWhole: boolean } {
  const steps: { step: PrimitiveStep; stops: boolean }[] = [], signals = new SignalTable();
  for (const happening of flow(program, { decide: when => holds(when, signals), rounds: 3 })) {
    if (happening.kind !== "step") continue;
    if (happening.stands) { const last = steps.at(-1); if (last !== undefined) last.stops = true; continue; }
    if (steps.length >= MOST_STEPS) return { steps, isWhole: false };
    const { step } = happening;
    if (step.type === "set") signals.write(step.signal, step.to);
    steps.push({ step, stops: false });
  }
  const isEndless = [...everyStep(program)].some(step => step.type === "repeat" && step.times === "forever");
  return { steps, isWhole: !isEndless };
}

/** Where the tip of a target is in the world. */
class Tips {
  private readonly context: Pick<Program, "tools" | "frames">;
  private readonly robot: Robot;
  private readonly worldFromBase: Pose<"world", "base">;
  constructor(context: Pick<Program, "tools" | "frames">, robot: Robot, worldFromBase: Pose<"world", "base">) {
    this.context = context;
    this.robot = robot;
    this.worldFromBase = worldFromBase;
  }

  tool(name: string | undefined): Pose<"flange", "tcp"> {
    return name !== undefined && Object.hasOwn(this.context.tools, name) ? this.context.tools[name]! : identity();
  }

  of(target: Target): Pose<"world", "tcp"> {
    if ("q" in target) return compose(compose(this.worldFromBase, flangePose(this.robot.arm, target.q)), this.tool(target.tool));
    const worldFromFrame = Object.hasOwn(this.context.frames, target.frame) ? this.context.frames[target.frame]! : identity<"world", "frame">();
    return compose(worldFromFrame, target.pose);
  }
}

/** What about a step is not a matter of more or less, in words that follow "line 12 …". */
function otherwise(wanted: Step, done: Step, next: Step | undefined, robot: Robot, resolution: Resolution): string | undefined {
  if (wanted.type !== done.type) return `is a ${done.type} step, not a ${wanted.type} step.`;
  if (wanted.type === "wait" && done.type === "wait") return near(wanted.s, done.s, resolution.wait_s) ? undefined : `waits ${done.s} s, not ${wanted.s} s.`;
  if (wanted.type === "gripper" && done.type === "gripper") return wanted.closed === done.closed ? undefined : `${done.closed ? "closes" : "opens"} the gripper.`;
  const other = otherThan(wanted, done);
  if (other !== undefined) return other;
  if (wanted.type !== "move" || done.type !== "move") return undefined;
  if ((wanted.until === undefined) !== (done.until === undefined)) return `${done.until === undefined ? "does not end" : "ends"} at a signal.`;
  if (wanted.until !== undefined && done.until !== undefined && (!sameCondition(wanted.until.when, done.until.when) || wanted.until.missing !== done.until.missing)) return "searches for something else.";
  if (!near(wanted.acceleration?.ratio ?? 1, done.acceleration?.ratio ?? 1)) return "accelerates otherwise.";
  if (wanted.path !== done.path) return `moves by ${done.path}, not by ${wanted.path}.`;
  // On a joint move angles are angles; on the other paths only the tool counts.
  if (wanted.path === "ptp" && "q" in wanted.target !== "q" in done.target) return "ends in another sort of target.";
  if ((wanted.via === undefined) !== (done.via === undefined)) return done.via === undefined ? "passes through no other point." : "passes through another point.";
  if (!sameSpeed(wanted.speed, done.speed, robot, resolution)) return `moves at ${JSON.stringify(done.speed)}, not at ${JSON.stringify(wanted.speed)}.`;
  // A robot that is about to wait or to grip has stopped, whatever was said about passing.
  if (wanted.blend_m === 0 && (wanted.blend_ratio ?? 0) === 0 && done.blend_m > 0) return "passes its target without a stop.";
  // Points of one spline are passed as they are.
  const isInSpline = wanted.path === "spline" && next?.type === "move" && next.path === "spline";
  if ((wanted.blend_m > 0 || (wanted.blend_ratio ?? 0) > 0) && done.blend_m === 0 && !isInSpline && next?.type === "move" && sameTool(wanted, next)) return "stops at its target.";
  if ("pose" in wanted.target && wanted.target.branch !== undefined && "pose" in done.target) {
    const { shoulder, elbow, wrist } = wanted.target.branch, other = done.target.branch;
    // Off a joint move the posture is that of the start: a language may leave it unsaid.
    if ((other !== undefined || wanted.path === "ptp") && (other?.shoulder !== shoulder || other.elbow !== elbow || other.wrist !== wrist)) return "reaches its target in another posture.";
  }
  return undefined;
}

/** Only a tool that both steps name is surely not changed between them. */
const sameTool = (a: MoveStep, b: MoveStep): boolean => a.target.tool !== undefined && a.target.tool === b.target.tool;

/** The text holds single precision. */
const near = (a: number, b: number, step = 0): boolean => Math.abs(a - b) <= Math.max(1e-6 * Math.max(1, Math.abs(a)), step);

/** What steps do that move nothing. */
function otherThan(wanted: Step, done: Step): string | undefined {
  if (wanted.type === "set" && done.type === "set") {
    const isSame = sameName(wanted.signal, done.signal) && (typeof wanted.to === "boolean" ? wanted.to === done.to : typeof done.to === "number" && near(wanted.to, done.to)) && near(wanted.pulse_s ?? 0, done.pulse_s ?? 0);
    return isSame ? undefined : `sets ${done.signal} to ${String(done.to)}, not ${wanted.signal} to ${String(wanted.to)}.`;
  }
  if (wanted.type === "wait-for" && done.type === "wait-for") return sameCondition(wanted.when, done.when) && near(wanted.timeout_s ?? 0, done.timeout_s ?? 0) ? undefined : "waits for something else.";
  if (wanted.type === "payload" && done.type === "payload") {
    const none = [0, 0, 0, 0, 0, 0], a = [wanted.mass_kg, ...wanted.center_m, ...(wanted.inertia_kgm2 ?? none)], b = [done.mass_kg, ...done.center_m, ...(done.inertia_kgm2 ?? none)];
    return a.every((value, i) => near(value, b[i]!)) ? undefined : "carries another load.";
  }
  return undefined;
}

/** Languages have their own rules for names: letters and figures count. */
const sameName = (a: string, b: string): boolean => plainName(a) === plainName(b);
const plainName = (name: string): string => asciiText(name).toLowerCase().replace(/[^a-z0-9]/g, "");

function sameCondition(a: Condition, b: Condition): boolean {
  if (!sameName(a.signal, b.signal)) return false;
  if ("is" in a) return "is" in b && a.is === b.is;
  return "above" in a ? "above" in b && near(a.above, b.above) : "below" in b && near(a.below, b.below);
}

/** A controller that knows speeds of one sort only is given the same share of its full speed. */
function sameSpeed(a: MoveStep["speed"], b: MoveStep["speed"], { maxTcpSpeed_mps }: Robot, { ratio, mps, mostMps = Number.POSITIVE_INFINITY }: Resolution): boolean {
  if ("time_s" in a || "time_s" in b) return "time_s" in a && "time_s" in b && near(a.time_s, b.time_s);
  if ("ratio" in a && "ratio" in b) return near(a.ratio, b.ratio, ratio);
  if ("mps" in b) return near(Math.min(mostMps, "mps" in a ? a.mps : a.ratio * maxTcpSpeed_mps), b.mps, mps);
  return near(Math.min(1, "mps" in a ? a.mps / maxTcpSpeed_mps : a.ratio), b.ratio, ratio);
}

function deviation(wanted: MoveStep, done: MoveStep, tips: { readonly wanted: Tips; readonly done: Tips }): [deviation_m: number, deviation_rad: number] {
  const [end_m, end_rad] = deviationAtEnd(wanted, done, tips);
  if (wanted.via === undefined || done.via === undefined) return [end_m, end_rad];
  // The orientation at the point on the way is no part of an arc.
  return [Math.max(end_m, distance(tips.wanted.of(wanted.via).position, tips.done.of(done.via).position)), end_rad];
}

function deviationAtEnd(wanted: MoveStep, done: MoveStep, tips: { readonly wanted: Tips; readonly done: Tips }): [deviation_m: number, deviation_rad: number] {
  const a = wanted.target, b = done.target;
  if ("q" in a && "q" in b) {
    // Joint angles one by one, since two postures may hold the tip in the same place; and the tip, of the tool that counts.
    const turned = Math.max(...a.q.map((angle, i) => Math.abs(angle - b.q[i]!)));
    const tool = a.tool === undefined && wanted.path === "ptp" ? undefined : a;
    const tipA = tips.wanted.of(tool ?? { q: a.q }), tipB = tips.done.of(tool === undefined ? { q: b.q } : b);
    return [distance(tipA.position, tipB.position), Math.max(turned, angleBetween(tipA.quaternion, tipB.quaternion))];
  }
  const tipA = tips.wanted.of(a), tipB = tips.done.of(b);
  const toolA = tips.wanted.tool(a.tool), toolB = tips.done.tool(b.tool);
  return [
    Math.max(distance(tipA.position, tipB.position), distance(toolA.position, toolB.position)),
    Math.max(angleBetween(tipA.quaternion, tipB.quaternion), angleBetween(toolA.quaternion, toolB.quaternion)),
  ];
}
