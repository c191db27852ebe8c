/**
 * A running hash of states: equal hashes mean equal numbers, to the last bit. Two lanes of 32 bits over the bytes of
 * every number, as FNV-1a mixes them, with two primes and two beginnings.
 */
export class StateLog {
  private a = 0x811c9dc5;
  private b = 0x9e3779b9;
  private readonly number = new Float64Array(1);
  private readonly bytes = new Uint8Array(this.number.buffer);

  add(numbers: ArrayLike<number>): void {
    const { number, bytes } = this;
    let { a, b } = this;
    for (let i = 0; i < numbers.length; i++) {
      number[0] = numbers[i]!;
      for (let k = 0; k < 8; k++) {
        const byte = bytes[k]!;
        a = Math.imul(a ^ byte, 0x01000193);
        b = (Math.imul(b ^ byte, 0x85ebca6b) + 1) | 0;
      }
    }
    this.a = a;
    this.b = b;
  }

  /** Sixteen hexadecimal digits. */
  get hash(): string {
    return [this.a, this.b].map(lane => (lane >>> 0).toString(16).padStart(8, "0")).join("");
  }
}
