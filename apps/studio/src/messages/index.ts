import { type Words, wordsOf } from "./catalogue.ts";
import { en } from "./en/index.ts";
import { type Language, PSEUDO, languageIn, translationOf } from "./languages.ts";
import { decimalPoint, setNumbersOf } from "./numbers.ts";
import { translatorOf } from "./sentences.ts";

/** The language of this page. It is chosen once, when the page loads: another one loads the page again. */
export const language: Language = languageIn(globalThis);

interface Spoken {
  readonly words: Words<typeof en>;
  readonly say: (said: string) => string;
}

async function load(): Promise<Spoken> {
  setNumbersOf(language);
  if (typeof document !== "undefined") document.documentElement.lang = language;
  if (language === PSEUDO) {
    const { pseudo, pseudoSentence } = await import("./pseudo.ts");
    return { words: wordsOf(en, {}, { locale: language, letters: pseudo, said: pseudoSentence }), say: pseudo };
  }
  const { catalogue, sentences } = await translationOf(language);
  const say = translatorOf(sentences, decimalPoint());
  // What is put into a message is a name, or a sentence of a package: a person's "Tool" is called as they called it.
  const said = (text: string): string => (/[.!?]$/.test(text) ? say(text) : text);
  return { words: wordsOf(en, catalogue, { locale: language, said }), say };
}

const spoken = await load();

/** Every text a person sees or hears, in the language of this page. */
export const { words } = spoken;

/**
 * What a package said, in the language of this page: refusals, faults, findings, assumptions, reports. What the
 * language's catalogue does not have is said in English.
 */
export const { say } = spoken;
