import type { TextPlace } from "@twincell/core";
import { TextError } from "./faults.ts";

export interface Token<Kind extends string> extends TextPlace {
  readonly kind: Kind;
  readonly text: string;
}
/** A sticky pattern for each kind of token; `null` for what lies between tokens. The first that matches wins. */
export type TokenRules<Kind extends string> = readonly (readonly [kind: Kind | null, pattern: RegExp])[];

/**
 * The tokens of one line.
 *
 * @param rules  patterns with the flag `y`, none of which matches the empty string.
 * @throws {TextError} at the first character that begins no token.
 */
export function lineTokens<Kind extends string>(text: string, line: number, rules: TokenRules<Kind>): Token<Kind>[] {
  const tokens: Token<Kind>[] = [];
  let at = 0;
  scan: while (at < text.length) {
    for (const [kind, pattern] of rules) {
      pattern.lastIndex = at;
      const match = pattern.exec(text);
      if (match === null || match[0] === "") continue;
      if (kind !== null) tokens.push({ kind, text: match[0], line, column: at + 1 });
      at += match[0].length;
      continue scan;
    }
    const letter = String.fromCodePoint(text.codePointAt(at)!);
    throw new TextError(
      { line, column: at + 1 },
      "a name, a number or a sign of the language",
      `The character "${letter}" has no meaning here.`,
    );
  }
  return tokens;
}
