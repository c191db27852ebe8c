import { type Words, wordsOf } from "./catalogue.ts";
import { en } from "./en/index.ts";
import { type Language, PSEUDO, languageIn, translationOf } from "./languages.ts";
import { setNumbersOf } from "./numbers.ts";

/** The language of this page. It is chosen once, when the page loads: another one loads the page again. */
export const language: Language = languageIn(globalThis);

async function load(): Promise<Words<typeof en>> {
  setNumbersOf(language);
  if (typeof document !== "undefined") document.documentElement.lang = language;
  if (language === PSEUDO) return wordsOf(en, {}, language, (await import("./pseudo.ts")).pseudo);
  return wordsOf(en, await translationOf(language), language);
}

/** Every text a person sees or hears, in the language of this page. */
export const words: Words<typeof en> = await load();
