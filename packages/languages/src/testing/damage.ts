import type { Random, TextFault } from "@twincell/core";

/** What damage is made of: signs that mean something somewhere, and signs that mean nothing anywhere. */
const SCRAPS = [
  ...' ()[],:;=#$."-–+*/<>0123456789eE\n\t\0ÿ',
  "END",
  "FOR",
  "IF",
  "DO",
  "GOTO 1\n",
  "1e999",
  "MOVE",
  "((((((((",
];

/** A text with one to four places cut, overwritten or filled with scraps. */
export function damaged(source: string, random: Random): string {
  const below = (count: number): number => Math.floor(random() * count);
  let text = source;
  for (let k = 1 + below(4); k > 0; k--) {
    const at = below(text.length);
    const cut = random() < 0.5 ? below(30) : 0;
    text = text.slice(0, at) + SCRAPS[below(SCRAPS.length)]! + text.slice(at + cut);
  }
  return text;
}

/** @throws {Error} when a fault has no place in the text, expects nothing, or is no sentence. */
export function expectSane(faults: readonly TextFault[], text: string): void {
  const lines = text.split(/\r\n|\n|\r/);
  const odd = faults.find(
    ({ line, column, expected, sentence }) =>
      !(
        line >= 1 &&
        line <= lines.length + 1 &&
        column >= 1 &&
        column <= (lines[line - 1] ?? "").length + 1 &&
        expected !== "" &&
        sentence.endsWith(".")
      ),
  );
  if (faults.length === 0 || odd !== undefined)
    throw new Error(`${JSON.stringify(odd ?? "no fault")} in ${JSON.stringify(text)}`);
}
