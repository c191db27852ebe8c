import type * as Y from "yjs";

/** Beyond this many pairs of lines the middle of a text is replaced as one. */
const MAX_PAIRS = 4_000_000;

/** Writes the difference between two states of a text, line by line, so that what others type elsewhere stays. */
export function changeText(text: Y.Text, before: string, after: string): void {
  const was = linesOf(before);
  const is = linesOf(after);
  let front = 0;
  while (front < was.length && front < is.length && was[front] === is[front]) front++;
  let back = 0;
  while (back < was.length - front && back < is.length - front && was.at(-1 - back) === is.at(-1 - back)) back++;
  let at = length(was.slice(0, front));
  for (const [gone, come] of hunks(was.slice(front, was.length - back), is.slice(front, is.length - back))) {
    if (gone === come) {
      at += gone.length;
      continue;
    }
    at += replaced(text, at, gone, come);
  }
}

/** Of a changed line only what differs is written. */
function replaced(text: Y.Text, at: number, gone: string, come: string): number {
  let front = 0;
  while (front < gone.length && front < come.length && gone[front] === come[front]) front++;
  let back = 0;
  while (back < gone.length - front && back < come.length - front && gone.at(-1 - back) === come.at(-1 - back)) back++;
  const out = gone.length - front - back;
  if (out > 0) text.delete(at + front, out);
  if (come.length - front - back > 0) text.insert(at + front, come.slice(front, come.length - back));
  return come.length;
}

/** Lines with their ends. */
const linesOf = (text: string): readonly string[] => text.match(/[^\n]*\n|[^\n]+$/g) ?? [];
const length = (lines: readonly string[]): number => lines.reduce((sum, line) => sum + line.length, 0);

/** What goes and what comes, in order; equal pieces stay. Together they are all of both texts. */
function* hunks(was: readonly string[], is: readonly string[]): Generator<readonly [string, string]> {
  if (was.length * is.length > MAX_PAIRS) {
    yield [was.join(""), is.join("")];
    return;
  }
  // Longest common subsequence of lines: common[i][j] of what is left from i and j on.
  const width = is.length + 1;
  const common = new Uint32Array((was.length + 1) * width);
  for (let i = was.length - 1; i >= 0; i--)
    for (let j = is.length - 1; j >= 0; j--)
      common[i * width + j] =
        was[i] === is[j]
          ? common[(i + 1) * width + j + 1]! + 1
          : Math.max(common[(i + 1) * width + j]!, common[i * width + j + 1]!);
  let gone = "";
  let come = "";
  let i = 0;
  let j = 0;
  while (i < was.length || j < is.length) {
    if (i < was.length && j < is.length && was[i] === is[j]) {
      if (gone !== come) yield [gone, come];
      gone = come = "";
      yield [was[i]!, is[j]!];
      i++;
      j++;
    } else if (j >= is.length || (i < was.length && common[(i + 1) * width + j]! >= common[i * width + j + 1]!)) {
      gone += was[i++]!;
    } else come += is[j++]!;
  }
  if (gone !== come) yield [gone, come];
}
