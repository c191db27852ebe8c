import { JointCountFault } from "../../fault.ts";
import type { Random } from "../../random.ts";
import type { SerialArm } from "../../model/arm.ts";
import { isSlide, jointText } from "../../model/slide.ts";
import type { Pose } from "../../spatial/pose.ts";
import { degrees } from "../../spatial/units.ts";
import { dampedScratch, type DampedScratch } from "./damped-scratch.ts";
import { descend, type Descent } from "./descend.ts";
import { flawOfPose, lengthOfArm } from "./pose-error.ts";

export { dampedScratch, type DampedScratch } from "./damped-scratch.ts";

export interface DampedOptions {
  /** What counts as met [m, rad]; 1e-9 unless said. */
  readonly position_m?: number;
  readonly angle_rad?: number;
  /** Steps of one descent; 200 unless said. */
  readonly steps?: number;
  /** Further starts, drawn evenly from inside the limits, where the first one stalls. */
  readonly restarts?: { readonly most: number; readonly random: Random };
}

/** What keeps a descent from its target. */
export type Stall =
  /** The joint (from 1) that the target presses hardest against its limit. */
  | { readonly kind: "limit"; readonly joint: number; readonly limit_rad: number; readonly slides?: boolean }
  /** With any orientation at all the flange stays this far away. */
  | { readonly kind: "too-far"; readonly short_m: number }
  /** The place can be had, but not this orientation there, from this start. */
  | { readonly kind: "local-minimum" }
  | { readonly kind: "out-of-steps"; readonly steps: number };

/**
 * Where a numeric method ended. q lies inside the limits; the errors are those of its flange. `starts` counts the first
 * one.
 */
interface Ended {
  readonly q_rad: Float64Array;
  readonly iterations: number;
  readonly starts: number;
  readonly position_m: number;
  readonly angle_rad: number;
}
export type NumericReach =
  | (Ended & { readonly kind: "converged" })
  | (Ended & { readonly kind: "stalled"; readonly because: Stall })
  | { readonly kind: "not-a-pose"; readonly because: string };

const AIM = { position_m: 1e-9, angle_rad: 1e-9, steps: 200 } as const;
/** 1 rad counts as this share of the arm's length. */
const TURN_SHARE = 0.3;
/** Nearer than this [m] the place counts as reached when a stall is explained. */
const SAME_PLACE_M = 1e-6;

/**
 * Joint angles of any chain for a pose of the flange, from a start posture, by damped least squares inside the joint
 * limits; or why it stalled and how near it came.
 *
 * @param q0       n angles [rad] to start from; brought inside the limits first. Read only.
 * @param scratch  made for n joints; with it the call allocates nothing but its answer.
 * @throws {JointCountFault} when `q0` does not hold n angles.
 * @see descend for the equation.
 */
export function solveDamped(
  arm: SerialArm,
  baseFromFlange: Pose<"base", "flange">,
  q0: ArrayLike<number>,
  options: DampedOptions = {},
  scratch: DampedScratch = dampedScratch(arm.joints.length),
): NumericReach {
  const because = flawOfPose(baseFromFlange) ?? flawOfStart(arm, q0);
  if (because !== undefined) return { kind: "not-a-pose", because };
  const aim: Descent = { ...AIM, turnWeight_m: TURN_SHARE * lengthOfArm(arm), ...given(options) };
  const { q, best } = scratch;
  let least = Infinity;
  let position_m = 0;
  let angle_rad = 0;
  let iterations = 0;
  let starts = 0;
  let ranOut = false;
  for (const most = 1 + (options.restarts?.most ?? 0); starts < most; ) {
    if (starts === 0) for (let j = 0; j < q.length; j++) q[j] = q0[j]!;
    else drawConfiguration(arm, options.restarts!.random, q);
    const met = descend(arm, baseFromFlange, aim, scratch);
    starts++;
    iterations += scratch.iterations;
    if (met)
      return {
        kind: "converged",
        q_rad: q.slice(),
        iterations,
        starts,
        position_m: scratch.position_m,
        angle_rad: scratch.angle_rad,
      };
    const miss = scratch.position_m + aim.turnWeight_m * scratch.angle_rad;
    if (miss < least) {
      least = miss;
      best.set(q);
      position_m = scratch.position_m;
      angle_rad = scratch.angle_rad;
      ranOut = scratch.iterations >= aim.steps;
    }
  }
  const q_rad = best.slice();
  const stall: Stall = ranOut
    ? { kind: "out-of-steps", steps: aim.steps }
    : whyStalled(arm, baseFromFlange, aim, scratch);
  return { kind: "stalled", because: stall, q_rad, iterations, starts, position_m, angle_rad };
}

