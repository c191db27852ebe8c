/**
 * How well a typed query fits the title of a command, 0 (not at all) to 1. A whole title goes before its beginning,
 * that before the beginnings of its words, that before letters inside a word; other names of the command count a little
 * less than its title. Every word of the query has to be found.
 */
export function commandScore(query: string, title: string, aliases: readonly string[] = []): number {
  const wanted = fold(query);
  if (wanted === "") return 1;
  return Math.max(
    textScore(wanted, fold(title)),
    ...aliases.map(alias => ALIAS_FACTOR * textScore(wanted, fold(alias))),
  );
}

const ALIAS_FACTOR = 0.95;
const EXACT = 1;
const PREFIX = 0.9;
const WORD_START = 0.6;
const SUBSTRING = 0.3;
/**
 * Among titles that fit equally well, the one of which the query is the larger fraction and which has it earlier goes
 * first.
 */
const TIE = 0.02;

function textScore(query: string, title: string): number {
  if (title === query) return EXACT;
  const tie = TIE * (query.length / Math.max(title.length, query.length));
  if (title.startsWith(query)) return PREFIX + tie;
  const titleWords = title.split(" ");
  const queryWords = query.split(" ");
  const starts = queryWords.map(part => titleWords.findIndex(word => word.startsWith(part)));
  if (starts.every(at => at >= 0)) return WORD_START + tie + TIE / (1 + Math.min(...starts));
  return queryWords.every(part => title.includes(part)) ? SUBSTRING + tie : 0;
}

/** Small letters without accents; whatever is neither a letter nor a digit separates words. */
const fold = (text: string): string =>
  text
    .normalize("NFD")
    .replaceAll(/\p{M}/gu, "")
    .toLowerCase()
    .replaceAll(/[^\p{L}\p{N}]+/gu, " ")
    .trim();
