import {
  Fault,
  angleBetween,
  branchOf,
  capabilitiesUsed,
  compose,
  degrees,
  distance,
  everyStep,
  flangePose,
  flow,
  holds,
  identity,
  inverse,
  millimetres,
  sameBranch,
  wrapAngle,
  type Branch,
  type Condition,
  type Dialect,
  type EmittedFile,
  type Executed,
  type Happening,
  type Interpreted,
  type MoveStep,
  type PayloadStep,
  type Pose,
  type PrimitiveStep,
  type Program,
  type Resolution,
  type Robot,
  type Signals,
  type Step,
  type Target,
  type TextFault,
} from "@twincell/core";
import { asciiText } from "./text/index.ts";

/** What a controller executes of the files of an export, as one text. */
export const runnableFile = (dialect: Dialect, files: readonly EmittedFile[]): EmittedFile | undefined =>
  dialect.runnable?.(files) ?? files[0];

/** How far an executed text may be from the program it was made of. */
export const PROOF_TOLERANCE = { position_m: 1e-5, angle_rad: (1e-3 / 180) * Math.PI } as const;

/** A step of the program beside what the text did in its place. */
export interface ProvenStep {
  readonly id: string;
  /** Line of the file that did it. */
  readonly line: number;
  readonly deviation_m: number;
  readonly deviation_rad: number;
}
export type Proof =
  | {
      readonly kind: "proven";
      readonly file: string;
      readonly steps: readonly ProvenStep[];
      readonly worst_m: number;
      readonly worst_rad: number;
      readonly sentence: string;
    }
  | {
      readonly kind: "differs";
      readonly file: string;
      readonly step: string;
      readonly line: number;
      readonly sentence: string;
    }
  | {
      readonly kind: "not-executed";
      readonly file: string;
      readonly faults: readonly TextFault[];
      readonly sentence: string;
    };

/** Loops without end are followed this often round. */
const ROUNDS = 3;
/** More steps than this are not compared. */
const MOST_STEPS = 50_000;
/** What inputs say while a text and its program are compared: nothing, everything, and now this, now that. */
const TRIALS: readonly ((read: number) => boolean)[] = [() => false, () => true, read => (read * 7 + 3) % 5 < 2];

/**
 * Executes an emitted text and compares it, step by step, with the program it was made of: sort of step, path, tool tip in
 * the world, joint angles where they were taught, speed, stop or no stop, signals. Loops, calls and pallets are carried
 * out on both sides; where the program decides by signals, both are told the same and compared three times. This proves
 * the text, not the emitter's intention.
 */
export function proveText(
  dialect: Pick<Dialect, "interpret" | "resolution">,
  file: { readonly name: string; readonly text: string },
  program: Program,
  robot: Robot,
  worldFromBase: Pose<"world", "base"> = identity(),
): Proof {
  const interpreted = dialect.interpret(file.text, robot, worldFromBase);
  if (interpreted.kind === "not-understood") {
    const fault = interpreted.faults[0]!;
    return {
      kind: "not-executed",
      file: file.name,
      faults: interpreted.faults,
      sentence: `${file.name} stops in line ${fault.line}, column ${fault.column}: ${fault.sentence}`,
    };
  }
  const decides = capabilitiesUsed(program).has("if");
  const steps: ProvenStep[] = [];
  for (const trial of decides ? TRIALS : TRIALS.slice(0, 1)) {
    try {
      const differs = compare(
        interpreted,
        file.name,
        program,
        robot,
        worldFromBase,
        dialect.resolution ?? {},
        trial,
        steps,
      );
      if (differs !== undefined) return differs;
    } catch (cause) {
      if (!(cause instanceof Fault)) throw cause;
      return {
        kind: "not-executed",
        file: file.name,
        faults: [],
        sentence: `${file.name} stops: ${cause.message} ${cause.hint}`,
      };
    }
  }
  const worst_m = steps.reduce((most, step) => Math.max(most, step.deviation_m), 0);
  const worst_rad = steps.reduce((most, step) => Math.max(most, step.deviation_rad), 0);
  return {
    kind: "proven",
    file: file.name,
    steps,
    worst_m,
    worst_rad,
    sentence: `${file.name} was executed line by line and meets all ${steps.length} steps within ${millimetres(worst_m).toFixed(4)} mm and ${degrees(worst_rad).toFixed(5)}°.`,
  };
}

