/** Changes of the numbers in a list, for faults that are put into a text on purpose. */
export type Change = (list: string[]) => string[];

/**
 * Changes the numbers of the first list that matches: what is before it, the list, and what is behind it are the three
 * groups.
 */
export const listIn =
  (matching: RegExp) =>
  (change: Change) =>
  (text: string): string =>
    text.replace(
      matching,
      (_, before: string, list: string, behind: string) => `${before}${change(list.split(/, ?/)).join(", ")}${behind}`,
    );

export const negated = (text: string): string =>
  text.startsWith("-") ? text.slice(1) : text.startsWith("+") ? `-${text.slice(1)}` : `-${text}`;
export const negatedAt =
  (i: number): Change =>
  list =>
    list.with(i, negated(list[i]!));
const moreAt =
  (i: number, by: number): Change =>
  list =>
    list.with(i, String(Number(list[i]) + by));
const swappedAt =
  (i: number, j: number): Change =>
  list =>
    list.with(i, list[j]!).with(j, list[i]!);
const each =
  (change: (value: number) => number, first = 0, last = 99): Change =>
  list =>
    list.map((text, i) => (i >= first && i <= last ? String(change(Number(text))) : text));

/** Faults of numbers that every language with places and joint angles in millimetres and degrees can have. */
export const numberFaults = (
  joints: ReturnType<typeof listIn>,
  place: ReturnType<typeof listIn>,
  shoulder_mm: number,
): Readonly<Record<string, (text: string) => string>> => ({
  "a joint with the wrong sign": joints(negatedAt(1)),
  "two joints in the wrong order": joints(swappedAt(3, 4)),
  "radians for degrees": joints(each(x => (x / 180) * Math.PI)),
  "a joint turned by a hundredth of a degree": joints(moreAt(0, 0.01)),
  "a whole turn too much": joints(moreAt(5, 360)),
  "metres for millimetres": place(each(x => x / 1000, 0, 2)),
  "x and y in the wrong order": place(swappedAt(0, 1)),
  "the first and the last turn in the wrong order": place(swappedAt(3, 5)),
  "the first turn with the wrong sign": place(negatedAt(3)),
  "the second turn with the wrong sign": place(negatedAt(4)),
  "the third turn with the wrong sign": place(negatedAt(5)),
  "heights from the shoulder instead of the floor": place(moreAt(2, -shoulder_mm)),
  "two hundredths of a millimetre too much": place(moreAt(0, 0.02)),
});
