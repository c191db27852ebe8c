import type { SerialArm } from "../model/arm.ts";
import type { Body } from "./bodies.ts";
import type { CellCollider, SolidPair } from "./cell-collider.ts";

/** Pairs moved against each other by more joints than this get no map: it would be too sparse to be met twice. */
const MOST_JOINTS = 3;
/** Boxes of joint space in which a pair moves less than this are not split any more [m]. */
const FINEST_M = 0.004;
const MOST_NODES = 1 << 16;
/** New boxes looked at in one query; what is still unknown then is said to be unknown, and known better next time. */
const FRESH_LOOKS = 3;

const UNSEEN = 0;
const CLEAR = 1;
const SPLIT = 2;
const OPEN = 3;

/**
 * Joint space of the joints between two solids, cut into boxes; a clear one is proven clear throughout, as
 * `checkMotion` proves.
 */
interface PairMap {
  readonly joints: readonly number[];
  readonly lower: readonly number[];
  readonly upper: readonly number[];
  readonly reach_m: readonly number[];
  readonly outer: Body;
  readonly margin_m: number;
  state: Uint8Array;
  /** Lower half of a split box; the upper one comes next. */
  child: Int32Array;
  nodes: number;
}

/**
 * What earlier questions proved, kept for the next ones. How near two solids come depends on the joints between them
 * alone; where these are three at most, boxes of their angles are proven clear once (base and upper arm, forearm and
 * hand, or a link low on the arm and what stands around) and then only looked up. Unknown is always an answer: the
 * exact test follows.
 *
 * One of these belongs to one collider and forgets everything when an object there moves. It grows to some megabytes at
 * most.
 */
export class ClearanceMaps {
  readonly #collider: CellCollider;
  readonly #arm: SerialArm;
  readonly #maps = new Map<SolidPair, PairMap | null>();
  readonly #q: Float64Array;
  readonly #low = new Float64Array(MOST_JOINTS);
  readonly #high = new Float64Array(MOST_JOINTS);
  #edition: number;
  #fresh = 0;
  #moved = false;

  constructor(collider: CellCollider, arm: SerialArm) {
    this.#collider = collider;
    this.#arm = arm;
    this.#edition = collider.edition;
    this.#q = Float64Array.from(arm.joints, ({ limits }) => (limits.lower_rad + limits.upper_rad) / 2);
  }