function compare(
  interpreted: Extract<Interpreted, { kind: "ready" }>,
  file: string,
  program: Program,
  robot: Robot,
  worldFromBase: Pose<"world", "base">,
  resolution: Resolution,
  trial: (read: number) => boolean,
  proven: ProvenStep[],
): Extract<Proof, { kind: "differs" }> | undefined {
  const tips = {
    wanted: new Tips(program, robot, worldFromBase),
    done: new Tips(interpreted.context, robot, worldFromBase),
  };
  const position_m = Math.max(PROOF_TOLERANCE.position_m, resolution.position_m ?? 0);
  const angle_rad = Math.max(PROOF_TOLERANCE.angle_rad, resolution.angle_rad ?? 0);
  const wanted = program.signals;
  const done = interpreted.context.signals ?? {};
  const text = steady(interpreted.run(new Told(trial)));
  const told = new Told(trial);
  const forever = Array.from(everyStep(program)).some(step => step.type === "repeat" && step.times === "forever");
  const decide = (when: Condition): boolean => holds(when, told);
  let count = 0;
  let ended = false;
  const steps = following(flow(program, { decide, ...(forever ? { rounds: ROUNDS } : {}) }), told);
  for (const [step, next] of steps) {
    if (count++ >= MOST_STEPS) return undefined;
    const found = text.next();
    const differs = (sentence: string): Extract<Proof, { kind: "differs" }> => ({
      kind: "differs",
      file,
      step: step.id,
      line: found?.line ?? 0,
      sentence: `Step ${step.name ?? step.id}: ${sentence}`,
    });
    if (found === undefined) return differs("the text ends before it.");
    const odd = otherwise(step, found.step, next, { mine: wanted, theirs: done, robot, resolution });
    if (odd !== undefined) return differs(`line ${found.line} ${odd}`);
    const [deviation_m, deviation_rad] =
      step.type === "move" && found.step.type === "move" ? deviation(step, found.step, tips, resolution) : [0, 0];
    if (!(deviation_m <= position_m))
      return differs(
        `line ${found.line} ends ${millimetres(deviation_m).toFixed(3)} mm away; ${millimetres(position_m)} mm are allowed.`,
      );
    if (!(deviation_rad <= angle_rad))
      return differs(
        `line ${found.line} ends turned by ${degrees(deviation_rad).toFixed(4)}°; ${degrees(angle_rad).toFixed(3)}° are allowed.`,
      );
    proven.push({ id: step.id, line: found.line, deviation_m, deviation_rad });
    ended = step.type === "stop";
  }
  // A loop without end has been left on this side only.
  const extra = forever && !ended ? undefined : text.next();
  return extra === undefined
    ? undefined
    : {
        kind: "differs",
        file,
        step: "",
        line: extra.line,
        sentence: `Line ${extra.line} does something after the last step.`,
      };
}

/** The steps of an executed text, one by one. */
function steady(run: Iterator<Executed, void>): { next(): { readonly line: number; readonly step: Step } | undefined } {
  return {
    next() {
      for (let next = run.next(); next.done !== true; next = run.next())
        if (next.value.step !== undefined) return { line: next.value.line, step: next.value.step };
      return undefined;
    },
  };
}

