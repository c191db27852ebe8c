import {
  angleBetween,
  branchOf,
  compose,
  distance,
  flangePose,
  identity,
  inverse,
  sameBranch,
  wrapAngle,
  type Branch,
  isCondition,
  withPredicateLines,
  type Predicate,
  type MoveStep,
  type PayloadStep,
  type Pose,
  type Program,
  type Resolution,
  type Robot,
  type Step,
  type Target,
} from "@twincell/core";
import { asciiText } from "../parser/lines.ts";

/** Where the tip of a target is in the world. */
export class StepTips {
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
export interface StepTerms {
  readonly mine: Program["signals"];
  readonly theirs: Program["signals"];
  readonly robot: Robot;
  readonly resolution: Resolution;
}

/** What about a step is not a matter of more or less, in words that follow "line 12 …". */
export function stepDifference(wanted: Step, done: Step, next: Step | undefined, terms: StepTerms): string | undefined {
  if (wanted.type !== done.type) return `is a ${done.type} step, not a ${wanted.type} step.`;
  if (wanted.type === "move" && done.type === "move") return moveDifference(wanted, done, next, terms);
  const differ = wanted.type === "move" ? undefined : (DIFFERENCES[wanted.type] as Difference<Step> | undefined);
  return differ?.(wanted, done, terms);
}

type Difference<S> = (wanted: S, done: S, terms: StepTerms) => string | undefined;
type OfType<T extends Step["type"]> = Extract<Step, { readonly type: T }>;

/** Steps that do not move the robot; those that are not here differ in nothing that an execution shows. */
const DIFFERENCES: { readonly [T in Exclude<Step["type"], "move">]?: Difference<OfType<T>> } = {
  wait: (wanted, done, { resolution }) =>
    near(wanted.s, done.s, resolution.wait_s) ? undefined : `waits ${done.s} s, not ${wanted.s} s.`,
  gripper: (wanted, done) =>
    wanted.closed === done.closed ? undefined : `${done.closed ? "closes" : "opens"} the gripper.`,
  set: (wanted, done, { mine, theirs }) => {
    if (!sameLine(wanted.signal, done.signal, mine, theirs)) return `sets ${done.signal}, not ${wanted.signal}.`;
    if (!sameLevel(wanted.to, done.to)) return `sets ${done.signal} to ${done.to}, not to ${wanted.to}.`;
    return near(wanted.pulse_s ?? 0, done.pulse_s ?? 0)
      ? undefined
      : `holds ${done.signal} for ${done.pulse_s ?? 0} s, not for ${wanted.pulse_s ?? 0} s.`;
  },
  "wait-for": (wanted, done, { mine, theirs }) => {
    if (!sameCondition(wanted.when, done.when, mine, theirs))
      return `waits for ${JSON.stringify(done.when)}, not for ${JSON.stringify(wanted.when)}.`;
    return near(wanted.timeout_s ?? 0, done.timeout_s ?? 0)
      ? undefined
      : `waits ${done.timeout_s ?? 0} s at most, not ${wanted.timeout_s ?? 0} s.`;
  },
  payload: (wanted, done) => (samePayload(wanted, done) ? undefined : `says another load of ${done.mass_kg} kg.`),
  message: (wanted, done) => (plain(wanted.text) === plain(done.text) ? undefined : `says “${done.text}”.`),
};

function moveDifference(
  wanted: MoveStep,
  done: MoveStep,
  next: Step | undefined,
  terms: StepTerms,
): string | undefined {
  if (wanted.path !== done.path) return `moves by ${done.path}, not by ${wanted.path}.`;
  return (
    targetDifference(wanted, done, terms) ??
    paceDifference(wanted, done, terms) ??
    passingDifference(wanted, done, next, terms) ??
    searchDifference(wanted, done, terms) ??
    postureDifference(wanted, done, terms)
  );
}

/** On a joint move angles are angles; on the other paths only the tool counts. */
function targetDifference(wanted: MoveStep, done: MoveStep, { resolution }: StepTerms): string | undefined {
  const isAngles = "q" in wanted.target;
  const isWritten = "q" in done.target;
  if (
    wanted.path === "ptp" &&
    isAngles !== isWritten &&
    !(isAngles ? resolution.anglesAsPoses === true : resolution.posesAsAngles === true)
  )
    return "ends in another sort of target.";
  if ((wanted.via === undefined) === (done.via === undefined)) return undefined;
  return done.via === undefined ? "passes through no other point." : "passes through another point.";
}

function paceDifference(wanted: MoveStep, done: MoveStep, { robot, resolution }: StepTerms): string | undefined {
  if (!sameSpeed(wanted.speed, done.speed, robot, resolution))
    return `moves at ${JSON.stringify(done.speed)}, not at ${JSON.stringify(wanted.speed)}.`;
  const least = Math.max(resolution.leastAcceleration ?? 0, wanted.acceleration?.ratio ?? 1);
  return near(least, done.acceleration?.ratio ?? 1)
    ? undefined
    : `accelerates by ${done.acceleration?.ratio ?? 1}, not by ${wanted.acceleration?.ratio ?? 1}.`;
}

function passingDifference(
  wanted: MoveStep,
  done: MoveStep,
  next: Step | undefined,
  { resolution }: StepTerms,
): string | undefined {
  // A robot that is about to wait or to grip has stopped, whatever was said about passing.
  if (!blends(wanted) && blends(done)) return "passes its target without a stop.";
  // Points of one spline are passed as they are.
  const isInSpline = wanted.path === "spline" && next?.type === "move" && next.path === "spline";
  const isStopped =
    blends(wanted) &&
    !blends(done) &&
    !isInSpline &&
    next?.type === "move" &&
    (resolution.stopsAtNewTool !== true || sameTool(wanted, next));
  return isStopped ? "stops at its target." : undefined;
}

function searchDifference(wanted: MoveStep, done: MoveStep, { mine, theirs }: StepTerms): string | undefined {
  if (wanted.until === undefined && done.until === undefined) return undefined;
  return wanted.until === undefined ||
    done.until === undefined ||
    wanted.until.missing !== done.until.missing ||
    !sameCondition(wanted.until.when, done.until.when, mine, theirs)
    ? "searches otherwise."
    : undefined;
}

/** Off a joint move the posture is that of the start: a language may leave it unsaid. */
function postureDifference(wanted: MoveStep, done: MoveStep, { robot }: StepTerms): string | undefined {
  const configuration = postureOf(wanted.target, robot);
  const other = postureOf(done.target, robot);
  return configuration !== undefined &&
    (other === undefined ? wanted.path === "ptp" : !sameBranch(configuration, other))
    ? "reaches its target in another posture."
    : undefined;
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

function sameCondition(a: Predicate, b: Predicate, mine: Program["signals"], theirs: Program["signals"]): boolean {
  if (!isCondition(a) || !isCondition(b)) return !isCondition(a) && !isCondition(b) && samePart(a, b, mine, theirs);
  if (!sameLine(a.signal, b.signal, mine, theirs)) return false;
  if ("is" in a) return "is" in b && a.is === b.is;
  return "above" in a ? "above" in b && near(a.above, b.above) : "below" in b && near(a.below, b.below);
}

/** Two expressions that are the same but for what lines are called. */
function samePart(a: Predicate, b: Predicate, mine: Program["signals"], theirs: Program["signals"]): boolean {
  const told = (when: Predicate, lines: Program["signals"]): string =>
    JSON.stringify(withPredicateLines(when, name => String(Object.hasOwn(lines, name) ? lines[name]!.address : name)));
  return told(a, mine) === told(b, theirs);
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

export function stepDeviation(
  wanted: MoveStep,
  done: MoveStep,
  tips: { readonly wanted: StepTips; readonly done: StepTips },
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
  tips: { readonly wanted: StepTips; readonly done: StepTips },
  { anglesAsPoses = false }: Resolution,
): [deviation_m: number, deviation_rad: number] {
  const a = wanted.target;
  const b = done.target;
  if ("q" in a && "q" in b) {
    // Joint angles one by one, since two postures may hold the tip in the same place; and the tip, of the tool that
    // counts. Along a path the axes arrive in the turn that is nearest, whatever turn was taught.
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
