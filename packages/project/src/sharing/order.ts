/** Digits in the order in which texts are compared. */
const DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
const BASE = DIGITS.length;

/**
 * A text that sorts after `a` and before `b`. What two people put between the same two things at the same time gets
 * different texts by their `mark`, so that something can be put between those as well.
 *
 * @param a  text of what comes before; empty at the front. @param b  text of what comes after; undefined at the end.
 * @param mark  some digits of whoever asks; the last is not “0”.
 */
export function orderBetween(a: string, b: string | undefined, mark: string): string {
  let end = b;
  let made = "";
  for (let i = 0; ; i++) {
    const low = i < a.length ? DIGITS.indexOf(a[i]!) : -1;
    const high = end === undefined ? BASE : i < end.length ? DIGITS.indexOf(end[i]!) : 0;
    if (end === undefined && low >= 0 && low < BASE - 1) return `${made}${DIGITS[low + 1]!}${mark}`;
    const middle = Math.floor((Math.max(low, 0) + high) / 2);
    if (middle > Math.max(low, 0)) return `${made}${DIGITS[middle]!}${mark}`;
    // Two texts that are equal leave no room: what is put between them comes after both.
    if (i >= a.length && end !== undefined && i >= end.length) return `${a}${DIGITS[1]!}${mark}`;
    const digit = Math.max(low, 0);
    made += DIGITS[digit]!;
    if (end !== undefined && digit < high) end = undefined;
  }
}

/** Texts in order for things that are put into an empty list, all as long as they have to be. */
export function ordersFor(count: number): readonly string[] {
  let width = 1;
  while (BASE ** width < count + 2) width++;
  const pitch = BASE ** width / (count + 1);
  return Array.from({ length: count }, (_, i) => {
    let left = Math.floor((i + 1) * pitch);
    let made = "";
    for (let digit = 0; digit < width; digit++) {
      made = DIGITS[left % BASE]! + made;
      left = Math.floor(left / BASE);
    }
    return `${made}V`;
  });
}

/** Digits that tell one editor from another. */
export const markOf = (number: number): string =>
  DIGITS[number % BASE]! +
  DIGITS[Math.floor(number / BASE) % BASE]! +
  DIGITS[1 + (Math.floor(number / BASE ** 2) % (BASE - 1))]!;

/**
 * Which of these places stay where they are, as many as possible, while the others are moved: the longest run of places
 * that only rise.
 */
export function longestRising(places: readonly number[]): ReadonlySet<number> {
  const ends: number[] = [];
  const before = new Array<number>(places.length).fill(-1);
  for (const [i, place] of places.entries()) {
    let low = 0;
    let high = ends.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (places[ends[middle]!]! < place) low = middle + 1;
      else high = middle;
    }
    before[i] = low > 0 ? ends[low - 1]! : -1;
    ends[low] = i;
  }
  const kept = new Set<number>();
  for (let i = ends.at(-1) ?? -1; i >= 0; i = before[i]!) kept.add(places[i]!);
  return kept;
}
