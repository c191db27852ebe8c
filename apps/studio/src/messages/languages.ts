import type { Translation } from "./catalogue.ts";
import type { en } from "./en/index.ts";
import type { Sentences } from "./sentences.ts";

/** A tag of BCP 47: "en", "de", "pt-BR". */
export type Language = string;

/** English with accents and a third longer, in brackets: what is not in a catalogue, or has no room, shows. */
export const PSEUDO: Language = "en-XA";
const SOURCE: Language = "en";
const KEY = "twincell.language";

/** What a language's folder exports: the studio's texts, and what packages say. */
export interface Texts {
  readonly catalogue: Translation<typeof en>;
  readonly sentences: Sentences;
}

/** A folder is a language: ./de/index.ts is German. */
const catalogues = import.meta.glob<Texts>(["./*/index.ts", "!./en/index.ts"]);
const folderOf = (language: Language): string => `./${language}/index.ts`;

/** Every language there is a catalogue for, English first. The pseudo-language is asked for by name only. */
export const languages: readonly Language[] = [
  SOURCE,
  ...Object.keys(catalogues)
    .map(path => path.split("/")[1]!)
    .sort(),
];

/** What a language calls itself: "Deutsch". */
export const nameOf = (language: Language): string =>
  new Intl.DisplayNames([language], { type: "language" }).of(language) ?? language;

/** The language that comes nearest to a wish: "de-AT" is answered with "de"; null when there is none. */
function nearest(wish: string): Language | null {
  const wanted = wish.toLowerCase();
  if (wanted === PSEUDO.toLowerCase() || wanted === "pseudo") return PSEUDO;
  return (
    languages.find(each => each.toLowerCase() === wanted) ??
    languages.find(each => each.toLowerCase() === wanted.split("-")[0]) ??
    null
  );
}

/**
 * The language for a page: the one its address names (`?lang=de`), else the one that was chosen here before, else the
 * first of the browser's languages that there is a catalogue for, else English.
 */
export function chosenLanguage(search: string, kept: string | null, wished: readonly string[] | undefined): Language {
  const asked = new URLSearchParams(search).get("lang");
  for (const wish of [asked, kept, ...(wished ?? [])]) {
    const found = wish === null ? null : nearest(wish);
    if (found !== null) return found;
  }
  return SOURCE;
}

interface Surroundings {
  readonly location?: { readonly search: string };
  readonly navigator?: { readonly languages?: readonly string[] };
  readonly localStorage?: Storage;
}

/** The language for the page that this runs in; outside of a page it is English. */
export function languageIn({ location, navigator, localStorage }: Surroundings): Language {
  if (!location) return SOURCE;
  let kept: string | null = null;
  try {
    kept = localStorage?.getItem(KEY) ?? null;
  } catch {
    kept = null; // A browser that keeps nothing: its own language is taken.
  }
  return chosenLanguage(location.search, kept, navigator?.languages);
}

/** Keeps the choice and loads the page again in that language. */
export function chooseLanguage(language: Language): void {
  const address = new URL(location.href);
  address.searchParams.delete("lang");
  try {
    localStorage.setItem(KEY, language);
  } catch {
    address.searchParams.set("lang", language); // A browser that keeps nothing: the address carries the choice.
  }
  if (address.href === location.href) location.reload();
  else location.assign(address);
}

/** The texts of a language, none for English: that is what the studio and its packages are written in. */
export async function translationOf(language: Language): Promise<Texts> {
  return (await catalogues[folderOf(language)]?.()) ?? { catalogue: {}, sentences: {} };
}