/**
 * As `solveDamped` for frame loops: the posture found from `near`, without an answer to allocate.
 *
 * @param out      receives n angles; untouched when there is none. May be `near`.
 * @param scratch  made for n joints. Allocates nothing.
 * @returns whether the pose is met to 1e-9 (m, rad). `solveDamped` tells why not.
 */
export function nearestDamped(
  arm: SerialArm,
  baseFromFlange: Pose<"base", "flange">,
  near: ArrayLike<number>,
  out: Float64Array,
  scratch: DampedScratch,
): boolean {
  if (flawOfPose(baseFromFlange) !== undefined || flawOfStart(arm, near) !== undefined) return false;
  for (let j = 0; j < scratch.q.length; j++) scratch.q[j] = near[j]!;
  frameAim.turnWeight_m = TURN_SHARE * lengthOfArm(arm);
  if (!descend(arm, baseFromFlange, frameAim, scratch)) return false;
  out.set(scratch.q);
  return true;
}
const frameAim = { ...AIM, turnWeight_m: 0 };

/** One sentence that says how it ended: subject, fact, number with unit. */
export function explainNumeric(reach: NumericReach): string {
  switch (reach.kind) {
    case "converged":
      return `The pose is met after ${reach.iterations} steps.`;
    case "not-a-pose":
      return reach.because;
    case "stalled": {
      const left = `${millimetresOf(reach.position_m)} and ${degrees(reach.angle_rad).toFixed(1)}° are left`;
      const { because } = reach;
      switch (because.kind) {
        case "limit":
          return `Joint ${because.joint} stands at its limit of ${jointText({ kind: because.slides === true ? "prismatic" : "revolute" }, because.limit_rad)}; ${left}.`;
        case "too-far":
          return `The flange stays ${millimetresOf(because.short_m)} away, whatever its orientation; the arm is not long enough.`;
        case "local-minimum":
          return `No small motion of the joints comes nearer; ${left}. Another start may.`;
        case "out-of-steps":
          return `After ${because.steps} steps ${left}.`;
      }
    }
  }
}
const millimetresOf = (length_m: number): string => `${(length_m * 1000).toFixed(length_m < 0.01 ? 1 : 0)} mm`;

/** Tries the place alone from where the best descent ended; what presses there, or at the end itself, is the reason. */
function whyStalled(arm: SerialArm, wanted: Pose<"base", "flange">, aim: Descent, scratch: DampedScratch): Stall {
  scratch.q.set(scratch.best);
  const limit = hardestLimit(arm, wanted, aim, scratch);
  const placed = descend(arm, wanted, { ...aim, position_m: SAME_PLACE_M, turnWeight_m: 0 }, scratch);
  const short_m = scratch.position_m;
  if (!placed && !scratch.pressed.includes(1)) return { kind: "too-far", short_m };
  return limit ?? { kind: "local-minimum" };
}

/** The limit that is pressed hardest where the posture stands now. */
function hardestLimit(
  arm: SerialArm,
  wanted: Pose<"base", "flange">,
  aim: Descent,
  scratch: DampedScratch,
): Stall | undefined {
  descend(arm, wanted, { ...aim, steps: 0 }, scratch);
  let hardest = -1;
  let push = 0;
  for (let j = 0; j < scratch.pressed.length; j++)
    if (scratch.pressed[j] === 1 && Math.abs(scratch.uphill[j]!) > push) {
      push = Math.abs(scratch.uphill[j]!);
      hardest = j;
    }
  if (hardest < 0) return undefined;
  const joint = arm.joints[hardest]!;
  const { lower_rad, upper_rad } = joint.limits;
  return {
    kind: "limit",
    joint: hardest + 1,
    limit_rad: scratch.uphill[hardest]! > 0 ? upper_rad : lower_rad,
    ...(isSlide(joint) ? { slides: true } : {}),
  };
}

function drawConfiguration(arm: SerialArm, random: Random, out: Float64Array): void {
  for (let j = 0; j < out.length; j++) {
    const { lower_rad, upper_rad } = arm.joints[j]!.limits;
    out[j] = lower_rad + (upper_rad - lower_rad) * random();
  }
}

function flawOfStart(arm: SerialArm, q0: ArrayLike<number>): string | undefined {
  if (q0.length !== arm.joints.length) throw new JointCountFault(arm.name, arm.joints.length, q0.length);
  for (let j = 0; j < q0.length; j++)
    if (!Number.isFinite(q0[j]!)) return `The start angle of joint ${j + 1} is not a finite number.`;
  return undefined;
}

const given = ({ position_m, angle_rad, steps }: DampedOptions): Partial<Descent> => ({
  ...(position_m === undefined ? {} : { position_m }),
  ...(angle_rad === undefined ? {} : { angle_rad }),
  ...(steps === undefined ? {} : { steps }),
});