/** The steps of the program, each with the one after it where that is known without a decision: stops that it does not say are told as no step. */
function* following(
  happenings: Iterable<Happening>,
  told: Told,
): Generator<readonly [PrimitiveStep, PrimitiveStep | undefined], void> {
  let before: PrimitiveStep | undefined;
  for (const happening of happenings) {
    if (happening.kind !== "step") {
      if (happening.kind === "passed" && happening.step.type !== "comment" && before !== undefined) {
        yield [before, undefined];
        before = undefined;
      }
      continue;
    }
    const { step, stands } = happening;
    if (step.type === "set") told.write(step.signal, step.to);
    if (before !== undefined) yield [before, stands ? undefined : step];
    before = stands ? undefined : step;
  }
  if (before !== undefined) yield [before, undefined];
}

/** Inputs that say what a trial says, the same for the n-th question whoever asks; outputs are what was written. */
class Told implements Signals {
  private readonly trial: (read: number) => boolean;
  private readonly written = new Map<string, boolean | number>();
  private reads = 0;
  constructor(trial: (read: number) => boolean) {
    this.trial = trial;
  }
  read(signal: string): boolean | number {
    return this.written.get(signal) ?? this.trial(this.reads++);
  }
  write(signal: string, value: boolean | number): void {
    this.written.set(signal, value);
  }
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
    if ("q" in target)
      return compose(compose(this.worldFromBase, flangePose(this.robot.arm, target.q)), this.tool(target.tool));
    const worldFromFrame = Object.hasOwn(this.context.frames, target.frame)
      ? this.context.frames[target.frame]!
      : identity<"world", "frame">();
    return compose(worldFromFrame, target.pose);
  }
}

/** What both sides call their signals, and how finely the text can say a number. */
interface Terms {
  readonly mine: Program["signals"];
  readonly theirs: Program["signals"];
  readonly robot: Robot;
  readonly resolution: Resolution;
}

/** What about a step is not a matter of more or less, in words that follow "line 12 …". */
function otherwise(
  wanted: Step,
  done: Step,
  next: Step | undefined,
  { mine, theirs, robot, resolution }: Terms,
): string | undefined {
  if (wanted.type !== done.type) return `is a ${done.type} step, not a ${wanted.type} step.`;
  if (wanted.type === "wait" && done.type === "wait")
    return near(wanted.s, done.s, resolution.wait_s) ? undefined : `waits ${done.s} s, not ${wanted.s} s.`;
  if (wanted.type === "gripper" && done.type === "gripper")
    return wanted.closed === done.closed ? undefined : `${done.closed ? "closes" : "opens"} the gripper.`;
  if (wanted.type === "set" && done.type === "set") {
    if (!sameLine(wanted.signal, done.signal, mine, theirs)) return `sets ${done.signal}, not ${wanted.signal}.`;
    if (!sameLevel(wanted.to, done.to)) return `sets ${done.signal} to ${done.to}, not to ${wanted.to}.`;
    return near(wanted.pulse_s ?? 0, done.pulse_s ?? 0)
      ? undefined
      : `holds ${done.signal} for ${done.pulse_s ?? 0} s, not for ${wanted.pulse_s ?? 0} s.`;
  }
  if (wanted.type === "wait-for" && done.type === "wait-for") {
    if (!sameCondition(wanted.when, done.when, mine, theirs))
      return `waits for ${JSON.stringify(done.when)}, not for ${JSON.stringify(wanted.when)}.`;
    return near(wanted.timeout_s ?? 0, done.timeout_s ?? 0)
      ? undefined
      : `waits ${done.timeout_s ?? 0} s at most, not ${wanted.timeout_s ?? 0} s.`;
  }
  if (wanted.type === "payload" && done.type === "payload")
    return samePayload(wanted, done) ? undefined : `says another load of ${done.mass_kg} kg.`;
  if (wanted.type === "message" && done.type === "message")
    return plain(wanted.text) === plain(done.text) ? undefined : `says “${done.text}”.`;
  if (wanted.type !== "move" || done.type !== "move") return undefined;
  if (wanted.path !== done.path) return `moves by ${done.path}, not by ${wanted.path}.`;
  // On a joint move angles are angles; on the other paths only the tool counts.
  const isAngles = "q" in wanted.target;
  const isWritten = "q" in done.target;
  if (
    wanted.path === "ptp" &&
    isAngles !== isWritten &&
    !(isAngles ? resolution.anglesAsPoses === true : resolution.posesAsAngles === true)
  )
    return "ends in another sort of target.";
  if ((wanted.via === undefined) !== (done.via === undefined))
    return done.via === undefined ? "passes through no other point." : "passes through another point.";
  if (!sameSpeed(wanted.speed, done.speed, robot, resolution))
    return `moves at ${JSON.stringify(done.speed)}, not at ${JSON.stringify(wanted.speed)}.`;
  if (
    !near(Math.max(resolution.leastAcceleration ?? 0, wanted.acceleration?.ratio ?? 1), done.acceleration?.ratio ?? 1)
  )
    return `accelerates by ${done.acceleration?.ratio ?? 1}, not by ${wanted.acceleration?.ratio ?? 1}.`;
  // A robot that is about to wait or to grip has stopped, whatever was said about passing.
  if (!blends(wanted) && blends(done)) return "passes its target without a stop.";
  // Points of one spline are passed as they are.
  const isInSpline = wanted.path === "spline" && next?.type === "move" && next.path === "spline";
  if (
    blends(wanted) &&
    !blends(done) &&
    !isInSpline &&
    next?.type === "move" &&
    (resolution.stopsAtNewTool !== true || sameTool(wanted, next))
  )
    return "stops at its target.";
  if (wanted.until !== undefined || done.until !== undefined) {
    if (
      wanted.until === undefined ||
      done.until === undefined ||
      wanted.until.missing !== done.until.missing ||
      !sameCondition(wanted.until.when, done.until.when, mine, theirs)
    )
      return "searches otherwise.";
  }
  const posture = postureOf(wanted.target, robot);
  const other = postureOf(done.target, robot);
  // Off a joint move the posture is that of the start: a language may leave it unsaid.
  if (posture !== undefined && (other === undefined ? wanted.path === "ptp" : !sameBranch(posture, other)))
    return "reaches its target in another posture.";
  return undefined;
}

