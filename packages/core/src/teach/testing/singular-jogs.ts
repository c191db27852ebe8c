import {
  allBranches,
  angleBetween,
  conjugate,
  distance,
  flangePose,
  fromUrVector,
  identity,
  jacobian,
  jogScratch,
  jogStep,
  multiply,
  singularValues,
  toUrVector,
  wrapAngle,
  type JogCell,
  type JogCommand,
  type Pose,
  type Random,
  type Reach,
  type Robot,
  type Vector3,
} from "../../index.ts";

const DT = 1 / 60;
/** A jog is followed over this share of its way: farther out it has nothing to do with the singularity any more. */
const FOLLOWED = 0.5;
/** One that another joint's limit stops has left only after this share of its way. */
const AWAY = 0.01;
/** As long as this it may turn in place and slow down. */
const FRAMES = 600;
/** How far the tip may stray from the straight way [m, rad] where nothing was blocked. */
const STRAYS = 1e-6;
/**
 * At one of these shares farther on, up to a frame's, no posture may exist where a jog was stopped by the end of the
 * reach, with joints 1, 2, 3 and 5 so near to where it stopped [rad].
 */
const FARTHER = Array.from({ length: 60 }, (_, k) => 5e-5 * 1.115 ** k);
const NEAR_RAD = 0.2;
/**
 * The joint whose turning makes the arm singular: 2 brings the wrist over axis 1, 3 stretches or folds the arm, 5
 * straightens the wrist.
 */
export type SingularJoint = 2 | 3 | 5;
/**
 * What became of the jogs. A jog out has `left` when it moved on without a pause until half of its way was done
 * (`through`), or until another joint's limit stopped it away from the singularity, or the end of the reach anywhere (a
 * stretched arm cannot be pulled longer): then `allBranches` finds no posture a little farther on anywhere near
 * (`explained`). One that a joint's limit, named, keeps from turning in place far enough is `limited`. All others are
 * `stuck`.
 */
export interface SingularJogs {
  readonly jogs: number;
  readonly left: number;
  readonly through: number;
  readonly explained: number;
  readonly limited: number;
  readonly arrived: number;
  readonly notNumbers: number;
  readonly tooFast: number;
  readonly outside: number;
  readonly strayed: number;
  readonly stuck: readonly Stuck[];
  /** Of one frame that moves [ms]: the median and the longest. */
  readonly frame_ms: { readonly median: number; readonly longest: number };
}
export interface Stuck {
  readonly share: number;
  readonly start: readonly number[];
  readonly goal: readonly number[];
  readonly end: readonly number[];
  readonly why: string;
}
type Outcome = "through" | "explained" | "limited" | Stuck;

/**
 * Random jogs into a singularity and out of it again. Each: a posture exactly on it, found by the sign of det J along
 * one joint; a jog towards it from a posture beside it; and from the singular posture itself a jog towards another
 * posture beside it.
 *
 * @param clock_ms  for the time a frame takes; without one it is 0.
 */
