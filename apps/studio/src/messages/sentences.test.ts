import { readdirSync, readFileSync, statSync } from "node:fs";
import { fileURLToPath } from "node:url";
import ts from "typescript";
import { describe, expect, test } from "vitest";
import { languages, translationOf } from "./languages.ts";
import { patternOf, placesOf, translatorOf } from "./sentences.ts";

const ROOT = fileURLToPath(new URL("../../../../", import.meta.url));
/** Where sentences come from that reach a screen. */
const SOURCES = [
  "packages",
  "apps/server/src/stations",
  "apps/server/src/people",
  "apps/studio/src/runtime",
  "apps/studio/src/workers",
  "apps/studio/src/stores",
];

/** Every sentence of these is translated: what is seen most. */
const COVERED = [
  "packages/core/src/checks/",
  "packages/core/src/kinematics/explain.ts",
  "packages/core/src/kinematics/singularity.ts",
  "packages/core/src/trajectory/stop.ts",
  "packages/controllers/src/refusals.ts",
  "packages/controllers/src/guard/",
  "packages/controllers/src/driver/words.ts",
  "packages/controllers/src/connection/words.ts",
  "packages/controllers/src/cell/words.ts",
  "packages/physics/src/run/",
  "packages/project/src/example/gallery.ts",
  "apps/studio/src/",
];
/** Certificates are read by the command line only. */
const NOT_SHOWN = ["packages/core/src/checks/certificate-file.ts"];

/** Said in parts that no single literal of a source shows. */
const IN_PARTS = [
  "{person} entered “{zone}”.",
  "{person} left “{zone}”.",
  "“{name}” was tripped.",
  "“{name}” is free again.",
  "{place}: {finding} One more place has the same finding.",
  "{place}: {finding} {n} more places have the same finding.",
];

interface Said {
  readonly file: string;
  readonly line: number;
  /** The text; what varies is "{}". */
  readonly text: string;
}

function filesIn(folder: string): readonly string[] {
  return readdirSync(`${ROOT}${folder}`).flatMap(name => {
    const path = `${folder}/${name}`;
    if (name === "node_modules" || name === "testing" || name === "dist") return [];
    if (statSync(ROOT + path).isDirectory()) return filesIn(path);
    return /\.ts$/.test(name) && !/\.test\.ts$/.test(name) ? [path] : [];
  });
}

function textOf(node: ts.Node): string | null {
  if (ts.isStringLiteral(node) || ts.isNoSubstitutionTemplateLiteral(node)) return node.text;
  if (!ts.isTemplateExpression(node)) return null;
  return node.head.text + node.templateSpans.map(({ literal }) => `{}${literal.text}`).join("");
}

function isForPrograms(node: ts.Node): boolean {
  for (let up: ts.Node = node; up.parent; up = up.parent)
    if (ts.isNewExpression(up) && /^(Range|Type|Syntax)?Error$/.test(up.expression.getText())) return true;
  return ts.isImportDeclaration(node.parent) || ts.isExportDeclaration(node.parent);
}

/** A code of a refusal or a fault: "limits.joint". */
const isCode = (node: ts.Node | undefined): node is ts.StringLiteral =>
  node !== undefined && ts.isStringLiteral(node) && /^[a-z\d-]+(\.[a-z\d-]+)+$/.test(node.text);

/**
 * The expressions that give a coded refusal or fault its sentence and its hint: arguments after the code, or the two
 * properties beside it; undefined for any other node.
 */
function codedTexts(node: ts.Node): readonly ts.Node[] | undefined {
  if (ts.isCallExpression(node) || ts.isNewExpression(node)) {
    const [code, ...texts] = node.arguments ?? [];
    return isCode(code) && texts.length >= 2 ? texts : undefined;
  }
  if (!ts.isObjectLiteralExpression(node)) return undefined;
  const property = (name: string): ts.Node | undefined =>
    node.properties.filter(ts.isPropertyAssignment).find(each => each.name.getText() === name)?.initializer;
  const sentence = property("sentence");
  const hint = property("hint");
  return property("code") && sentence && hint ? [sentence, hint] : undefined;
}

/** Every sentence and hint that a source gives a coded refusal or fault. */
function codedIn(file: string): readonly Said[] {
  const root = ts.createSourceFile(file, readFileSync(ROOT + file, "utf8"), ts.ScriptTarget.Latest, true);
  const found: Said[] = [];
  const collect = (node: ts.Node): void => {
    const text = textOf(node);
    if (text === null) ts.forEachChild(node, collect);
    else if (isSentence(text))
      found.push({ file, line: root.getLineAndCharacterOfPosition(node.getStart()).line + 1, text });
  };
  const visit = (node: ts.Node): void => {
    codedTexts(node)?.forEach(collect);
    ts.forEachChild(node, visit);
  };
  visit(root);
  return found;
}

