import {
  conjugate, flangePose, identity, jacobian, jogScratch, jogStep, multiply, singularValues, toUrVector, type JogCell, type JogCommand, type Random, type Robot, type Vector3,
} from "../../index.ts";

const DT = 1 / 60;
/** A jog counts from this share of its way on; farther out another singularity or a limit may end it, which is not this one's doing. */
const LEFT = 0.1;
/** The joint whose turning makes the arm singular: 2 brings the wrist over axis 1, 3 stretches or folds the arm, 5 straightens the wrist. */
export type SingularJoint = 2 | 3 | 5;
export interface SingularJogs { readonly jogs: number; readonly left: number; readonly arrived: number; readonly notNumbers: number; readonly tooFast: number; readonly outside: number; readonly stuck: readonly string[] }

/**
 * Random jogs into a singularity and out of it again. Each: a posture exactly on it, found by the sign of det J along one joint; a
 * jog towards it from a posture beside it; and from the singular posture itself a jog towards another posture beside it.
 */
export function singularJogs(robot: Robot, joint: SingularJoint, jogs: number, random: Random): SingularJogs {
  const { arm } = robot, cell: JogCell = { robot, worldFromBase: identity(), flangeFromTcp: identity() };
  let left = 0, arrived = 0, notNumbers = 0, tooFast = 0, outside = 0;
  const stuck: string[] = [], limits = arm.joints.map(each => each.limits);
  const run = (q: Float64Array, goal: Float64Array): number => {
    const from = flangePose(arm, q), to = flangePose(arm, goal), shift = to.position.map((value, i) => value - from.position[i]!) as Vector3;
    const turn = toUrVector(multiply(to.quaternion, conjugate(from.quaternion))), takes_s = (Math.hypot(...shift) + Math.hypot(...turn)) / 0.3, scratch = jogScratch();
    const command: JogCommand = { kind: "tip", linear_mps: shift.map(value => value / takes_s) as Vector3, angular_rad_s: turn.map(value => value / takes_s) as Vector3, frame: "world" };
    let done_s = 0, why = "";
    for (let frame = 0; frame < 400 && done_s < 0.5 * takes_s; frame++) {
      const before = q.slice(), jogged = jogStep(cell, q, command, DT, q, scratch);
      if (!q.every(Number.isFinite)) notNumbers++;
      if (limits.some(({ speed_rad_s }, j) => Math.abs(q[j]! - before[j]!) > speed_rad_s * DT * (1 + 1e-9))) tooFast++;
      if (limits.some(({ lower_rad, upper_rad }, j) => q[j]! < lower_rad - 1e-8 || q[j]! > upper_rad + 1e-8)) outside++;
      why = jogged.blocked[0]?.sentence ?? "still turning";
      if (jogged.kind === "blocked") break;
      done_s += jogged.fraction * DT;
    }
    if (done_s / takes_s < LEFT) stuck.push(`${(done_s / takes_s).toFixed(3)} of the way, ${[...q].map(angle => angle.toFixed(4)).join(", ")}: ${why}`);
    return done_s / takes_s;
  };
  for (let count = 0; count < jogs;) {
    const on = singularPosture(robot, joint, random);
    if (on === null) continue;
    count++;
    const beside = (): Float64Array => on.map(angle => angle + 0.3 * (random() - 0.5)), into = beside();
    const reached = stuck.length;
    if (run(into, on) >= LEFT) arrived++; else stuck.length = reached; // a way in may be cut off by a limit; the way out may not
    if (run(on.slice(), beside()) >= LEFT) left++;
  }
  return { jogs, left, arrived, notNumbers, tooFast, outside, stuck };
}

/** A posture well inside the limits in which exactly one direction is lost; null when turning that joint meets none. */
function singularPosture({ arm }: Robot, joint: SingularJoint, random: Random): Float64Array | null {
  const inner = arm.joints.map(({ limits }) => ({ lower: Math.max(-Math.PI, limits.lower_rad), upper: Math.min(Math.PI, limits.upper_rad) }));
  const q = Float64Array.from(inner, ({ lower, upper }) => (lower + upper) / 2 + 0.75 * (upper - lower) * (random() - 0.5)), scan = joint - 1, first = q[scan]!;
  const at = (angle: number): number => { q[scan] = angle; return determinant(jacobian(arm, q)); };
  for (let angle = first, before = at(first); angle < Math.min(first + 3, inner[scan]!.upper - 0.3); angle += 0.05) {
    const now = at(angle);
    if (before * now < 0) {
      let a = angle - 0.05, b = angle;
      for (let k = 0; k < 60; k++) { const middle = (a + b) / 2; if (at(middle) * now < 0) a = middle; else b = middle; }
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
    if (pivot !== i) { const row = a[i]!; a[i] = a[pivot]!; a[pivot] = row; product = -product; }
    if (a[i]![i] === 0) return 0;
    product *= a[i]![i]!;
    for (let r = i + 1; r < 6; r++) for (let c = 5; c >= i; c--) a[r]![c]! -= (a[r]![i]! / a[i]![i]!) * a[i]![c]!;
  }
  return product;
}