export function singularJogs(
  robot: Robot,
  joint: SingularJoint,
  jogs: number,
  random: Random,
  clock_ms: () => number = () => 0,
): SingularJogs {
  const { arm } = robot;
  const cell: JogCell = { robot, worldFromBase: identity(), flangeFromTcp: identity() };
  let through = 0;
  let explained = 0;
  let limited = 0;
  let arrived = 0;
  let notNumbers = 0;
  let tooFast = 0;
  let outside = 0;
  let strayed = 0;
  const stuck: Stuck[] = [];
  const limits = arm.joints.map(each => each.limits);
  const times_ms: number[] = [];
  const scratch = jogScratch();
  const run = (q: Float64Array, goal: Float64Array): Outcome => {
    const start = [...q];
    const from = flangePose(arm, q);
    const to = flangePose(arm, goal);
    const shift = to.position.map((value, i) => value - from.position[i]!) as Vector3;
    const turn = toUrVector(multiply(to.quaternion, conjugate(from.quaternion)));
    const takes_s = (Math.hypot(...shift) + Math.hypot(...turn)) / 0.3;
    const command: JogCommand = {
      kind: "tip",
      linear_mps: shift.map(value => value / takes_s) as Vector3,
      angular_rad_s: turn.map(value => value / takes_s) as Vector3,
      frame: "world",
    };
    let done_s = 0;
    let why = "The joints were still turning in place.";
    let reason: Reach | undefined;
    for (let frame = 0; frame < FRAMES && done_s < FOLLOWED * takes_s; frame++) {
      const before = q.slice();
      const began_ms = clock_ms();
      const jogged = jogStep(cell, q, command, DT, q, scratch);
      times_ms.push(clock_ms() - began_ms);
      if (!q.every(Number.isFinite)) notNumbers++;
      if (limits.some(({ speed_rad_s }, j) => Math.abs(q[j]! - before[j]!) > speed_rad_s * DT * (1 + 1e-9))) tooFast++;
      if (limits.some(({ lower_rad, upper_rad }, j) => q[j]! < lower_rad - 1e-8 || q[j]! > upper_rad + 1e-8)) outside++;
      const block = jogged.blocked[0];
      if (jogged.kind === "moved") done_s += jogged.fraction * DT;
      // A coordinate that stops is where this jog ends: what goes on beside it is another way.
      if (block !== undefined) {
        why = block.sentence;
        reason = block.reach;
        break;
      }
    }
    const share = done_s / takes_s;
    const placeAt = (part: number): Pose<"base", "flange"> => ({
      position: shift.map((value, i) => from.position[i]! + part * value) as Vector3,
      quaternion: multiply(fromUrVector(...(turn.map(value => value * part) as Vector3)), from.quaternion),
    });
    if (reason === undefined) {
      const is = flangePose(arm, q);
      const should = placeAt(share);
      if (distance(is.position, should.position) > STRAYS || angleBetween(is.quaternion, should.quaternion) > STRAYS)
        strayed++;
    }
    if (share >= FOLLOWED) return "through";
    const goesOn = (part: number): boolean =>
      allBranches(robot, placeAt(part)).some(other =>
        [0, 1, 2, 4].every(j => Math.abs(wrapAngle(other[j]! - q[j]!)) < NEAR_RAD),
      );
    if (reason?.kind === "outside-limits") return share >= AWAY ? "explained" : "limited";
    if (reason !== undefined && FARTHER.some(more => !goesOn(share + more))) return "explained";
    return { share, start, goal: [...goal], end: [...q], why };
  };
  for (let count = 0; count < jogs; ) {
    const on = singularConfiguration(robot, joint, random);
    if (on === null) continue;
    count++;
    const beside = (): Float64Array => on.map(angle => angle + 0.3 * (random() - 0.5));
    const into = beside();
    if (typeof run(into, on) === "string") arrived++; // a way in may be cut off by a limit; the way out may not
    const out = run(on.slice(), beside());
    if (out === "through") through++;
    else if (out === "explained") explained++;
    else if (out === "limited") limited++;
    else stuck.push(out);
  }
  times_ms.sort((a, b) => a - b);
  return {
    jogs,
    left: through + explained,
    through,
    explained,
    limited,
    arrived,
    notNumbers,
    tooFast,
    outside,
    strayed,
    stuck,
    frame_ms: { median: times_ms[times_ms.length >> 1]!, longest: times_ms.at(-1)! },
  };
}

/** A posture well inside the limits in which exactly one direction is lost; null when turning that joint meets none. */
function singularConfiguration({ arm }: Robot, joint: SingularJoint, random: Random): Float64Array | null {
  const inner = arm.joints.map(({ limits }) => ({
    lower: Math.max(-Math.PI, limits.lower_rad),
    upper: Math.min(Math.PI, limits.upper_rad),
  }));
  const q = Float64Array.from(
    inner,
    ({ lower, upper }) => (lower + upper) / 2 + 0.75 * (upper - lower) * (random() - 0.5),
  );
  const scan = joint - 1;
  const first = q[scan]!;
  const at = (angle: number): number => {
    q[scan] = angle;
    return determinant(jacobian(arm, q));
  };
  for (let angle = first, before = at(first); angle < Math.min(first + 3, inner[scan]!.upper - 0.3); angle += 0.05) {
    const now = at(angle);
    if (before * now < 0) {
      let a = angle - 0.05;
      let b = angle;
      for (let k = 0; k < 60; k++) {
        const middle = (a + b) / 2;
        if (at(middle) * now < 0) a = middle;
        else b = middle;
      }
      q[scan] = a;
      return singularValues(jacobian(arm, q))[4]! > 0.02 ? q : null;
    }
    before = now;
  }
  return null;
}

/** Determinant of a 6 × 6 matrix by elimination with pivots. */
function determinant(rows: Float64Array): number {
  const a = Array.from({ length: 6 }, (_, r) => [...rows.slice(6 * r, 6 * r + 6)]);
  let product = 1;
  for (let i = 0; i < 6; i++) {
    let pivot = i;
    for (let r = i + 1; r < 6; r++) if (Math.abs(a[r]![i]!) > Math.abs(a[pivot]![i]!)) pivot = r;
    if (pivot !== i) {
      const row = a[i]!;
      a[i] = a[pivot]!;
      a[pivot] = row;
      product = -product;
    }
    if (a[i]![i] === 0) return 0;
    product *= a[i]![i]!;
    for (let r = i + 1; r < 6; r++) for (let c = 5; c >= i; c--) a[r]![c]! -= (a[r]![i]! / a[i]![i]!) * a[i]![c]!;
  }
  return product;
}
