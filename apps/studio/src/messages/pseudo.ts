const PLAIN = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
const ACCENTED = "ÅƁÇÐÉƑĜĤÎĴĶĻṀÑÖÞǪŔŠŢÛṼŴẊÝŽåƀçðéƒĝĥîĵķļḿñöþǫŕšţûṽŵẋýž";
const ACCENTS = new Map([...PLAIN].map((letter, i) => [letter, [...ACCENTED][i]!]));

/** Translations are up to a third longer than English. */
const LONGER = 0.35;

/**
 * A text as the pseudo-language writes it: readable, every letter with an accent, a third longer, in brackets. What is
 * put into a message stands outside of the brackets, so that what comes from no catalogue can be told.
 */
export function pseudo(text: string): string {
  if (!/\p{L}/u.test(text)) return text;
  const accented = [...text].map(letter => ACCENTS.get(letter) ?? letter).join("");
  return `⟦${accented}${"~".repeat(Math.round(LONGER * text.trim().length))}⟧`;
}
