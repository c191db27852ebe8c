import type { NetworkConditions } from "./weather.ts";

/** A number in a text, with its sign and its digits behind the point. */
const NUMBER = /-?\d+(\.\d+)?/g;
const NUMBER_BYTES = 8;

/** What the weather makes of a chunk; the chunk itself stays as it is, and so does its length. */
export function spoiled(bytes: Uint8Array, conditions: NetworkConditions, random: () => number): Uint8Array {
  const copy = bytes.slice();
  if (copy.length === 0) return copy;
  if (conditions.garbage > 0 && random() < conditions.garbage)
    copy[Math.floor(random() * copy.length)] = Math.floor(random() * 256);
  if (conditions.absurd > 0 && random() < conditions.absurd) absurd(copy, random);
  return copy;
}

/**
 * In a text one number becomes nines or NaN; elsewhere eight bytes become all ones: no number as a float, −1 as an
 * integer.
 */
function absurd(bytes: Uint8Array, random: () => number): void {
  const text = String.fromCharCode(...bytes.subarray(0, 4096));
  const found = [...text.matchAll(NUMBER)];
  const one = found[Math.floor(random() * found.length)];
  const isText = bytes.every(byte => (byte >= 32 && byte < 127) || byte === 9 || byte === 10 || byte === 13);
  if (isText && one) {
    const { length } = one[0];
    const becomes = length >= 3 && random() < 0.5 ? "NaN".padEnd(length) : "9".repeat(length);
    for (let i = 0; i < length; i++) bytes[one.index + i] = becomes.charCodeAt(i);
  } else {
    const at = Math.floor(random() * Math.max(1, bytes.length - NUMBER_BYTES));
    bytes.fill(0xff, at, at + NUMBER_BYTES);
  }
}
