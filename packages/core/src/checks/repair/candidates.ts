import type { Robot } from "../../model/robot.ts";
import { isSlide, jointText } from "../../model/slide.ts";
import { compose, identity, type Pose } from "../../spatial/pose.ts";
import { conjugate, rotate } from "../../spatial/quaternion.ts";
import { radians } from "../../spatial/units.ts";
import type { Vector3 } from "../../spatial/vector.ts";
import { targetInBase, type PlanContext } from "../../trajectory/moves.ts";
import type { MoveStep, Program, Target } from "../../program/program.ts";
import { stepById } from "../../program/walk.ts";
import type { Finding, Repair, RepairKind } from "../verdict.ts";
import { axisWords, effortOf, inWorld, shiftWords, toolTurn, turnWords, type PoseChange } from "./change.ts";
import { leastChange, levelShift, LIFT, SPIN, TILT, type ChangeSearch, type Miss } from "./least-change.ts";
import type { PathFit, PlacedMove } from "./path-fit.ts";
import { missing, REPAIR_ROOM_RAD } from "./pose-repair.ts";

/** A way out that has not been proven yet. */
export interface Candidate {
  readonly repair: Repair & { readonly kind: RepairKind };
  /** How far it turns or moves [rad, m]; 1 where it does neither. */
  readonly amount: number;
  readonly unit: "rad" | "m" | "1";
  readonly effort: number;
}

/** What candidates are made from: the program as it was judged, and the step that is bad. */
export interface RepairScene {
  readonly program: Program;
  readonly robot: Robot;
  readonly context: PlanContext;
  readonly worldFromBase: Pose<"world", "base">;
  readonly moves: readonly PlacedMove[];
  /** Of postures that touch nothing as the cell stands. */
  readonly fit: PathFit;
  /** Of postures alone, for when robot or parts are moved. */
  readonly postures: PathFit;
  readonly step: MoveStep;
  readonly finding: Finding;
  /** What else was found of the step. */
  readonly others: readonly Finding[];
  /** The frames that are moved with one of them, itself among them. */
  readonly framesOf: (frame: string) => readonly string[];
}

/** Kinds that turn nothing and move nothing have an effort of their own. */
const EFFORT: Partial<Record<RepairKind, number>> = {
  branch: 0.15,
  slower: 0.2,
  edge: 0.25,
  target: 0.3,
  "joint-move": 0.4,
  detour: 0.8,
  zone: 0.3,
};
/** Moving the robot is more than moving a part by as much. */
const BASE_EFFORT = 0.5;
/** Turning the tool over several steps is more than over one, by this much a step. */
const EACH_STEP = 0.1;
const MOST_SHIFT_M = 1;
/** Moves that a shift of robot or part is tried on before the program is checked: evenly spread over all. */
const MOST_TRIED = 200;
/** A posture this near to home goes wherever home is [rad]. */
const SAME_RAD = 1e-6;

/** Ways out that the check itself offered, without the turns and shifts that are searched for here more finely. */
export function offered({ finding, others }: RepairScene): readonly Candidate[] {
  const coarse: readonly (RepairKind | undefined)[] = finding.code.startsWith("collision.")
    ? []
    : ["spin", "tilt", "target", "part", "base"];
  const edges = others.flatMap(({ repairs }) => repairs.filter(({ kind }) => kind === "edge"));
  return [...finding.repairs, ...edges].flatMap((repair): Candidate[] => {
    const { kind } = repair;
    if (kind === undefined || coarse.includes(kind)) return [];
    return [{ repair: { ...repair, kind }, amount: 1, unit: "1", effort: EFFORT[kind] ?? 0.5 }];
  });
}

/** A taught joint angle brought back inside its limit. */
export function jointInside({ step, finding, robot }: RepairScene): readonly Candidate[] {
  const { target } = step;
  if (finding.code !== "limits.joint" || finding.joint === undefined || !("q" in target)) return [];
  const joint = robot.arm.joints[finding.joint - 1]!;
  const taught = target.q[finding.joint - 1]!;
  const { lower_rad, upper_rad } = joint.limits;
  const room = (isSlide(joint) ? 0.057 : 1) * REPAIR_ROOM_RAD;
  if (taught >= lower_rad && taught <= upper_rad) return [];
  const inside = taught > upper_rad ? upper_rad - room : lower_rad + room;
  const amount = Math.abs(inside - taught);
  return [
    {
      repair: {
        kind: "joint",
        sentence: `Bring joint ${finding.joint} back to ${jointText(joint, inside)}.`,
        replace: { ...step, target: { ...target, q: target.q.with(finding.joint - 1, inside) } },
      },
      amount,
      unit: isSlide(joint) ? "m" : "rad",
      effort: amount / (isSlide(joint) ? 0.25 : radians(30)),
    },
  ];
}

