import {
  Fault, angleBetween, branchOf, compose, degrees, distance, flangePose, identity, inverse, millimetres, sameBranch, wrapAngle, type Branch, type Dialect, type EmittedFile, type Executed, type MoveStep, type Pose, type Program, type Robot, type Resolution, type Step, type Target, type TextFault,
} from "@twincell/core";

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
  const executed: (Executed & { readonly step: Step })[] = [];
  try {
    const run = interpreted.run();
    // One step more than wanted is enough to see that there are too many.
    for (let next = run.next(); next.done !== true && executed.length <= program.steps.length; next = run.next()) {
      if (next.value.step !== undefined) executed.push({ ...next.value, step: next.value.step });
    }
  } catch (cause) {
    if (!(cause instanceof Fault)) throw cause;
    return { kind: "not-executed", file: file.name, faults: [], sentence: `${file.name} stops: ${cause.message} ${cause.hint}` };
  }
  const steps: ProvenStep[] = [];
  const tips = { wanted: new Tips(program, robot, worldFromBase), done: new Tips(interpreted.context, robot, worldFromBase) };
  const { resolution = {} } = dialect, position_m = Math.max(PROOF_TOLERANCE.position_m, resolution.position_m ?? 0), angle_rad = Math.max(PROOF_TOLERANCE.angle_rad, resolution.angle_rad ?? 0);
  for (const [i, wanted] of program.steps.entries()) {
    const done = executed[i];
    const differs = (sentence: string, line = done?.line ?? 0): Proof => ({ kind: "differs", file: file.name, step: wanted.id, line, sentence: `Step ${wanted.name ?? wanted.id}: ${sentence}` });
    if (done === undefined) return differs("the text ends before it.");
    const odd = otherwise(wanted, done.step, program.steps[i + 1], robot, resolution);
    if (odd !== undefined) return differs(`line ${done.line} ${odd}`);
    const [deviation_m, deviation_rad] = wanted.type === "move" && done.step.type === "move" ? deviation(wanted, done.step, tips, resolution) : [0, 0];
    if (!(deviation_m <= position_m)) return differs(`line ${done.line} ends ${millimetres(deviation_m).toFixed(3)} mm away; ${millimetres(position_m)} mm are allowed.`);
    if (!(deviation_rad <= angle_rad)) return differs(`line ${done.line} ends turned by ${degrees(deviation_rad).toFixed(4)}°; ${degrees(angle_rad).toFixed(3)}° are allowed.`);
    steps.push({ id: wanted.id, line: done.line, deviation_m, deviation_rad });
  }
  const extra = executed[program.steps.length];
  if (extra !== undefined) return { kind: "differs", file: file.name, step: "", line: extra.line, sentence: `Line ${extra.line} does something after the last step.` };
  const worst_m = Math.max(0, ...steps.map(step => step.deviation_m)), worst_rad = Math.max(0, ...steps.map(step => step.deviation_rad));
  return {
    kind: "proven", file: file.name, steps, worst_m, worst_rad,
    sentence: `${file.name} was executed line by line and meets all ${steps.length} steps within ${millimetres(worst_m).toFixed(4)} mm and ${degrees(worst_rad).toFixed(5)}°.`,
  };
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
  if (wanted.type !== "move" || done.type !== "move") return undefined;
  if (wanted.path !== done.path) return `moves by ${done.path}, not by ${wanted.path}.`;
  // On a joint move angles are angles; on the other paths only the tool counts.
  const isAngles = "q" in wanted.target, isWritten = "q" in done.target;
  if (wanted.path === "ptp" && isAngles !== isWritten && !(isAngles ? resolution.anglesAsPoses === true : resolution.posesAsAngles === true)) return "ends in another sort of target.";
  if ((wanted.via === undefined) !== (done.via === undefined)) return done.via === undefined ? "passes through no other point." : "passes through another point.";
  if (!sameSpeed(wanted.speed, done.speed, robot, resolution)) return `moves at ${JSON.stringify(done.speed)}, not at ${JSON.stringify(wanted.speed)}.`;
  // A robot that is about to wait or to grip has stopped, whatever was said about passing.
  if (wanted.blend_m === 0 && done.blend_m > 0) return "passes its target without a stop.";
  // Points of one spline are passed as they are.
  const isInSpline = wanted.path === "spline" && next?.type === "move" && next.path === "spline";
  if (wanted.blend_m > 0 && done.blend_m === 0 && !isInSpline && next?.type === "move" && sameTool(wanted, next)) return "stops at its target.";
  const posture = postureOf(wanted.target, robot), other = postureOf(done.target, robot);
  // Off a joint move the posture is that of the start: a language may leave it unsaid.
  if (posture !== undefined && !agrees(posture, other) && (other !== undefined || wanted.path === "ptp")) return "reaches its target in another posture.";
  return undefined;
}