const postureOf = (target: Target, robot: Robot): Branch | undefined =>
  "q" in target ? branchOf(robot, target.q) : target.branch;

const blends = ({ blend_m, blend_ratio = 0 }: MoveStep): boolean => blend_m > 0 || blend_ratio > 0;

/** The controller knows a line by its number; names may differ. */
function sameLine(wanted: string, done: string, mine: Program["signals"], theirs: Program["signals"]): boolean {
  const a = Object.hasOwn(mine, wanted) ? mine[wanted]!.address : undefined;
  const b = Object.hasOwn(theirs, done) ? theirs[done]!.address : undefined;
  return a !== undefined && b !== undefined ? a === b : wanted === done;
}

const sameLevel = (a: boolean | number, b: boolean | number): boolean =>
  typeof a === "number" && typeof b === "number" ? near(a, b) : a === b;

function sameCondition(a: Condition, b: Condition, mine: Program["signals"], theirs: Program["signals"]): boolean {
  if (!sameLine(a.signal, b.signal, mine, theirs)) return false;
  if ("is" in a) return "is" in b && a.is === b.is;
  return "above" in a ? "above" in b && near(a.above, b.above) : "below" in b && near(a.below, b.below);
}

function samePayload(a: PayloadStep, b: PayloadStep): boolean {
  const numbers = ({ mass_kg, center_m, inertia_kgm2 = [0, 0, 0, 0, 0, 0] }: PayloadStep): readonly number[] => [
    mass_kg,
    ...center_m,
    ...inertia_kgm2,
  ];
  // Nothing has no centre.
  if (a.mass_kg === 0) return b.mass_kg === 0;
  const other = numbers(b);
  return numbers(a).every((x, i) => near(x, other[i]!));
}

/** A message in the signs that every controller has. */
const plain = (text: string): string => asciiText(text).replaceAll('"', "'");

