import type { TextFault } from "../outcomes.ts";

/**
 * Where a text stops being JSON: line and column of the first character that cannot stand there, and what could.
 * Engines word their own syntax errors differently and not all say the line, so the text is walked once more here.
 * Returns undefined for a text that is JSON.
 *
 * @see RFC 8259.
 */
export function jsonFault(text: string): TextFault | undefined {
  const walker = new Walker(text);
  const expected = walker.document();
  if (expected === undefined) return undefined;
  let line = 1;
  let lineStart = 0;
  for (let i = 0; i < walker.at; i++)
    if (text.charCodeAt(i) === 10) {
      line++;
      lineStart = i + 1;
    }
  const column = walker.at - lineStart + 1;
  const found = walker.at < text.length ? `“${shown(text.codePointAt(walker.at) ?? 0)}”` : "the end of the text";
  return {
    line,
    column,
    expected,
    sentence: `Line ${line}, column ${column}: ${expected} was expected, but there is ${found}.`,
  };
}

const shown = (point: number): string =>
  point < 32 ? `\\u${point.toString(16).padStart(4, "0")}` : String.fromCodePoint(point);

/** Each method returns undefined when its piece was read, or what was expected at `at`. */
class Walker {
  readonly text: string;
  at = 0;
  constructor(text: string) {
    this.text = text;
  }

  document(): string | undefined {
    // An explicit stack instead of recursion: a text of a million brackets must not overflow ours.
    const open: ("[" | "{")[] = [];
    this.blanks();
    for (;;) {
      const char = this.text[this.at];
      if (char === "[" || char === "{") {
        this.at++;
        this.blanks();
        if (this.text[this.at] === (char === "[" ? "]" : "}")) this.at++;
        else {
          open.push(char);
          const wrong = char === "{" ? this.key() : undefined;
          if (wrong !== undefined) return wrong;
          continue;
        }
      } else {
        const wrong = this.scalar();
        if (wrong !== undefined) return wrong;
      }
      // A value is complete: close what ends here, then go on behind a comma.
      for (;;) {
        this.blanks();
        const inside = open.at(-1);
        if (inside === undefined) return this.at < this.text.length ? "the end of the text" : undefined;
        const next = this.text[this.at];
        if (next === ",") {
          this.at++;
          this.blanks();
          const wrong = inside === "{" ? this.key() : undefined;
          if (wrong !== undefined) return wrong;
          break;
        }
        if (next !== (inside === "[" ? "]" : "}")) return inside === "[" ? "a comma or ]" : "a comma or }";
        this.at++;
        open.pop();
      }
    }
  }

  private blanks(): void {
    for (
      let c = this.text.charCodeAt(this.at);
      c === 32 || c === 9 || c === 10 || c === 13;
      c = this.text.charCodeAt(this.at)
    )
      this.at++;
  }

  private key(): string | undefined {
    if (this.text[this.at] !== '"') return "a name in double quotes";
    const wrong = this.string();
    if (wrong !== undefined) return wrong;
    this.blanks();
    if (this.text[this.at] !== ":") return "a colon";
    this.at++;
    this.blanks();
    return undefined;
  }

  private scalar(): string | undefined {
    if (this.text[this.at] === '"') return this.string();
    for (const word of ["true", "false", "null"])
      if (this.text.startsWith(word, this.at)) {
        this.at += word.length;
        return undefined;
      }
    const number = /-?(?:0|[1-9][0-9]*)(?:\.[0-9]+)?(?:[eE][+-]?[0-9]+)?/y;
    number.lastIndex = this.at;
    if (!number.test(this.text)) return "a value";
    this.at = number.lastIndex;
    return undefined;
  }

  private string(): string | undefined {
    const start = this.at++;
    for (;;) {
      const code = this.text.charCodeAt(this.at);
      if (Number.isNaN(code)) {
        this.at = start;
        return "a closing quote for this text";
      }
      if (code < 32) return "a closing quote";
      this.at++;
      if (code === 34) return undefined;
      if (code !== 92) continue;
      const escape = /["\\/bfnrt]|u[0-9a-fA-F]{4}/y;
      escape.lastIndex = this.at;
      if (!escape.test(this.text)) return "an escape such as \\n or \\u0041";
      this.at = escape.lastIndex;
    }
  }
}
