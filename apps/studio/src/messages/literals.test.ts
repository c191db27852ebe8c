import ts from "typescript";
import { expect, test } from "vitest";

/** All but the words of vendors' languages. */
const files = import.meta.glob<string>(["../**/*.{ts,tsx}", "!../**/*.test.{ts,tsx}", "!./**", "!../ui/syntax.ts"], {
  query: "?raw",
  import: "default",
  eager: true,
});

/** Attributes whose text a person sees or hears. */
const SEEN = new Set(["aria-label", "aria-description", "aria-valuetext", "title", "placeholder", "alt", "label"]);
const WORD = /\p{L}{2,}/u;
/** Units are the same in every language; "M3 14h6" draws a line. */
const NO_WORDS = /^[\s\d…±·×%°/-]*([XYZ]\s)?(mm|cm|ms|kg|Hz|kB|MB|deg|[\s\d…±·×%°,/-])*$|^M[\d.]+[ ,]/u;
/** Begins like a sentence and has words: "No frames", "Joint 3 would jump …". */
const SENTENCE = /^\s*\p{Lu}[\p{L}\d'’-]*[,:]? [^\n]*\p{L}{2,}[^\n]*$/u;
/** Said with `say`, by its English text: sentences.test.ts wants each of them translated. */
const isSaid = (file: string, text: string): boolean => file.endsWith(".ts") && /[.!?]$/.test(text.trim());

const textOf = (node: ts.Node): string | null => {
  if (ts.isStringLiteral(node) || ts.isNoSubstitutionTemplateLiteral(node)) return node.text;
  if (ts.isTemplateExpression(node))
    return [node.head.text, ...node.templateSpans.map(({ literal }) => literal.text)].join("…");
  return null;
};

/** What is thrown is for programmers; what an import or a comparison names is no text; English finds commands too. */
function isForPrograms(node: ts.Node): boolean {
  const { parent } = node;
  if (ts.isImportDeclaration(parent) || ts.isLiteralTypeNode(parent) || ts.isCaseClause(parent)) return true;
  for (let up: ts.Node = node; up.parent; up = up.parent)
    if (ts.isPropertyAssignment(up) && up.name.getText() === "aliases") return true;
    else if (ts.isNewExpression(up) && /Error$/.test(up.expression.getText())) return true;
  return false;
}

/** Every text of a source that a person might see: in elements, in attributes, and sentences anywhere. */
function visibleTexts(file: string, source: string): readonly string[] {
  const root = ts.createSourceFile(file, source, ts.ScriptTarget.Latest, true);
  const found: string[] = [];
  const say = (node: ts.Node, text: string): void => {
    const { line } = root.getLineAndCharacterOfPosition(node.getStart());
    found.push(`${file}:${line + 1} ${text.trim()}`);
  };
  const visit = (node: ts.Node): void => {
    if (ts.isJsxText(node) && WORD.test(node.text) && !NO_WORDS.test(node.text)) say(node, node.text);
    const text = textOf(node);
    if (text !== null && !isForPrograms(node) && !NO_WORDS.test(text) && !isSaid(file, text)) {
      let holder = node.parent;
      while (ts.isJsxExpression(holder) || ts.isConditionalExpression(holder)) holder = holder.parent;
      const isAttribute = ts.isJsxAttribute(holder) && SEEN.has(holder.name.getText());
      if ((isAttribute && WORD.test(text.replace("…", ""))) || SENTENCE.test(text)) say(node, text);
    }
    ts.forEachChild(node, visit);
  };
  visit(root);
  return found;
}

test("no text that a person sees stands outside of the catalogues", () => {
  expect(Object.keys(files).length).toBeGreaterThan(200);
  const found = Object.entries(files).flatMap(([file, source]) => visibleTexts(file.replace("../", ""), source));
  expect(found).toEqual([]);
});
