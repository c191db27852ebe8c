import type { Vector3 } from "../../spatial/vector.ts";
import type { PoseChange } from "./change.ts";

/** One kind of change: in which directions, how far at most, and in what steps it is looked for. */
export interface ChangeSearch {
  /** Directions looked at, evenly round a circle; those between them are tried where one of them helps. */
  readonly directions: number;
  /** Of a circle that has no in-between, as the two ways of turning. */
  readonly between: boolean;
  readonly most: number;
  readonly step: number;
  /** Beyond some steps, the next amount is larger than the last by this share. */
  readonly growth: number;
  /** How exactly the least amount is found. */
  readonly fine: number;
  /** @param direction  0 … directions, fractions in between. @param amount  more than 0. */
  change(direction: number, amount: number): PoseChange;
}

const TURN = 2 * Math.PI;
const DEG = Math.PI / 180;

/** The tool turned about its own axis, either way, up to half a turn. */
export const SPIN: ChangeSearch = {
  directions: 2,
  between: false,
  most: Math.PI,
  step: DEG,
  growth: 0,
  fine: 0.05 * DEG,
  change: (direction, amount) => ({ kind: "spin", angle_rad: direction === 0 ? amount : -amount }),
};

/** The tool tilted about any axis square to its own, up to 45°. */
export const TILT: ChangeSearch = {
  directions: 24,
  between: true,
  most: 45 * DEG,
  step: DEG,
  growth: 0.04,
  fine: 0.05 * DEG,
  change: (direction, amount) => ({ kind: "tilt", angle_rad: amount, axis_rad: (TURN * direction) / 24 }),
};

/**
 * Moved level with the base, up to a metre.
 *
 * @param outward_rad  the first direction: from the base to the thing, so that “towards the robot” is one of them.
 */
export const levelShift = (outward_rad: number, most_m = 1): ChangeSearch => ({
  directions: 24,
  between: true,
  most: most_m,
  step: 0.01,
  growth: 0.04,
  fine: 0.0005,
  change: (direction, amount) => {
    const angle = outward_rad + (TURN * direction) / 24;
    return { kind: "shift", by_m: [amount * Math.cos(angle), amount * Math.sin(angle), 0] };
  },
});

/** Moved up or down, up to half a metre. */
export const LIFT: ChangeSearch = {
  directions: 2,
  between: false,
  most: 0.5,
  step: 0.01,
  growth: 0.04,
  fine: 0.0005,
  change: (direction, amount) => ({ kind: "shift", by_m: [0, 0, direction === 0 ? amount : -amount] as Vector3 }),
};

export interface Least {
  readonly change: PoseChange;
  readonly amount: number;
}

/** Says of a change how far it is from fitting: 0 when it fits, Infinity when that is not known. */
export type Miss = (change: PoseChange) => number;

/** Near misses beyond this are not looked into [rad]. */
const NEAR_MISS_RAD = 10 * DEG;
/** Steps down from a near miss. */
const DESCENT = 8;

/**
 * The least change of one kind that fits: rings of growing amount, every direction of a ring. Where a ring has one that
 * fits, its amount is halved down to `fine` and the directions beside it are tried as well. Where the miss of a
 * direction was least in the ring before and grows again, what lies between the rings and directions is looked into, so
 * that narrow places are found too; one that no near miss tells of may be passed over.
 *
 * @param from  amounts up to here are known not to fit.
 */
export function leastChange(search: ChangeSearch, miss: Miss, from = 0): Least | undefined {
  const { directions, most, step, growth, change } = search;
  let [older, old, now] = [0, 1, 2].map(() => new Float64Array(directions).fill(Infinity)) as [
    Float64Array,
    Float64Array,
    Float64Array,
  ];
  for (let last = from, ring = 0; last < most - 1e-12; ring++) {
    const low = last;
    const amount = Math.min(most, low + Math.max(step, growth * low));
    last = amount;
    let best: Place | undefined;
    for (let direction = 0; direction < directions; direction++) {
      now[direction] = miss(change(direction, amount));
      if (now[direction] !== 0) continue;
      const least = halved(search, miss, direction, low, amount);
      if (best === undefined || least < best.amount) best = { direction, amount: least };
    }
    for (let direction = 0; direction < directions && ring > 0; direction++) {
      const at = old[direction]!;
      if (!(at <= NEAR_MISS_RAD) || at > older[direction]! || at > now[direction]!) continue;
      if (
        search.between &&
        (at > old[(direction + 1) % directions]! || at > old[(direction + directions - 1) % directions]!)
      )
        continue;
      const found = descended(search, miss, { direction, amount: low }, at, from);
      if (found !== undefined && (best === undefined || found.amount < best.amount)) best = found;
    }
    if (best !== undefined) {
      if (search.between) best = besides(search, miss, best, from);
      return { change: change(best.direction, best.amount), amount: best.amount };
    }
    [older, old, now] = [old, now, older];
  }
  return undefined;
}

interface Place {
  readonly direction: number;
  readonly amount: number;
}

/** From a near miss to the place beside it that misses least, and what fits there, if anything does. */
function descended(search: ChangeSearch, miss: Miss, near: Place, at: number, from: number): Place | undefined {
  const { step, growth, most, change, between } = search;
  let best = near;
  let least = at;
  let along = Math.max(step, growth * near.amount) / 2;
  let across = between ? 0.5 : 0;
  for (let k = 0; k < DESCENT; k++) {
    let next: Place | undefined;
    for (const [turn, more] of SIDES) {
      if (turn !== 0 && across === 0) continue;
      const amount = Math.min(most, best.amount + more * along);
      if (amount <= from) continue;
      const direction = best.direction + turn * across;
      const missed = miss(change(direction, amount));
      if (missed === 0) return { direction, amount: halved(search, miss, direction, from, amount) };
      if (missed < least) {
        least = missed;
        next = { direction, amount };
      }
    }
    if (next === undefined) {
      along /= 2;
      across /= 2;
    } else best = next;
  }
  return undefined;
}
const SIDES = [
  [0, -1],
  [0, 1],
  [-1, 0],
  [1, 0],
] as const;

/** The least amount between `low`, which does not count as fitting, and `high`, which fits. */
function halved({ change, fine }: ChangeSearch, miss: Miss, direction: number, low: number, high: number): number {
  let below = low;
  let above = high;
  while (above - below > fine) {
    const middle = (above + below) / 2;
    if (miss(change(direction, middle)) === 0) above = middle;
    else below = middle;
  }
  return above;
}

/** Directions beside the best one, nearer and nearer to it, as long as they need less. */
function besides(search: ChangeSearch, miss: Miss, found: Place, from: number): Place {
  let best = found;
  for (let beside = 0.5; beside > 0.1; beside /= 2) {
    const { direction } = best;
    for (const side of [-beside, beside]) {
      const next = direction + side;
      const slightly = best.amount - search.fine;
      if (slightly <= from || miss(search.change(next, slightly)) !== 0) continue;
      const least = halved(search, miss, next, from, slightly);
      if (least < best.amount) best = { direction: next, amount: least };
    }
  }
  return best;
}
