/** Changes of the numbers in a list, for faults that are put into a text on purpose. */
export type Change = (list: string[]) => string[];

/** Changes the numbers of the first list that matches: what is before it, the list, and what is behind it are the three groups. */
export const listIn = (matching: RegExp) => (change: Change) => (text: string): string =>
  text.replace(matching, (_, before: string, list: string, behind: string) => `${before}${change(list.split(/, ?/)).join(", ")}${behind}`);

export const negated = (text: string): string => text.startsWith("-") ? text.slice(1) : text.startsWith("+") ? `-${text.slice(1)}` : `-${text}`;
export const negatedAt = (i: number): Change => list => list.with(i, negated(list[i]!));
export const moreAt = (i: number, by: number): Change => list => list.with(i, String(Number(list[i]) + by));
export const swappedAt = (i: number, j: number): Change => list => list.with(i, list[j]!).with(j, list[i]!);
export const each = (change: (value: number) => number, first = 0, last = 99): Change => list => list.map((text, i) => i >= first && i <= last ? String(change(Number(text))) : text);
