import type { Branch } from "@twincell/core";

/**
 * Status: bit 0 wrist centre behind axis 1, bit 1 axis 3 bent upwards of the line from axis 2 to the wrist, bit 2 axis
 * 5 negative.
 */
export function statusOf({ shoulder, elbow, wrist }: Branch, above: Branch["wrist"]): number {
  // An elbow is up or down as the arm stands when it faces the wrist; KUKA looks at axis 3 alone.
  const isBent = (elbow === "up") === (shoulder === "front");
  return (shoulder === "back" ? 1 : 0) + (isBent ? 2 : 0) + (wrist === above ? 0 : 4);
}

/** Turn: bit i - 1 is set when axis i is negative. */
export const turnOf = (axes_deg: readonly number[]): number =>
  axes_deg.reduce((bits, value, i) => bits + (value < 0 ? 2 ** i : 0), 0);