/** The steps a turn of the tool is tried on, the fewest first. */
export function scopesOf({ program, moves, step }: RepairScene): readonly (readonly string[])[] {
  const own = moves.find(({ written }) => written === step.id);
  const before = own?.before?.written;
  const straight = step.path !== "ptp" && before !== undefined && before !== step.id;
  const group =
    step.group === undefined
      ? []
      : [...new Set(moves.filter(({ move }) => move.step.group === step.group).map(({ written }) => written))];
  const scopes = [[step.id], ...(straight ? [[before, step.id]] : []), ...(group.length > 1 ? [group] : [])];
  return scopes.filter(ids => ids.every(id => stepById(program, id)?.type === "move"));
}

/** The least spin or tilt of the tool at the given steps; a generator, because the next larger one may be asked for. */
export function* toolTurns(scene: RepairScene, kind: "spin" | "tilt", ids: readonly string[]): Generator<Candidate> {
  const search = kind === "spin" ? SPIN : TILT;
  const has = (step: string): boolean => ids.includes(step);
  const tried = tryFirst(scene, affected(scene.moves, has));
  const change = (id: string, by: PoseChange): MoveStep | undefined => {
    const step = stepById(scene.program, id);
    const turn = toolTurn(by);
    return step?.type === "move" && turn !== undefined ? turned(step, turn, scene) : undefined;
  };
  for (const least of leasts(search, by => (tried.every(move => scene.fit.fits(move, by, has)) ? 0 : Infinity))) {
    const { change: by, amount } = least;
    if (by.kind === "shift") return;
    const steps = ids.flatMap(id => change(id, by) ?? []);
    const replace = steps.find(({ id }) => id === scene.step.id);
    if (replace === undefined) return;
    const rest = steps.filter(each => each !== replace);
    yield {
      repair: {
        kind,
        sentence: rest.length === 0 ? turnWords(by) : `${turnWords(by).slice(0, -1)}, at ${ids.length} points.`,
        replace,
        ...(rest.length === 0 ? {} : { alsoReplace: rest }),
      },
      amount,
      unit: "rad",
      effort: effortOf(by) * (1 + EACH_STEP * (ids.length - 1)),
    };
  }
}

/** The least shift of the point of one step. */
export function* targetShifts(scene: RepairScene): Generator<Candidate> {
  const { step, program } = scene;
  const { target } = step;
  if ("pose" in target && Object.hasOwn(program.pallets, target.frame)) return;
  const has = (id: string): boolean => id === step.id;
  for (const { by_m, amount } of shifts(scene, has, 1, MOST_SHIFT_M, scene.fit)) {
    yield {
      repair: {
        kind: "target",
        sentence: `Move the point ${shiftWords(by_m, placeOf(scene))}.`,
        replace: { ...step, target: shifted(target, by_m, scene) },
      },
      amount,
      unit: "m",
      effort: effortOf({ kind: "shift", by_m }),
    };
  }
}

/** The frame of the program that the step's point was taught in. */
export function partOf({ moves, program, step }: RepairScene): string | undefined {
  const target = moves.find(({ written }) => written === step.id)?.move.step.target;
  if (target === undefined || !("pose" in target) || target.frame === "world") return undefined;
  return Object.hasOwn(program.frames, target.frame) ? target.frame : undefined;
}

/** The least shift of what the step was taught on: its frame, with every point in it. */
export function* partShifts(scene: RepairScene, nameOf: (frame: string) => string): Generator<Candidate> {
  const frame = partOf(scene);
  if (frame === undefined) return;
  const along = scene.framesOf(frame);
  const inFrame = new Set(
    scene.moves.flatMap(({ move, written }) =>
      "pose" in move.step.target && along.includes(move.step.target.frame) ? [written] : [],
    ),
  );
  for (const { by_m, amount } of shifts(scene, id => inFrame.has(id), 1, MOST_SHIFT_M, scene.postures)) {
    yield {
      repair: {
        kind: "part",
        sentence: `Move “${nameOf(frame)}” ${shiftWords(by_m, placeOf(scene))}.`,
        moveFrame: { frame, by_m },
      },
      amount,
      unit: "m",
      effort: effortOf({ kind: "shift", by_m }),
    };
  }
}

/** The least shift of the robot, where every point stays where it is in the world. */
export function* baseShifts(scene: RepairScene): Generator<Candidate> {
  if (!movable(scene)) return;
  for (const { by_m, amount } of shifts(scene, () => true, -1, MOST_SHIFT_M, scene.postures)) {
    yield {
      repair: {
        kind: "base",
        sentence: `Move the robot ${axisWords(by_m)}.`,
        moveBase: { by_m },
      },
      amount,
      unit: "m",
      effort: BASE_EFFORT + effortOf({ kind: "shift", by_m }),
    };
  }
}

/** Joint angles go with the robot: only home may be taught so. */
export const movable = ({ moves, robot }: Pick<RepairScene, "moves" | "robot">): boolean =>
  moves.every(
    ({ move: { q_rad } }) =>
      q_rad === undefined || robot.home_rad.every((home, j) => Math.abs(home - q_rad[j]!) <= SAME_RAD),
  );

/**
 * Shifts in the world, level or up and down, the least first.
 *
 * @param has   the steps whose points move. @param sign  −1 where the robot is moved and the points seem to go back.
 */
