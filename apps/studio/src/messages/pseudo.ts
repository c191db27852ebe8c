const PLAIN = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
const ACCENTED = "ÅƁÇÐÉƑĜĤÎĴĶĻṀÑÖÞǪŔŠŢÛṼŴẊÝŽåƀçðéƒĝĥîĵķļḿñöþǫŕšţûṽŵẋýž";
const ACCENTS = new Map([...PLAIN].map((letter, i) => [letter, [...ACCENTED][i]!]));

/** Translations are up to a third longer than English; what is added breaks into lines as words do. */
const longer = (text: string): string =>
  "~~~~~ "
    .repeat(99)
    .slice(0, Math.round(0.35 * text.trim().length))
    .trim();

/**
 * A text as the pseudo-language writes it: readable, every letter with an accent, a third longer, in brackets. What is
 * put into a message stands outside of the brackets, so that what comes from no catalogue can be told.
 */
export function pseudo(text: string): string {
  if (!/\p{L}/u.test(text)) return text;
  const accented = [...text].map(letter => ACCENTS.get(letter) ?? letter).join("");
  return `⟦${accented}${text.length > 15 ? " " : ""}${longer(text)}⟧`;
}

/** What is put into a message: a sentence comes from a package and is marked, a name is data and is not. */
export const pseudoSentence = (text: string): string => (/\p{L} .*[.!?]$/u.test(text) ? pseudo(text) : text);
