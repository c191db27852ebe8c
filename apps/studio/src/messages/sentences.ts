/**
 * What packages say, in another language. A package states a fact as English text with numbers in it; that text without
 * what varies is the key under which a catalogue has the translation: "Joint {n} would turn to {value}; its limit is
 * {limit}." Sentences come through workers, recordings and the network as they were said, and are translated where they
 * are shown. What a catalogue does not have stays English.
 */
export type Sentences = Readonly<Record<string, string>>;

interface Pattern {
  readonly matches: RegExp;
  readonly names: readonly string[];
  readonly says: string;
}

const PLACE = /\{(\w+)\}/g;
const escaped = (text: string): string => text.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");

/** The expression that a said sentence matches, each place a group. */
export function patternOf(key: string): RegExp {
  const parts = key.split(PLACE);
  return new RegExp(`^${parts.map((part, i) => (i % 2 === 0 ? escaped(part) : "(.+?)")).join("")}$`, "su");
}

/** The names of the places of a key, in their order. */
export const placesOf = (key: string): readonly string[] => [...key.matchAll(PLACE)].map(([, name]) => name!);

/** Sentences are many and alike: those that begin with the same word are looked through together. */
const firstWord = (text: string): string => /^(\p{L}+) /u.exec(text)?.[1] ?? "";

/** Said again and again while a robot moves: the last ones are kept. */
const MOST_KEPT = 500;

/**
 * A function that says a sentence of a package in another language.
 *
 * @param sentences English text to translation; `{name}` stands for what varies
 * @param point the decimal sign of the language
 */
export function translatorOf(sentences: Sentences, point: string): (said: string) => string {
  const plain = new Map<string, string>();
  const byWord = new Map<string, Pattern[]>();
  for (const [key, says] of Object.entries(sentences)) {
    const names = placesOf(key);
    if (names.length === 0) plain.set(key, says);
    else {
      const word = firstWord(key);
      const list = byWord.get(word) ?? [];
      list.push({ matches: patternOf(key), names, says });
      byWord.set(word, list);
    }
  }
  // What says most by itself is looked at first.
  for (const list of byWord.values())
    list.sort((a, b) => b.matches.source.length - 5 * b.names.length - (a.matches.source.length - 5 * a.names.length));
  const kept = new Map<string, string>();

  /** A name in quotes stays as it is; numbers get the sign of the language. */
  const inPlace = (text: string): string =>
    whole(text) ?? (/^[“"]/.test(text) ? text : text.replace(/(?<![\d.])(\d+)\.(\d+)(?![\d.])/g, `$1${point}$2`));
  const whole = (said: string): string | null => {
    const exact = plain.get(said);
    if (exact !== undefined) return exact;
    const word = firstWord(said);
    for (const list of word === "" ? [byWord.get("")] : [byWord.get(word), byWord.get("")])
      for (const { matches, names, says } of list ?? []) {
        const found = matches.exec(said);
        if (!found) continue;
        return says.replace(PLACE, (_place, name: string) => inPlace(found[names.indexOf(name) + 1] ?? ""));
      }
    return null;
  };
  /** Two sentences one after the other are translated each. */
  const each = (said: string): string =>
    said
      .split(/(?<=[.!?]) (?=[\p{Lu}“])/u)
      .map(part => whole(part) ?? part)
      .join(" ");

  /** Who or where, and a sentence: only the sentence is translated. */
  const afterName = (said: string): string | null => {
    const colon = said.indexOf(": ");
    const rest = colon > 0 ? whole(said.slice(colon + 2)) : null;
    return rest === null ? null : `${said.slice(0, colon)}: ${rest}`;
  };

  if (plain.size + byWord.size === 0) return said => said;
  return said => {
    const known = kept.get(said);
    if (known !== undefined) return known;
    const text = whole(said) ?? afterName(said) ?? each(said);
    if (kept.size >= MOST_KEPT) kept.clear();
    kept.set(said, text);
    return text;
  };
}
