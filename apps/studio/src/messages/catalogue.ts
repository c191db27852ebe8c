import { IntlMessageFormat } from "intl-messageformat";

/**
 * A catalogue is a tree of texts. A text with parameters is an ICU message, and its key names them in the order in
 * which the caller gives them: `"lines(n: number)": "{n, plural, one {# line} other {# lines}}"` is called as
 * `words.export.lines(3)`. A parameter without a type is a text.
 */
export type Entry = string | readonly Entry[] | { readonly [key: string]: Entry };

type Value<Type extends string> = Type extends "number" ? number : Type extends "boolean" ? boolean : string;
type Parameter<Text extends string> = Text extends `${string}: ${infer Type}` ? Value<Type> : string;
type Parameters<Text extends string> = Text extends `${infer First}, ${infer Rest}`
  ? [Parameter<First>, ...Parameters<Rest>]
  : [Parameter<Text>];

/** What a catalogue is to those who call it: texts, and functions of the parameters that the keys name. */
export type Words<Catalogue> = {
  readonly [Key in keyof Catalogue as Key extends `${infer Name}(${string})`
    ? Name
    : Key]: Key extends `${string}(${infer List})`
    ? (...values: Parameters<List>) => string
    : Catalogue[Key] extends string
      ? string
      : Catalogue[Key] extends readonly unknown[]
        ? Catalogue[Key]
        : Words<Catalogue[Key]>;
};

/** Another language: the keys of English and no others. What is missing stays English, and a test names it. */
export type Translation<Catalogue> = {
  readonly [Key in keyof Catalogue]?: Catalogue[Key] extends string
    ? string
    : Catalogue[Key] extends readonly unknown[]
      ? Catalogue[Key]
      : Translation<Catalogue[Key]>;
};

export interface Signature {
  readonly name: string;
  readonly parameters: readonly { readonly name: string; readonly type: "string" | "number" | "boolean" }[];
}

/** The name and the parameters of a key, or null: "a(b, n: number)" is a, of the text b and the number n. */
export function signatureOf(key: string): Signature | null {
  const [, name, list] = /^([^(]+)\((.+)\)$/.exec(key) ?? [];
  if (name === undefined || list === undefined) return null;
  const parameters = list.split(", ").map(each => {
    const [parameter, type = "string"] = each.split(": ");
    return { name: parameter!, type: type === "number" || type === "boolean" ? type : "string" } as const;
  });
  return { name, parameters };
}

type Elements = ReturnType<IntlMessageFormat["getAst"]>;
type Element = Elements[number];
type Numeric = Extract<Element, { style?: unknown; type: 2 }>;

/** A number is shown as the language shows it, with all its digits and none between thousands. */
const PLAIN = { useGrouping: false, maximumFractionDigits: 15 };

/**
 * A parsed message whose plain numbers are formatted for the language, and whose letters pass through `letters`.
 *
 * @param elements as the ICU parser gives them
 */
function prepared(elements: Elements, numbers: ReadonlySet<string>, letters: (text: string) => string): Elements {
  return elements.map((element): Element => {
    if (element.type === 0) return { ...element, value: letters(element.value) };
    if (element.type === 1 && numbers.has(element.value)) {
      const number: Numeric = {
        type: 2,
        value: element.value,
        style: { type: 0, tokens: [], parsedOptions: PLAIN },
      };
      return number;
    }
    if (element.type === 5 || element.type === 6) {
      const options = Object.entries(element.options).map(
        ([key, option]) => [key, { ...option, value: prepared(option.value, numbers, letters) }] as const,
      );
      return { ...element, options: Object.fromEntries(options) };
    }
    return element;
  });
}

const unchanged = (text: string): string => text;

/**
 * The formatter of one message, parsed here, once.
 *
 * @throws SyntaxError when it is no ICU message
 */
export function compiled(
  text: string,
  { parameters }: Signature,
  locale: string,
  letters: (text: string) => string = unchanged,
): IntlMessageFormat {
  const numbers = new Set(parameters.filter(({ type }) => type === "number").map(({ name }) => name));
  const parsed = new IntlMessageFormat(text, locale, undefined, { ignoreTag: true });
  return new IntlMessageFormat(prepared(parsed.getAst(), numbers, letters), locale);
}

type Call = (...values: readonly (string | number | boolean)[]) => string;

/** How a language says what stands in the catalogue, and what is put into it. */
export interface Speech {
  readonly locale: string;
  /** Changes every text of the catalogue; the pseudo-language marks texts with it. */
  readonly letters?: (text: string) => string;
  /** Says a text that is put into a message: the sentence of a package in this language. */
  readonly said?: (text: string) => string;
}

/** A message as a function of its parameters. It is parsed at the first call. */
function call(text: string, signature: Signature, { locale, letters, said = unchanged }: Speech): Call {
  const names = signature.parameters.map(({ name }) => name);
  let format: IntlMessageFormat | null = null;
  return (...values) => {
    format ??= compiled(text, signature, locale, letters);
    const put = values.map(value => (typeof value === "string" ? said(value) : value));
    return String(format.format(Object.fromEntries(names.map((name, i) => [name, put[i]]))));
  };
}

const isTree = (entry: Entry | undefined): entry is { readonly [key: string]: Entry } =>
  typeof entry === "object" && !Array.isArray(entry);

/** A text, a list or a tree of a catalogue as words: texts stay texts, messages become functions. */
function spoken(entry: Entry, other: Entry | undefined, speech: Speech): unknown {
  const { letters = unchanged } = speech;
  if (typeof entry === "string") return letters(typeof other === "string" ? other : entry);
  if (!isTree(entry))
    return entry.map((each: Entry, i: number) =>
      spoken(each, Array.isArray(other) ? (other as readonly Entry[])[i] : undefined, speech),
    );
  const others = isTree(other) ? other : {};
  return Object.fromEntries(
    Object.entries(entry).map(([key, each]) => {
      const signature = signatureOf(key);
      const translated = others[key];
      return signature && typeof each === "string"
        ? [signature.name, call(typeof translated === "string" ? translated : each, signature, speech)]
        : [key, spoken(each, translated, speech)];
    }),
  );
}

/** The words of a language: each text of `catalogue`, from `translation` where it has it. */
export const wordsOf = <Catalogue extends Entry>(
  catalogue: Catalogue,
  translation: Translation<Catalogue>,
  speech: Speech,
): Words<Catalogue> => spoken(catalogue, translation as Entry, speech) as Words<Catalogue>;
