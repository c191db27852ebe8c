import { Refusal } from "../../refusal.ts";
import { shorten } from "../../xml.ts";

export type Token =
  | { readonly kind: "number"; readonly value: bigint | number }
  | { readonly kind: "text"; readonly value: string }
  | { readonly kind: "name" | "sign"; readonly value: string }
  | { readonly kind: "end"; readonly value: "" };

const SPACE = /[ \t\r\n\f]+/y;
const NUMBER = /0[xX][0-9a-fA-F]+|0[oO][0-7]+|0[bB][01]+|(?:\d[\d_]*\.?[\d_]*|\.\d[\d_]*)(?:[eE][+-]?\d+)?/y;
const NAME = /[A-Za-z_\u00c0-\uffff][\w\u00c0-\uffff]*/y;
const TEXT = /([rRuU]?)(?:"((?:[^"\\]|\\[\s\S])*)"|'((?:[^'\\]|\\[\s\S])*)')/y;
const SIGN = /\*\*|\/\/|<<|>>|<=|>=|==|!=|[-+*/%()[\]{},:.<>=&|^~]/y;
const ESCAPES: Readonly<Record<string, string>> = {
  n: "\n",
  t: "\t",
  r: "\r",
  "\\": "\\",
  "'": "'",
  '"': '"',
  "\n": "",
};

/** The words and signs of an expression, closed by an end token. */
export function tokensOf(text: string): readonly Token[] {
  const tokens: Token[] = [];
  let at = 0;
  const take = (pattern: RegExp): RegExpExecArray | null => {
    pattern.lastIndex = at;
    const match = pattern.exec(text);
    if (match) at += match[0].length;
    return match;
  };
  for (take(SPACE); at < text.length; take(SPACE)) {
    const quoted = take(TEXT);
    if (quoted) {
      const inside = quoted[2] ?? quoted[3] ?? "";
      tokens.push({
        kind: "text",
        value: /r/i.test(quoted[1] ?? "")
          ? inside
          : inside.replace(/\\([\s\S])/g, (whole, letter: string) => ESCAPES[letter] ?? whole),
      });
      continue;
    }
    const number = take(NUMBER);
    if (number) {
      tokens.push({ kind: "number", value: numeral(number[0]) });
      continue;
    }
    const word = take(NAME);
    if (word) {
      tokens.push({ kind: "name", value: word[0] });
      continue;
    }
    const sign = take(SIGN);
    if (!sign)
      throw new Refusal(`“${shorten(text.slice(at))}” is not understood in the expression “${shorten(text)}”.`);
    tokens.push({ kind: "sign", value: sign[0] });
  }
  return [...tokens, { kind: "end", value: "" }];
}

function numeral(text: string): bigint | number {
  const plain = text.replaceAll("_", "");
  return /^0[xob]/i.test(plain) || /^\d+$/.test(plain) ? BigInt(plain) : Number(plain);
}
