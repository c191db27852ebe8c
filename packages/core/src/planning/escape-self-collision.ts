import type { SolidPair } from "../collision/cell-collider.ts";
import { isSlide } from "../model/slide.ts";
import { findPath, lengthOf, type PathOptions, type PathOutcome } from "./find-path.ts";
import { alongLine, distanceBetween, type PathValidator } from "./path-validator.ts";

/** How a target was reached: straight, by turning a joint the other way round, by backing out first, or by a search. */
export type SelfCollisionEscape =
  | {
      readonly kind: "found";
      readonly how: "straight" | "other way round" | "back first" | "searched";
      readonly way: readonly Float64Array[];
      readonly length_rad: number;
    }
  | Exclude<PathOutcome, { readonly kind: "found" }>;

/** How far a joint backs out, the least first [rad]. */
const BACKS_RAD = [0.2, 0.5, 1, 1.6, 2.5, 3.1] as const;
/** Whole turns more or less at most, of so many joints at once. */
const MOST_TWINS = 12;
/**
 * Samples that find out most of what is blocked before a proof is tried [rad], and how long such a proof may take:
 * there are other ways to try.
 */
const STEP_RAD = 0.1;
const MOST_CHECKS = 400;

/**
 * Leads an arm that would run into itself, or into something, to its target all the same (row X-28): the same target
 * with joints turned the other way round, where the limits allow it; else the joint that drives the contact first turns
 * back by some angle; else a search. Every line of the answer is proven free.
 */
export function escapeSelfCollision(
  checker: PathValidator,
  from: ArrayLike<number>,
  to: ArrayLike<number>,
  options: PathOptions = {},
): SelfCollisionEscape {
  const start = Float64Array.from(from);
  const goal = Float64Array.from(to);
  const clear = (a: Float64Array, b: Float64Array): boolean =>
    checker.sampled(a, b, STEP_RAD) && checker.prove(a, b, MOST_CHECKS).kind === "clear";
  const found = (
    how: Extract<SelfCollisionEscape, { kind: "found" }>["how"],
    way: readonly Float64Array[],
  ): SelfCollisionEscape => ({
    kind: "found",
    how,
    way,
    length_rad: lengthOf(way),
  });
  const search = (): SelfCollisionEscape => {
    const answer = findPath(checker, start, goal, options);
    return answer.kind === "found" ? found("searched", answer.way) : answer;
  };
  if (!checker.free(start) || !checker.free(goal)) return search();
  const direct = checker.prove(start, goal, 2 * MOST_CHECKS);
  if (direct.kind === "clear") return found("straight", [start, goal]);
  for (const twin of twins(checker, start, goal))
    if (checker.free(twin) && clear(start, twin)) return found("other way round", [start, twin]);
  if (direct.kind === "contact") {
    const pair = checker.collider.pairs.find(({ contact }) => contact.a === direct.a && contact.b === direct.b);
    if (pair !== undefined) {
      const before = alongLine(start, goal, Math.max(0, direct.at - 0.05), new Float64Array(start.length));
      const turns = drivers(checker, pair, start, goal, direct.at);
      for (const back_rad of BACKS_RAD)
        for (const { joint, away } of turns) {
          const { lower_rad, upper_rad } = checker.arm.joints[joint]!.limits;
          for (const foot of [start, before]) {
            const via = foot.slice();
            via[joint] = via[joint]! + away * back_rad;
            if (via[joint]! < lower_rad || via[joint]! > upper_rad || !checker.free(via)) continue;
            if (clear(start, via) && clear(via, goal)) return found("back first", [start, via, goal]);
          }
        }
    }
  }
  return search();
}

/**
 * The same posture with joints a whole turn on or back, inside the limits, the least travel first; the goal itself is
 * not among them.
 */
function twins({ arm: { joints } }: PathValidator, start: Float64Array, goal: Float64Array): Float64Array[] {
  let all = [goal];
  for (let k = 0; k < goal.length; k++) {
    const joint = joints[k]!;
    if (isSlide(joint)) continue;
    const { lower_rad, upper_rad } = joint.limits;
    all = all
      .flatMap(q =>
        [0, 2 * Math.PI, -2 * Math.PI].flatMap(turn => {
          const angle = q[k]! + turn;
          if (turn !== 0 && (angle < lower_rad || angle > upper_rad)) return [];
          const next = q.slice();
          next[k] = angle;
          return [next];
        }),
      )
      .slice(0, MOST_TWINS);
  }
  return all
    .filter(q => q.some((angle, k) => angle !== goal[k]))
    .sort((a, b) => distanceBetween(start, a) - distanceBetween(start, b));
}

/**
 * The joints between the two solids by how much they bring them together where they meet, with the way that leads
 * apart.
 */
function drivers(
  { collider, arm }: PathValidator,
  pair: SolidPair,
  start: Float64Array,
  goal: Float64Array,
  at: number,
): { readonly joint: number; readonly away: 1 | -1 }[] {
  const last = Math.max(pair.a.carrier, pair.b.carrier);
  const first = Math.max(0, Math.min(pair.a.carrier, pair.b.carrier));
  const q = alongLine(start, goal, Math.max(0, at - 0.02), new Float64Array(start.length));
  const gapAt = (configuration: ArrayLike<number>): number => {
    collider.place(configuration);
    return collider.distanceOf(pair, 1);
  };
  const here = gapAt(q);
  const found: { joint: number; away: 1 | -1; worth: number }[] = [];
  for (let joint = first; joint < Math.min(last, arm.joints.length); joint++) {
    for (const away of [1, -1] as const) {
      const tried = q.slice();
      tried[joint] = tried[joint]! + away * 0.05;
      found.push({ joint, away, worth: Math.min(1, gapAt(tried)) - Math.min(1, here) });
    }
  }
  return found.sort((a, b) => b.worth - a.worth);
}