/** Only a tool that both steps name is surely not changed between them. */
const sameTool = (a: MoveStep, b: MoveStep): boolean => a.target.tool !== undefined && a.target.tool === b.target.tool;

/** The text holds single precision. */
const near = (a: number, b: number, step = 0): boolean =>
  Math.abs(a - b) <= Math.max(1e-6 * Math.max(1, Math.abs(a)), step);

/** A controller that knows speeds of one sort only is given the same share of its full speed. */
function sameSpeed(
  a: MoveStep["speed"],
  b: MoveStep["speed"],
  { maxTcpSpeed_mps }: Robot,
  { ratio, leastRatio = 0, mps, mostMps = Number.POSITIVE_INFINITY }: Resolution,
): boolean {
  if ("time_s" in a || "time_s" in b) return "time_s" in a && "time_s" in b && near(a.time_s, b.time_s);
  if ("mps" in b) return near(Math.min(mostMps, "mps" in a ? a.mps : a.ratio * maxTcpSpeed_mps), b.mps, mps);
  return near(Math.min(1, Math.max(leastRatio, "mps" in a ? a.mps / maxTcpSpeed_mps : a.ratio)), b.ratio, ratio);
}

function deviation(
  wanted: MoveStep,
  done: MoveStep,
  tips: { readonly wanted: Tips; readonly done: Tips },
  resolution: Resolution,
): [deviation_m: number, deviation_rad: number] {
  const [end_m, end_rad] = deviationAtEnd(wanted, done, tips, resolution);
  if (wanted.via === undefined || done.via === undefined) return [end_m, end_rad];
  // The orientation at the point on the way is no part of an arc.
  return [Math.max(end_m, distance(tips.wanted.of(wanted.via).position, tips.done.of(done.via).position)), end_rad];
}

/** Angles further apart than by a singular posture are those of another turn. */
const OTHER_TURN_RAD = 1;

function deviationAtEnd(
  wanted: MoveStep,
  done: MoveStep,
  tips: { readonly wanted: Tips; readonly done: Tips },
  { anglesAsPoses = false }: Resolution,
): [deviation_m: number, deviation_rad: number] {
  const a = wanted.target;
  const b = done.target;
  if ("q" in a && "q" in b) {
    // Joint angles one by one, since two postures may hold the tip in the same place; and the tip, of the tool that counts.
    // Along a path the axes arrive in the turn that is nearest, whatever turn was taught.
    const apart = Math.max(
      ...a.q.map((angle, i) => Math.abs(wanted.path === "ptp" ? angle - b.q[i]! : wrapAngle(angle - b.q[i]!))),
    );
    const turned = anglesAsPoses && apart < OTHER_TURN_RAD ? 0 : apart;
    const tool = a.tool === undefined && wanted.path === "ptp" ? undefined : a;
    const tipA = tips.wanted.of(tool ?? { q: a.q });
    const tipB = tips.done.of(tool === undefined ? { q: b.q } : b);
    return [distance(tipA.position, tipB.position), Math.max(turned, angleBetween(tipA.quaternion, tipB.quaternion))];
  }
  if ("q" in a && a.tool === undefined && wanted.path === "ptp") {
    // Joint angles taught with any tool: where the flange is counts.
    const flangeA = tips.wanted.of({ q: a.q });
    const flangeB = compose(tips.done.of(b), inverse(tips.done.tool(b.tool)));
    return [distance(flangeA.position, flangeB.position), angleBetween(flangeA.quaternion, flangeB.quaternion)];
  }
  const tipA = tips.wanted.of(a);
  const tipB = tips.done.of(b);
  const toolA = tips.wanted.tool(a.tool);
  const toolB = tips.done.tool(b.tool);
  return [
    Math.max(distance(tipA.position, tipB.position), distance(toolA.position, toolB.position)),
    Math.max(angleBetween(tipA.quaternion, tipB.quaternion), angleBetween(toolA.quaternion, toolB.quaternion)),
  ];
}
