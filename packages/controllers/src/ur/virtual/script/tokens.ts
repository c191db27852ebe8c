import { ScriptError, type At } from "./fault.ts";

export interface Token extends At {
  readonly kind: "number" | "text" | "word" | "sign" | "line" | "end";
  readonly text: string;
}

const SPACE = /[ \t\r]+/y;
const COMMENT = /#[^\n]*/y;
const NUMBER = /(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?/y;
const TEXT = /"([^"\n]*)"/y;
const WORD = /[A-Za-z_]\w*/y;
const SIGN = /==|!=|<=|>=|[-+*/%<>=()[\],:;.]/y;

/** The tokens of a script. The end of a line is a token, except inside brackets. */
export function tokensOf(source: string): Token[] {
  const all: Token[] = [];
  let at = 0;
  let line = 1;
  let lineBegan = 0;
  let depth = 0;
  const match = (pattern: RegExp): string | undefined => {
    pattern.lastIndex = at;
    const found = pattern.exec(source)?.[0];
    if (found !== undefined) at += found.length;
    return found;
  };
  while (at < source.length) {
    const place = { line, column: at - lineBegan + 1 };
    if (source[at] === "\n") {
      if (depth === 0) all.push({ ...place, kind: "line", text: "\n" });
      at++;
      line++;
      lineBegan = at;
      continue;
    }
    if (match(SPACE) !== undefined || match(COMMENT) !== undefined) continue;
    const number = match(NUMBER);
    if (number !== undefined) {
      all.push({ ...place, kind: "number", text: number });
      continue;
    }
    const text = match(TEXT);
    if (text !== undefined) {
      all.push({ ...place, kind: "text", text: text.slice(1, -1) });
      continue;
    }
    const word = match(WORD);
    if (word !== undefined) {
      all.push({ ...place, kind: "word", text: word });
      continue;
    }
    const sign = match(SIGN);
    if (sign === undefined) throw new ScriptError(place, `"${source[at]}" stands where no script has it.`);
    if (sign === "(" || sign === "[") depth++;
    if ((sign === ")" || sign === "]") && depth > 0) depth--;
    all.push(sign === ";" ? { ...place, kind: "line", text: sign } : { ...place, kind: "sign", text: sign });
  }
  all.push(
    { line, column: at - lineBegan + 1, kind: "line", text: "\n" },
    { line, column: at - lineBegan + 1, kind: "end", text: "the end of the text" },
  );
  return all;
}