function* shifts(
  scene: RepairScene,
  has: (step: string) => boolean,
  sign: 1 | -1,
  most_m: number,
  fit: PathFit,
): Generator<{ readonly by_m: Vector3; readonly amount: number }> {
  const { worldFromBase } = scene;
  const place = placeOf(scene);
  const baseFromWorld = conjugate(worldFromBase.quaternion);
  // The robot stays on its floor, and at home nothing of it moves.
  const tried = tryFirst(scene, affected(scene.moves, has)).filter(
    ({ move, written }) => !(sign < 0 && move.q_rad !== undefined && written !== scene.step.id),
  );
  const miss = (change: PoseChange): number => {
    if (change.kind !== "shift") return Infinity;
    const [x, y, z] = change.by_m;
    const inBase: PoseChange = { kind: "shift", by_m: rotate(baseFromWorld, [sign * x, sign * y, sign * z]) };
    return tried.every(move => fit.fits(move, inBase, has)) ? 0 : Infinity;
  };
  const own = tried.find(({ written }) => written === scene.step.id);
  const from = own === undefined ? 0 : missing(scene.robot, own.move.baseFromFlange);
  const outward = Math.atan2(place[1], place[0]);
  const level = levelShift(outward, most_m);
  const both = sign < 0 ? [level] : [level, { ...LIFT, most: Math.min(LIFT.most, most_m) }];
  const next = both.map(search => leasts(search, miss, from));
  const waiting = next.map(one => one.next().value);
  for (;;) {
    const at = waiting.reduce(
      (best, one, i) => (one && (best < 0 || one.amount < waiting[best]!.amount) ? i : best),
      -1,
    );
    const least = at < 0 ? undefined : waiting[at];
    if (least?.change.kind !== "shift") return;
    yield { by_m: least.change.by_m, amount: least.amount };
    waiting[at] = next[at]!.next().value;
  }
}

/** How many times more is tried where the program's check says that the least is not enough. */
const MORE = [1, 1.15, 1.5];

function* leasts(
  search: ChangeSearch,
  miss: Miss,
  from = 0,
): Generator<{ readonly change: PoseChange; readonly amount: number }, undefined> {
  let last: number | undefined;
  for (const more of MORE) {
    const least = leastChange(search, miss, last === undefined ? from : last * more);
    if (least === undefined) return undefined;
    yield least;
    last = least.amount;
  }
  return undefined;
}

/** Moves whose own points change, and those that begin where such a move ends. */
const affected = (moves: readonly PlacedMove[], has: (step: string) => boolean): readonly PlacedMove[] =>
  moves.filter(
    ({ written, before, move }) =>
      has(written) || (before !== undefined && has(before.written) && move.step.path !== "ptp"),
  );

/** The bad step's own moves first: most changes fail there. */
function tryFirst({ step }: RepairScene, moves: readonly PlacedMove[]): readonly PlacedMove[] {
  const own = moves.filter(({ written }) => written === step.id);
  const rest = moves.filter(({ written }) => written !== step.id);
  const every = Math.max(1, rest.length / MOST_TRIED);
  return [...own, ...Array.from({ length: Math.min(rest.length, MOST_TRIED) }, (_, i) => rest[Math.floor(i * every)]!)];
}

/** Where the step's point is, seen from the base, in directions of the world. */
function placeOf({ moves, step, worldFromBase }: RepairScene): Vector3 {
  const own = moves.find(({ written }) => written === step.id);
  return inWorld(worldFromBase, own?.move.baseFromTcp.position ?? [1, 0, 0]);
}

/** The step with its tool turned: a point taught as joint angles becomes the pose they reach. */
function turned(step: MoveStep, turn: Pose<"tcp", "tcp">, scene: RepairScene): MoveStep {
  const of = (target: Target): Target => {
    const { pose, frame, tool } = asPose(target, scene);
    return { pose: compose(pose, turn), frame, tool };
  };
  return { ...step, target: of(step.target), ...(step.via === undefined ? {} : { via: of(step.via) }) };
}

function shifted(target: Target, by_m: Vector3, scene: RepairScene): Target {
  const { pose, frame, tool } = asPose(target, scene);
  const worldFromFrame = scene.program.frames[frame] ?? identity();
  const inFrame = rotate(conjugate(worldFromFrame.quaternion), by_m);
  const [x, y, z] = pose.position;
  return {
    pose: { position: [x + inFrame[0], y + inFrame[1], z + inFrame[2]], quaternion: pose.quaternion },
    frame,
    tool,
  };
}

/** A target as a pose; joint angles as what they reach, in the world. */
function asPose(target: Target, { robot, context, worldFromBase }: RepairScene): Extract<Target, { pose: unknown }> {
  if ("pose" in target) return target;
  const pose = compose(worldFromBase, targetInBase(target, robot, context));
  return {
    pose: pose as Pose as Pose<"frame", "tcp">,
    frame: "world",
    tool: target.tool ?? "flange",
  };
}
