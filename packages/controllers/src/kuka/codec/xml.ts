/**
 * The little XML that RSI speaks: one root, elements with attributes, text, comments and the five named characters. No
 * document types, no instructions but the declaration in front; everything is bounded.
 */
export interface XmlElement {
  readonly name: string;
  readonly attributes: ReadonlyMap<string, string>;
  readonly children: readonly XmlElement[];
  readonly text: string;
}
export type XmlRead =
  | { readonly kind: "read"; readonly root: XmlElement }
  | { readonly kind: "not-understood"; readonly at: number; readonly expected: string };

const DEEPEST = 16;
const MOST_ELEMENTS = 2048;
const LONGEST = 262_144;
const NAMED: Readonly<Record<string, string>> = { lt: "<", gt: ">", amp: "&", quot: '"', apos: "'" };
const NAME = /[A-Za-z_:][A-Za-z0-9_:.-]*/y;
const BLANK = /[ \t\r\n]*/y;
const VALUE = /"([^"<]*)"|'([^'<]*)'/y;
const TEXT = /[^<]+/y;

/** Never throws. @returns the root, or where something else was expected. */
export function readXml(text: string): XmlRead {
  let at = 0;
  let count = 0;
  class Expected extends Error {}
  const fail = (expected: string): never => {
    throw new Expected(expected);
  };
  const match = (pattern: RegExp): RegExpExecArray | null => {
    pattern.lastIndex = at;
    const found = pattern.exec(text);
    if (found) at = pattern.lastIndex;
    return found;
  };
  const skip = (): void => {
    match(BLANK);
  };
  const take = (sign: string): boolean => {
    if (!text.startsWith(sign, at)) return false;
    at += sign.length;
    return true;
  };
  const plain = (raw: string): string =>
    raw.includes("&")
      ? raw.replace(/&([A-Za-z]*);?/g, (_, name: string) => NAMED[name] ?? fail("a named character"))
      : raw;
  const comments = (): void => {
    for (skip(); take("<!--"); skip()) {
      const end = text.indexOf("-->", at);
      if (end < 0) fail("the end of the comment");
      at = end + 3;
    }
  };

  function element(depth: number): XmlElement {
    if (!take("<")) fail("an element");
    const name = match(NAME)?.[0] ?? fail("the name of an element");
    const attributes = new Map<string, string>();
    const children: XmlElement[] = [];
    if (depth > DEEPEST || ++count > MOST_ELEMENTS) fail("fewer elements");
    let content = "";
    for (skip(); !take("/>"); skip()) {
      if (take(">")) {
        content = inside(name, children, depth);
        break;
      }
      const key = match(NAME)?.[0] ?? fail("an attribute or the end of the element");
      skip();
      if (!take("=")) fail("=");
      skip();
      const value = match(VALUE) ?? fail("a value in quotes");
      if (attributes.has(key)) fail("each attribute once");
      attributes.set(key, plain(value[1] ?? value[2]!));
    }
    return { name, attributes, children, text: content };
  }
  function inside(name: string, children: XmlElement[], depth: number): string {
    let content = "";
    for (;;) {
      content += plain(match(TEXT)?.[0] ?? "");
      if (text.startsWith("<!--", at)) comments();
      else if (take("</")) {
        if (!take(name)) fail(`the end of ${name}`);
        skip();
        if (!take(">")) fail(">");
        return content.trim();
      } else children.push(element(depth + 1));
    }
  }

  if (text.length > LONGEST) return { kind: "not-understood", at: LONGEST, expected: "a shorter text" };
  try {
    skip();
    if (take("<?xml")) {
      const end = text.indexOf("?>", at);
      at = end < 0 ? fail("?>") : end + 2;
    }
    comments();
    const root = element(0);
    comments();
    if (at < text.length) fail("the end");
    return { kind: "read", root };
  } catch (reason) {
    if (reason instanceof Expected) return { kind: "not-understood", at, expected: reason.message };
    throw reason;
  }
}

export const xmlText = (value: string): string =>
  value.replace(/[<>&"']/g, sign => `&${Object.entries(NAMED).find(([, plain]) => plain === sign)![0]};`);