const isSentence = (text: string): boolean => /^[\p{Lu}{“].* .*[.!?]$/su.test(text) && /\p{L}{2,}/u.test(text);

/** Every sentence that a source says: it begins like one and ends with a full stop. */
function saidIn(file: string): readonly Said[] {
  const root = ts.createSourceFile(file, readFileSync(ROOT + file, "utf8"), ts.ScriptTarget.Latest, true);
  const found: Said[] = [];
  const visit = (node: ts.Node): void => {
    const text = textOf(node);
    if (text !== null && isSentence(text) && !isForPrograms(node))
      found.push({ file, line: root.getLineAndCharacterOfPosition(node.getStart()).line + 1, text });
    ts.forEachChild(node, visit);
  };
  visit(root);
  return found;
}

const escaped = (text: string): string => text.replace(/[.*+?^$()|[\]\\]/g, "\\$&");
/** What a source can say, its places anything. */
const sayable = ({ text }: Said): RegExp => new RegExp(`^${text.split("{}").map(escaped).join(".*")}$`, "su");

const ALL = SOURCES.flatMap(filesIn).flatMap(saidIn);
const LOCALES = await Promise.all(
  languages
    .filter(language => language !== "en")
    .map(async language => ({ language, sentences: (await translationOf(language)).sentences })),
);

describe("what packages say", () => {
  test("the sources say sentences, most of them in more than a hundred files", () => {
    expect(ALL.length).toBeGreaterThan(1500);
    expect(new Set(ALL.map(({ file }) => file)).size).toBeGreaterThan(100);
  });

  test.each(LOCALES)(
    "$language: every finding, reason, refusal of the guard and note of a run is translated",
    locale => {
      const keys = Object.keys(locale.sentences);
      const lacking = ALL.filter(
        ({ file }) => COVERED.some(path => file.startsWith(path)) && !NOT_SHOWN.includes(file),
      ).filter(said => {
        const can = sayable(said);
        return !keys.some(key => can.test(key));
      });
      expect(lacking.map(({ file, line, text }) => `${file}:${line} ${text}`)).toEqual([]);
    },
  );

  test.each(LOCALES)("$language: every sentence and hint of a refusal or fault with a code is translated", locale => {
    const keys = Object.keys(locale.sentences);
    const coded = SOURCES.flatMap(filesIn).flatMap(codedIn);
    expect(coded.length).toBeGreaterThan(500);
    const lacking = coded.filter(said => {
      const can = sayable(said);
      return !keys.some(key => can.test(key));
    });
    expect(lacking.map(({ file, line, text }) => `${file}:${line} ${text}`)).toEqual([]);
  });

  test.each(LOCALES)("$language: each translation has the places of its key, and a source that says it", locale => {
    const sources = ALL.map(sayable);
    const wrong = Object.entries(locale.sentences).flatMap(([key, says]) => {
      const places = placesOf(key);
      const used = placesOf(says);
      return [
        ...(used.every(name => places.includes(name)) && places.every(name => used.includes(name))
          ? []
          : [`${key} → ${says}: other places`]),
        // Parts of sentences have no full stop; what is put before a sentence by code is looked at below.
        ...(!/[.!?]$/.test(key) || key.endsWith("}") || IN_PARTS.includes(key) || sources.some(each => each.test(key))
          ? []
          : [`${key}: nobody says it`]),
      ];
    });
    expect(wrong).toEqual([]);
  });

  test.each(LOCALES)(
    "$language: no key is hidden behind another that matches the same sentence with fewer places",
    locale => {
      const say = translatorOf(locale.sentences, ".");
      for (const [key, says] of Object.entries(locale.sentences)) {
        if (!/[.!?]$/.test(key)) continue;
        const names = placesOf(key);
        const sample = key.replace(/\{(\w+)\}/g, (_, name: string) => `q${names.indexOf(name)}q`);
        const wanted = says.replace(/\{(\w+)\}/g, (_, name: string) => `q${names.indexOf(name)}q`);
        expect(patternOf(key).test(sample)).toBe(true);
        expect(say(sample), key).toBe(wanted);
      }
    },
  );
});

test("how much is translated is counted: at least this many of the sentences that packages can say", () => {
  const [german] = LOCALES;
  const keys = Object.keys(german!.sentences);
  // Almost everything matches a text that is hardly more than its places: such are counted when they are a key.
  const letters = (text: string): number => text.replace(/\{\}|[^\p{L}]/gu, "").length;
  const exact = new Set(keys.map(key => key.replace(/\{\w+\}/g, "{}")));
  const translated = ALL.filter(said => {
    if (exact.has(said.text)) return true;
    const can = sayable(said);
    return letters(said.text) >= 12 && keys.some(key => can.test(key));
  });
  process.stdout.write(`German: ${translated.length} of ${ALL.length} sentences of packages are translated\n`);
  expect(translated.length).toBeGreaterThanOrEqual(1000);
});

describe("translating a sentence", () => {
  const say = translatorOf(
    {
      "Joint {n} would turn to {value}; its limit is {limit}.": "Achse {n} würde auf {value} drehen; Grenze {limit}.",
      "{a} touches {b} at {time}.": "{a} berührt {b} bei {time}.",
      "The tool": "Das Werkzeug",
      "{robot} was stopped.": "{robot} wurde angehalten.",
      "Try it again.": "Noch einmal versuchen.",
      "The program ended: {why}": "Das Programm endete: {why}",
    },
    ",",
  );
  test("its numbers get the decimal sign of the language, its parts are translated, names stay", () => {
    expect(say("Joint 3 would turn to 171.5°; its limit is 170.0°.")).toBe(
      "Achse 3 würde auf 171,5° drehen; Grenze 170,0°.",
    );
    expect(say("The tool touches “Table 1.5” at 0.50 s.")).toBe("Das Werkzeug berührt “Table 1.5” bei 0,50 s.");
  });
  test("a sentence within a sentence, after a name, and behind another are translated", () => {
    expect(say("The program ended: UR10e was stopped.")).toBe("Das Programm endete: UR10e wurde angehalten.");
    expect(say("Cell 1: Try it again.")).toBe("Cell 1: Noch einmal versuchen.");
    expect(say("UR10e was stopped. Try it again.")).toBe("UR10e wurde angehalten. Noch einmal versuchen.");
  });
  test("what is not known stays as it was said, and so do versions and addresses", () => {
    expect(say("Nobody knows this.")).toBe("Nobody knows this.");
    expect(say("192.168.0.10 was stopped.")).toBe("192.168.0.10 wurde angehalten.");
  });
});
