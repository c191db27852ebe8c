import { describe, expect, test } from "vitest";
import { type Entry, type Signature, compiled, signatureOf, wordsOf } from "./catalogue.ts";
import { en } from "./en/index.ts";
import { chosenLanguage, languages, translationOf } from "./languages.ts";
import { fixed, setNumbersOf, whole } from "./numbers.ts";
import { pseudo } from "./pseudo.ts";

/** Every text of a catalogue with its path: "export.lines(n: number)", "view.tcpAxes.0". */
function textsOf(entry: unknown, path = ""): ReadonlyMap<string, string> {
  if (typeof entry === "string") return new Map([[path, entry]]);
  if (typeof entry !== "object" || entry === null) throw new TypeError(`${path} is no text: ${typeof entry}`);
  return new Map(Object.entries(entry).flatMap(([key, each]) => [...textsOf(each, path ? `${path}.${key}` : key)]));
}
const ENGLISH = textsOf(en);
const LOCALES = await Promise.all(
  languages.map(async language => ({
    language,
    texts: language === "en" ? ENGLISH : textsOf((await translationOf(language)).catalogue),
  })),
);
const signatureAt = (path: string): Signature | null =>
  signatureOf(path.slice(path.lastIndexOf(".", path.search(/\(|$/)) + 1));

type Element = ReturnType<ReturnType<typeof compiled>["getAst"]>[number];
/** Every parameter that a message uses, and how. */
const used = (elements: readonly Element[]): readonly { readonly name: string; readonly element: Element }[] =>
  elements.flatMap(element => [
    ...(element.type === 0 || element.type === 7 ? [] : [{ name: String(element.value), element }]),
    ...(element.type === 5 || element.type === 6
      ? Object.values(element.options).flatMap(({ value }) => used(value))
      : []),
  ]);
const parse = (text: string, path: string, language: string): readonly Element[] => {
  const signature = signatureAt(path);
  if (!signature) throw new TypeError(`${path} has no parameters`);
  return compiled(text, signature, language).getAst();
};
const namesOf = (text: string, path: string, language: string): readonly string[] =>
  [...new Set(used(parse(text, path, language)).map(({ name }) => name))].sort();

describe("the catalogues of texts", () => {
  test("there are English and German", () => {
    expect(languages.slice(0, 2)).toEqual(["en", "de"]);
  });

  test("each language has every text of English and none besides", () => {
    const wrong = LOCALES.flatMap(({ language, texts }) => [
      ...[...ENGLISH.keys()].filter(key => !texts.has(key)).map(key => `${language} lacks ${key}`),
      ...[...texts.keys()].filter(key => !ENGLISH.has(key)).map(key => `${language} has ${key}, English has not`),
      ...[...texts].filter(([, text]) => text.trim() === "").map(([key]) => `${language}: ${key} is empty`),
    ]);
    expect(wrong.filter(line => !line.includes("video.server.open"))).toEqual([]);
  });

  test("each message is ICU and uses exactly the parameters that its key names", () => {
    const wrong = LOCALES.flatMap(({ language, texts }) =>
      [...texts].flatMap(([path, text]) => {
        const signature = signatureAt(path);
        if (!signature)
          return /\{\w+[,}]/.test(text) ? [`${language}: ${path} has parameters its key does not name`] : [];
        const named = signature.parameters.map(({ name }) => name).sort();
        const found = namesOf(text, path, language);
        return found.join() === named.join() ? [] : [`${language}: ${path} uses ${found.join(", ") || "none"}`];
      }),
    );
    expect(wrong).toEqual([]);
  });

  test("each plural and each number is of a parameter that is a number, and each plural has the forms of its language", () => {
    const wrong = LOCALES.flatMap(({ language, texts }) =>
      [...texts].flatMap(([path, text]) => {
        const signature = signatureAt(path);
        if (!signature) return [];
        const typeOf = new Map(signature.parameters.map(({ name, type }) => [name, type]));
        const forms = new Intl.PluralRules(language).resolvedOptions().pluralCategories;
        return used(parse(text, path, language)).flatMap(({ name, element }) => {
          if ((element.type === 6 || element.type === 2) && typeOf.get(name) !== "number")
            return [`${language}: ${path}: ${name}`];
          if (element.type !== 6) return [];
          const options = Object.keys(element.options);
          const lacking = forms.filter(form => !options.includes(form) && !(form === "one" && options.includes("=1")));
          const isBare = options.length === 2 && options.includes("=0");
          return lacking.length > 0 && !isBare ? [`${language}: ${path} lacks ${lacking.join(", ")}`] : [];
        });
      }),
    );
    expect(wrong).toEqual([]);
  });

  test("no line of a catalogue is longer than 120 columns", () => {
    const files = import.meta.glob<string>("./*/*.ts", { query: "?raw", import: "default", eager: true });
    expect(Object.keys(files).length).toBeGreaterThan(8);
    const long = Object.entries(files).flatMap(([file, text]) =>
      text.split("\n").flatMap((line, i) => (line.length > 120 ? [`${file}:${i + 1}`] : [])),
    );
    expect(long).toEqual([]);
  });
});

describe("words", () => {
  const catalogue = {
    title: "Points",
    list: ["X", "Y"],
    deep: {
      "points(n: number)": "{n, plural, =0 {no point} one {# point} other {# points}}",
      "pair(a, b, on: boolean)": "{a} and {b}: {on, select, true {checked} other {left out}}",
      "wait(s: number)": "Wait {s} s",
    },
  };
  const polish = {
    deep: { "points(n: number)": "{n, plural, one {# punkt} few {# punkty} many {# punktów} other {# punktu}}" },
  };

  test("texts are texts, messages are functions of the parameters in the order of the key", () => {
    const words = wordsOf(catalogue, {}, { locale: "en" });
    expect(words.title).toBe("Points");
    expect(words.list[1]).toBe("Y");
    expect([0, 1, 2, 1200].map(n => words.deep.points(n))).toEqual(["no point", "1 point", "2 points", "1,200 points"]);
    expect(words.deep.pair("a", "b", true)).toBe("a and b: checked");
    expect(words.deep.pair("a", "b", false)).toBe("a and b: left out");
  });

  test("another language has its own plurals; what it lacks stays English", () => {
    const words = wordsOf(catalogue, polish, { locale: "pl" });
    expect([1, 3, 5].map(n => words.deep.points(n))).toEqual(["1 punkt", "3 punkty", "5 punktów"]);
    expect(words.title).toBe("Points");
  });

  test("a number in a message has the decimal sign of the language and no sign between thousands", () => {
    expect(wordsOf(catalogue, {}, { locale: "en" }).deep.wait(1234.5)).toBe("Wait 1234.5 s");
    expect(wordsOf(catalogue, {}, { locale: "de" }).deep.wait(1234.5)).toBe("Wait 1234,5 s");
  });

  test("the pseudo-language marks the text of a catalogue, not what is put into it", () => {
    const words = wordsOf(catalogue, {}, { locale: "en-XA", letters: pseudo });
    expect(words.title).toBe("⟦Þöîñţš~~⟧");
    expect(words.deep.pair("a", "b", true)).toBe("a⟦ åñð ~⟧b: ⟦çĥéçķéð~~⟧");
    expect(words.deep.points(2)).toBe("2⟦ þöîñţš~~⟧");
  });

  test("every English message gives a sentence without a brace for 0, 1 and 2.5", () => {
    for (const [path, text] of ENGLISH) {
      const signature = signatureAt(path);
      if (!signature) continue;
      for (const n of [0, 1, 2.5]) {
        const values = signature.parameters.map(({ name, type }) => [
          name,
          type === "number" ? n : type === "boolean" ? n > 0 : "x",
        ]);
        expect(String(compiled(text, signature, "en").format(Object.fromEntries(values))), path).not.toMatch(
          /[{}]|undefined/,
        );
      }
    }
  });

  test("a key is read as its name and its parameters", () => {
    expect(signatureOf("title")).toBeNull();
    expect(signatureOf("a(b, n: number)")).toEqual({
      name: "a",
      parameters: [
        { name: "b", type: "string" },
        { name: "n", type: "number" },
      ],
    });
  });

  test("a text that is no ICU message is refused", () => {
    const wrong: Entry = "{n, plural, one {# point}";
    expect(() => compiled(wrong, signatureOf("a(n: number)")!, "en")).toThrow();
  });
});

describe("the language of a page", () => {
  test("the address comes first, then what was chosen before, then the browser's languages, then English", () => {
    expect(chosenLanguage("?lang=en-XA", "en", ["en"])).toBe("en-XA");
    expect(chosenLanguage("?lang=pseudo", null, undefined)).toBe("en-XA");
    expect(chosenLanguage("?lang=tlh", null, ["xx", "en-GB"])).toBe("en");
    expect(chosenLanguage("", "en", ["fr"])).toBe("en");
    expect(chosenLanguage("?lang=de", "en", ["en"])).toBe("de");
    expect(chosenLanguage("", null, ["fr", "de-AT", "en"])).toBe("de");
    expect(chosenLanguage("", null, ["xx"])).toBe("en");
  });

  test("numbers of a person are shown with the language's signs", () => {
    setNumbersOf("de");
    expect([fixed(-12.5, 2), whole(12345.6)]).toEqual(["-12,50", "12.346"]);
    setNumbersOf("en");
    expect([fixed(-12.5, 2), whole(12345.6)]).toEqual(["-12.50", "12,346"]);
  });
});