  /**
   * Whether the pair is proven to keep `margin_m` wherever every joint is within ± `half` · `maxRate` of q. False says
   * nothing. The collider stands at q again afterwards when it stood there before.
   */
  provenAround(
    pair: SolidPair,
    margin_m: number,
    q: ArrayLike<number>,
    maxRate: ArrayLike<number> | null,
    half: number,
  ): boolean {
    const map = this.#mapOf(pair, margin_m);
    if (map === null) return false;
    const { joints, lower, upper } = map;
    for (let k = 0; k < joints.length; k++) {
      const j = joints[k]!;
      const by = maxRate === null ? 0 : maxRate[j]! * half;
      this.#low[k] = q[j]! - by;
      this.#high[k] = q[j]! + by;
      if (this.#low[k]! < lower[k]! || this.#high[k]! > upper[k]!) return false;
    }
    this.#fresh = FRESH_LOOKS;
    this.#moved = false;
    const proven = this.#covered(
      pair,
      map,
      0,
      lower[0]!,
      upper[0]!,
      lower[1] ?? 0,
      upper[1] ?? 0,
      lower[2] ?? 0,
      upper[2] ?? 0,
    );
    if (this.#moved) this.#collider.place(q);
    return proven;
  }

  /** Boxes kept over all pairs. */
  get size(): number {
    let sum = 0;
    for (const map of this.#maps.values()) sum += map?.nodes ?? 0;
    return sum;
  }

  #mapOf(pair: SolidPair, margin_m: number): PairMap | null {
    if (this.#edition !== this.#collider.edition) {
      this.#maps.clear();
      this.#edition = this.#collider.edition;
    }
    const known = this.#maps.get(pair);
    if (known === null || known?.margin_m === margin_m) return known;
    const made = mapFor(pair, this.#arm, margin_m);
    this.#maps.set(pair, made);
    return made;
  }

  /** Whether the asked box is proven clear as far as it overlaps the node's box [a0 … a1] × [b0 … b1] × [c0 … c1]. */
  #covered(
    pair: SolidPair,
    map: PairMap,
    node: number,
    a0: number,
    a1: number,
    b0: number,
    b1: number,
    c0: number,
    c1: number,
  ): boolean {
    const n = map.joints.length;
    if (this.#outside(n, a0, a1, b0, b1, c0, c1)) return true;
    const state = map.state[node]!;
    if (state === CLEAR) return true;
    if (state === OPEN) return false;
    if (state === UNSEEN) {
      if (this.#fresh === 0) return false;
      this.#fresh--;
      if (this.#look(pair, map, node, a0, a1, b0, b1, c0, c1)) return true;
      if (map.state[node] === OPEN) return false;
    }
    const left = map.child[node]!;
    const wa = (a1 - a0) * map.reach_m[0]!;
    const wb = n > 1 ? (b1 - b0) * map.reach_m[1]! : -1;
    const wc = n > 2 ? (c1 - c0) * map.reach_m[2]! : -1;
    if (wa >= wb && wa >= wc) {
      const m = (a0 + a1) / 2;
      return (
        this.#covered(pair, map, left, a0, m, b0, b1, c0, c1) &&
        this.#covered(pair, map, left + 1, m, a1, b0, b1, c0, c1)
      );
    }
    if (wb >= wc) {
      const m = (b0 + b1) / 2;
      return (
        this.#covered(pair, map, left, a0, a1, b0, m, c0, c1) &&
        this.#covered(pair, map, left + 1, a0, a1, m, b1, c0, c1)
      );
    }
    const m = (c0 + c1) / 2;
    return (
      this.#covered(pair, map, left, a0, a1, b0, b1, c0, m) && this.#covered(pair, map, left + 1, a0, a1, b0, b1, m, c1)
    );
  }

  /** Whether the asked box, of n joints, does not overlap the node's box at all. */
  #outside(n: number, a0: number, a1: number, b0: number, b1: number, c0: number, c1: number): boolean {
    const low = this.#low;
    const high = this.#high;
    return (
      high[0]! < a0 ||
      low[0]! > a1 ||
      (n > 1 && (high[1]! < b0 || low[1]! > b1)) ||
      (n > 2 && (high[2]! < c0 || low[2]! > c1))
    );
  }

  /** Proves one box from its middle, or splits it, or leaves it open for good. */
  #look(
    pair: SolidPair,
    map: PairMap,
    node: number,
    a0: number,
    a1: number,
    b0: number,
    b1: number,
    c0: number,
    c1: number,
  ): boolean {
    const n = map.joints.length;
    const q = this.#q;
    q[map.joints[0]!] = (a0 + a1) / 2;
    let turn = (a1 - a0) / 2;
    let drift = turn * map.reach_m[0]!;
    if (n > 1) {
      q[map.joints[1]!] = (b0 + b1) / 2;
      turn += (b1 - b0) / 2;
      drift += ((b1 - b0) / 2) * map.reach_m[1]!;
    }
    if (n > 2) {
      q[map.joints[2]!] = (c0 + c1) / 2;
      turn += (c1 - c0) / 2;
      drift += ((c1 - c0) / 2) * map.reach_m[2]!;
    }
    this.#collider.place(q);
    this.#moved = true;
    const clear = this.#collider.keepsApart(pair, map.margin_m + drift - turn * map.outer.solid.radius_m, turn);
    if (clear) map.state[node] = CLEAR;
    else if (drift < FINEST_M || map.nodes + 2 > MOST_NODES) map.state[node] = OPEN;
    else {
      if (map.nodes + 2 > map.state.length) grow(map);
      map.state[node] = SPLIT;
      map.child[node] = map.nodes;
      map.nodes += 2;
    }
    return clear;
  }
}

function mapFor(pair: SolidPair, { joints }: SerialArm, margin_m: number): PairMap | null {
  const { a, b } = pair;
  const outer = a.carrier > b.carrier ? a : b;
  const first = Math.max(0, Math.min(a.carrier, b.carrier));
  const between: number[] = [];
  for (let k = first; k < outer.carrier; k++) between.push(k);
  if (
    between.length === 0 ||
    between.length > MOST_JOINTS ||
    between.some(k => !Number.isFinite(joints[k]!.limits.lower_rad) || !Number.isFinite(joints[k]!.limits.upper_rad))
  )
    return null;
  return {
    joints: between,
    lower: between.map(k => joints[k]!.limits.lower_rad),
    upper: between.map(k => joints[k]!.limits.upper_rad),
    reach_m: between.map(k => outer.reach_m[k]!),
    outer,
    margin_m,
    state: new Uint8Array(64),
    child: new Int32Array(64),
    nodes: 1,
  };
}

function grow(map: PairMap): void {
  const state = new Uint8Array(map.state.length * 2);
  const child = new Int32Array(state.length);
  state.set(map.state);
  child.set(map.child);
  map.state = state;
  map.child = child;
}