const postureOf = (target: Target, robot: Robot): Branch | undefined => "q" in target ? branchOf(robot, target.q) : target.branch;
const agrees = (a: Branch, b: Branch | undefined): boolean => b !== undefined && sameBranch(a, b);

/** Only a tool that both steps name is surely not changed between them. */
const sameTool = (a: MoveStep, b: MoveStep): boolean => a.target.tool !== undefined && a.target.tool === b.target.tool;

/** The text holds single precision. */
const near = (a: number, b: number, step = 0): boolean => Math.abs(a - b) <= Math.max(1e-6 * Math.max(1, Math.abs(a)), step);

/** A controller that knows speeds of one sort only is given the same share of its full speed. */
function sameSpeed(a: MoveStep["speed"], b: MoveStep["speed"], { maxTcpSpeed_mps }: Robot, { ratio, leastRatio = 0, mps, mostMps = Number.POSITIVE_INFINITY }: Resolution): boolean {
  if ("time_s" in a || "time_s" in b) return "time_s" in a && "time_s" in b && near(a.time_s, b.time_s);
  if ("mps" in b) return near(Math.min(mostMps, "mps" in a ? a.mps : a.ratio * maxTcpSpeed_mps), b.mps, mps);
  return near(Math.min(1, Math.max(leastRatio, "mps" in a ? a.mps / maxTcpSpeed_mps : a.ratio)), b.ratio, ratio);
}

function deviation(wanted: MoveStep, done: MoveStep, tips: { readonly wanted: Tips; readonly done: Tips }, resolution: Resolution): [deviation_m: number, deviation_rad: number] {
  const [end_m, end_rad] = deviationAtEnd(wanted, done, tips, resolution);
  if (wanted.via === undefined || done.via === undefined) return [end_m, end_rad];
  // The orientation at the point on the way is no part of an arc.
  return [Math.max(end_m, distance(tips.wanted.of(wanted.via).position, tips.done.of(done.via).position)), end_rad];
}

const OTHER_TURN_RAD = 1;

function deviationAtEnd(wanted: MoveStep, done: MoveStep, tips: { readonly wanted: Tips; readonly done: Tips }, { anglesAsPoses = false }: Resolution): [deviation_m: number, deviation_rad: number] {
  const a = wanted.target, b = done.target;
  if ("q" in a && "q" in b) {
    // Joint angles one by one, since two postures may hold the tip in the same place; and the tip, of the tool that counts.
    // Along a path the axes arrive in the turn that is nearest, whatever turn was taught.
    const apart = Math.max(...a.q.map((angle, i) => Math.abs(wanted.path === "ptp" ? angle - b.q[i]! : wrapAngle(angle - b.q[i]!))));
    // Near a singular posture the angles of one and the same pose are far apart; another turn is further still.
    const turned = anglesAsPoses && apart < OTHER_TURN_RAD ? 0 : apart;
    const tool = a.tool === undefined && wanted.path === "ptp" ? undefined : a;
    const tipA = tips.wanted.of(tool ?? { q: a.q }), tipB = tips.done.of(tool === undefined ? { q: b.q } : b);
    return [distance(tipA.position, tipB.position), Math.max(turned, angleBetween(tipA.quaternion, tipB.quaternion))];
  }
  if ("q" in a && a.tool === undefined && wanted.path === "ptp") {
    // Joint angles taught with any tool: where the flange is counts.
    const flangeA = tips.wanted.of({ q: a.q }), flangeB = compose(tips.done.of(b), inverse(tips.done.tool(b.tool)));
    return [distance(flangeA.position, flangeB.position), angleBetween(flangeA.quaternion, flangeB.quaternion)];
  }
  const tipA = tips.wanted.of(a), tipB = tips.done.of(b);
  const toolA = tips.wanted.tool(a.tool), toolB = tips.done.tool(b.tool);
  return [
    Math.max(distance(tipA.position, tipB.position), distance(toolA.position, toolB.position)),
    Math.max(angleBetween(tipA.quaternion, tipB.quaternion), angleBetween(toolA.quaternion, toolB.quaternion)),
  ];
}
