/** Numbers of a choice's code that no branch has. */
export const NO_CODE = -1;
/** What a candidate came to by its last step, beside time. */
export const PLAIN = 0;
export const FLIPPED = 1;
export const OTHERWISE = 2;
export const STOOD = 4;
export const BROKEN = 8;

/** Candidates of a whole path one after another, in columns that grow. A stage is a stretch of them. */
export class CandidatePool {
  readonly joints: number;
  count = 0;
  q: Float64Array;
  /** Least cost of getting there [s, with penalties]. */
  cost = new Float64Array(256);
  /** The candidate it comes from; −1 at the start. */
  from = new Int32Array(256);
  /** Same within a stage: the same posture up to whole turns. */
  group = new Int32Array(256);
  /** Its branch as a number. */
  code = new Int8Array(256);
  fault = new Uint8Array(256);

  constructor(joints: number) {
    this.joints = joints;
    this.q = new Float64Array(256 * joints);
  }

  clear(): void {
    this.count = 0;
  }

  /** @param q @param at  angles from there on are copied. */
  add(q: Float64Array, at: number, cost: number, from: number, group: number, code: number, fault: number): number {
    const index = this.count++;
    const n = this.joints;
    if (index >= this.cost.length) this.grow();
    for (let j = 0; j < n; j++) this.q[index * n + j] = q[at + j]!;
    this.cost[index] = cost;
    this.from[index] = from;
    this.group[index] = group;
    this.code[index] = code;
    this.fault[index] = fault;
    return index;
  }

  posture(index: number): Float64Array {
    return this.q.slice(index * this.joints, (index + 1) * this.joints);
  }

  private grow(): void {
    const more = this.cost.length * 2;
    const { q, cost, from, group, code, fault } = this;
    this.q = new Float64Array(more * this.joints);
    this.q.set(q);
    this.cost = new Float64Array(more);
    this.cost.set(cost);
    this.from = new Int32Array(more);
    this.from.set(from);
    this.group = new Int32Array(more);
    this.group.set(group);
    this.code = new Int8Array(more);
    this.code.set(code);
    this.fault = new Uint8Array(more);
    this.fault.set(fault);
  }
}
