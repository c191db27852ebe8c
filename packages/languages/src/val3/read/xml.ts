import type { TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";

/** A tag, or the text of a CDATA section with where it begins. */
export type XmlPart =
  | (TextPlace & {
      readonly kind: "open" | "close";
      readonly name: string;
      readonly attributes: ReadonlyMap<string, string>;
      readonly isEmpty: boolean;
    })
  | (TextPlace & { readonly kind: "data"; readonly text: string });

const PART =
  /<!\[CDATA\[([^]*?)\]\]>|<!--[^]*?-->|<\?[^]*?\?>|<(\/?)([A-Za-z_][\w:.-]*)((?:\s+[\w:.-]+\s*=\s*(?:"[^"<]*"|'[^'<]*'))*)\s*(\/?)>|</g;
const ATTRIBUTE = /([\w:.-]+)\s*=\s*(?:"([^"]*)"|'([^']*)')/g;
const ENTITIES: Readonly<Record<string, string>> = { lt: "<", gt: ">", amp: "&", quot: '"', apos: "'" };
const plain = (text: string): string =>
  text.includes("&") ? text.replace(/&(lt|gt|amp|quot|apos);/g, (_, name: string) => ENTITIES[name]!) : text;

/** Tags whose text says nothing to the controller. */
const TEXTS: ReadonlySet<string> = new Set(["description", "comment"]);

/**
 * The tags and CDATA sections of XML texts, several documents one behind the other among them.
 *
 * @throws {TextError} at a "<" that begins nothing, or at text outside CDATA.
 */
export function* xmlParts(text: string): Generator<XmlPart, void> {
  let line = 1;
  let lineStart = 0;
  let at = 0;
  let inside = "";
  const goTo = (end: number): TextPlace => {
    for (let i = text.indexOf("\n", at); i >= 0 && i < end; i = text.indexOf("\n", i + 1)) {
      line++;
      lineStart = i + 1;
    }
    at = end;
    return { line, column: end - lineStart + 1 };
  };
  for (const match of text.matchAll(PART)) {
    const between = text.slice(at, match.index);
    const stray = /[^\s\uFEFF]/.exec(between);
    if (stray !== null) {
      // Older files hold their code as text.
      if (inside === "code") yield { kind: "data", text: plain(between), ...goTo(at) };
      else if (!TEXTS.has(inside))
        throw new TextError(goTo(at + stray.index), "a tag", "Text stands outside the tags.");
    }
    const place = goTo(match.index);
    const [whole, data, slash, name, attributes, empty] = match;
    if (whole === "<") throw new TextError(place, "a tag", "The sign < begins no tag here.");
    if (data !== undefined) {
      yield { kind: "data", text: data, ...goTo(match.index + "<![CDATA[".length) };
    } else if (name !== undefined) {
      inside = slash === "/" || empty === "/" ? "" : name;
      yield {
        kind: slash === "/" ? "close" : "open",
        name,
        isEmpty: empty === "/",
        attributes: new Map(
          Array.from(attributes!.matchAll(ATTRIBUTE), ([, key, a, b]) => [key!, plain(a ?? b ?? "")]),
        ),
        ...place,
      };
    }
    goTo(match.index + whole.length);
  }
  const rest = text.slice(at);
  const stray = /[^\s\uFEFF]/.exec(rest);
  if (stray !== null) throw new TextError(goTo(at + stray.index), "a tag", "Text stands outside the tags.");
}
