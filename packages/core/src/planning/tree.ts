/**
 * Postures that are joined to a root by free lines. Grows in place; a posture is named by its number, the root is 0.
 */
export class ConfigurationTree {
  readonly #joints: number;
  #q: Float64Array;
  #parents: Int32Array;
  #size = 0;

  constructor(joints: number) {
    this.#joints = joints;
    this.#q = new Float64Array(64 * joints);
    this.#parents = new Int32Array(64);
  }

  get size(): number {
    return this.#size;
  }

  reset(root: ArrayLike<number>): this {
    this.#size = 0;
    this.add(root, -1);
    return this;
  }

  add(q: ArrayLike<number>, parent: number): number {
    const n = this.#joints;
    const at = this.#size++;
    if (at === this.#parents.length) {
      const more = new Float64Array(2 * this.#q.length);
      const parents = new Int32Array(2 * at);
      more.set(this.#q);
      parents.set(this.#parents);
      this.#q = more;
      this.#parents = parents;
    }
    for (let k = 0; k < n; k++) this.#q[at * n + k] = q[k]!;
    this.#parents[at] = parent;
    return at;
  }

  /** The posture's own numbers: valid until the next `add`. */
  at(index: number): Float64Array {
    return this.#q.subarray(index * this.#joints, (index + 1) * this.#joints);
  }

  /** The posture nearest to q in joint space. */
  nearest(q: ArrayLike<number>): number {
    const n = this.#joints;
    const all = this.#q;
    let best = Infinity;
    let found = 0;
    for (let i = 0, at = 0; i < this.#size; i++, at += n) {
      let sum = 0;
      for (let k = 0; k < n && sum < best; k++) {
        const d = all[at + k]! - q[k]!;
        sum += d * d;
      }
      if (sum < best) {
        best = sum;
        found = i;
      }
    }
    return found;
  }

  /** Copies of the postures from this one to the root. */
  wayToRoot(index: number): Float64Array[] {
    const way: Float64Array[] = [];
    for (let i = index; i >= 0; i = this.#parents[i]!) way.push(this.at(i).slice());
    return way;
  }
}
