import { ScriptError, type ScriptFault } from "./fault.ts";
import { tokensOf, type Token } from "./tokens.ts";
import type { Argument, Expression, Routine, Script, Statement } from "./tree.ts";

export type ScriptRead =
  | { readonly kind: "read"; readonly script: Script }
  | { readonly kind: "not-understood"; readonly fault: ScriptFault };

/** Longer texts are nobody's control program. */
export const LONGEST_SCRIPT = 1 << 20;
/** Blocks and brackets inside each other. */
const DEEPEST = 100;
const BLOCK_ENDS: ReadonlySet<string> = new Set(["end", "elif", "else"]);
/** Words that are no names. */
const KEYWORDS: ReadonlySet<string> = new Set([
  "def",
  "sec",
  "thread",
  "end",
  "if",
  "elif",
  "else",
  "while",
  "return",
  "kill",
  "join",
  "global",
  "local",
  "and",
  "or",
  "xor",
  "not",
]);
const BARE: ReadonlySet<string> = new Set(["break", "continue", "halt", "pass", "enter_critical", "exit_critical"]);
const LEVELS: readonly (readonly string[])[] = [
  ["or", "xor"],
  ["and"],
  ["==", "!=", "<", ">", "<=", ">="],
  ["+", "-"],
  ["*", "/", "%"],
];
/** "not" binds weaker than comparisons and stronger than "and". */
const NOT_LEVEL = 2;

/** Reads one program: `def name(): … end`, `sec name(): … end`, or bare statements. */
export function readScript(text: string): ScriptRead {
  try {
    if (text.length > LONGEST_SCRIPT)
      throw new ScriptError(
        { line: 1, column: 1 },
        `A script has at most ${LONGEST_SCRIPT} letters; this one has ${text.length}.`,
      );
    return { kind: "read", script: new Reader(tokensOf(text)).script() };
  } catch (reason) {
    if (!(reason instanceof ScriptError)) throw reason;
    return { kind: "not-understood", fault: reason.fault };
  }
}

class Reader {
  private readonly tokens: readonly Token[];
  private readonly routines = new Map<string, Routine>();
  private at = 0;
  private depth = 0;
  constructor(tokens: readonly Token[]) {
    this.tokens = tokens;
  }

  private get token(): Token {
    return this.tokens[this.at]!;
  }
  private is(text: string): boolean {
    return this.token.text === text && (this.token.kind === "word" || this.token.kind === "sign");
  }
  private take(): Token {
    const { token } = this;
    if (token.kind !== "end") this.at++;
    return token;
  }
  private taken(text: string): boolean {
    if (!this.is(text)) return false;
    this.at++;
    return true;
  }
  private expect(text: string): void {
    if (!this.taken(text)) throw this.unexpected(`"${text}"`);
  }
  private unexpected(wanted: string): ScriptError {
    const { token } = this;
    const found = token.kind === "line" ? "the end of the line" : token.kind === "end" ? token.text : `"${token.text}"`;
    return new ScriptError(token, `${wanted} is expected, and ${found} stands here.`);
  }
  private word(what: string): string {
    if (this.token.kind !== "word") throw this.unexpected(what);
    return this.take().text;
  }
  private blankLines(): void {
    while (this.token.kind === "line") this.at++;
  }
  private deeper<T>(read: () => T): T {
    if (++this.depth > DEEPEST)
      throw new ScriptError(this.token, `More than ${DEEPEST} blocks and brackets stand inside each other.`);
    const value = read();
    this.depth--;
    return value;
  }

  script(): Script {
    this.blankLines();
    if (this.is("def") || this.is("sec")) {
      const isSecondary = this.is("sec");
      const program = this.routine();
      const { routines } = this;
      this.blankLines();
      if (this.token.kind !== "end") throw this.unexpected("The end of the program");
      return { name: program.name, isSecondary, body: program.body, routines };
    }
    const body = this.statements();
    if (this.token.kind !== "end") throw this.unexpected("A statement");
    return { name: "unnamed", isSecondary: false, body, routines: this.routines };
  }

  /** `def name(a, b):` and its body up to `end`. */
  private routine(): Routine {
    const at = this.take();
    const name = this.word("A name");
    const parameters: string[] = [];
    this.expect("(");
    while (!this.is(")")) {
      parameters.push(this.word("A parameter"));
      if (this.taken("=")) this.expression();
      if (!this.taken(",")) break;
    }
    this.expect(")");
    const body = this.block();
    this.expect("end");
    return { line: at.line, column: at.column, name, isThread: at.text === "thread", parameters, body };
  }

  private block(): Statement[] {
    this.expect(":");
    return this.deeper(() => this.statements());
  }

  private statements(): Statement[] {
    const all: Statement[] = [];
    for (
      this.blankLines();
      this.token.kind !== "end" && !(this.token.kind === "word" && BLOCK_ENDS.has(this.token.text));
      this.blankLines()
    ) {
      if (this.is("def") || this.is("thread")) {
        const routine = this.routine();
        this.routines.set(routine.name, routine);
      } else all.push(this.statement());
    }
    return all;
  }

  private statement(): Statement {
    const { line, column } = this.token;
    const at = { line, column };
    const first = this.token.kind === "word" ? this.token.text : "";
    if (first === "if") return this.decision();
    if (first === "while") {
      this.at++;
      const when = this.expression();
      const body = this.block();
      this.expect("end");
      return { ...at, kind: "while", when, body };
    }
    if (first === "return") {
      this.at++;
      return { ...at, kind: "return", value: this.token.kind === "line" ? undefined : this.expression() };
    }
    if (first === "kill" || first === "join") {
      this.at++;
      return { ...at, kind: first, thread: this.expression() };
    }
    if (BARE.has(first)) {
      this.at++;
      return { ...at, kind: first as "pass" };
    }
    const scope = first === "global" || first === "local" ? first : "nearest";
    if (scope !== "nearest") this.at++;
    const begin = this.at;
    const value = this.expression();
    if (!this.is("=")) {
      if (scope !== "nearest") throw this.unexpected('"="');
      return { ...at, kind: "do", value };
    }
    this.at++;
    if (value.kind === "variable")
      return { ...at, kind: "assign", scope, name: value.name, index: undefined, value: this.expression() };
    if (value.kind === "item" && value.of.kind === "variable")
      return { ...at, kind: "assign", scope, name: value.of.name, index: value.index, value: this.expression() };
    throw new ScriptError(this.tokens[begin]!, "Only a variable or an item of one can be given a value.");
  }

  private decision(): Statement {
    const { line, column } = this.take();
    const arms: { when: Expression; body: readonly Statement[] }[] = [];
    let otherwise: readonly Statement[] = [];
    const arm = (): void => {
      const when = this.expression();
      arms.push({ when, body: this.block() });
    };
    arm();
    while (this.taken("elif")) arm();
    if (this.taken("else")) otherwise = this.block();
    this.expect("end");
    return { line, column, kind: "if", arms, otherwise };
  }

  private expression(level = 0): Expression {
    return this.deeper(() => {
      if (level === NOT_LEVEL && this.is("not")) {
        const { line, column } = this.take();
        const of = this.expression(NOT_LEVEL);
        return { line, column, kind: "unary", sign: "not", of, calls: of.calls };
      }
      if (level === LEVELS.length) return this.unary();
      let left = this.expression(level + 1);
      while ((this.token.kind === "sign" || this.token.kind === "word") && LEVELS[level]!.includes(this.token.text)) {
        const { line, column, text } = this.take();
        const right = this.expression(level + 1);
        left = { line, column, kind: "binary", sign: text, left, right, calls: left.calls || right.calls };
      }
      return left;
    });
  }

  private unary(): Expression {
    // A value may stand on the next line: "x =" goes on there.
    this.blankLines();
    const { line, column, text } = this.token;
    if (this.is("-") || this.is("+") || this.is("not")) {
      this.at++;
      const of = this.deeper(() => this.unary());
      return { line, column, kind: "unary", sign: text as "-", of, calls: of.calls };
    }
    let value = this.primary();
    while (this.is("[")) {
      const at = this.take();
      const index = this.expression();
      this.expect("]");
      value = { line: at.line, column: at.column, kind: "item", of: value, index, calls: value.calls || index.calls };
    }
    return value;
  }

  private primary(): Expression {
    const token = this.take();
    const { line, column } = token;
    const at = { line, column };
    if (token.kind === "number") return { ...at, kind: "constant", value: Number(token.text), calls: false };
    if (token.kind === "text") return { ...at, kind: "constant", value: token.text, calls: false };
    if (token.text === "(" && token.kind === "sign") {
      const value = this.expression();
      this.expect(")");
      return value;
    }
    if (token.text === "[" && token.kind === "sign") return this.list(at, false);
    if (token.kind === "word" && !KEYWORDS.has(token.text) && !BARE.has(token.text)) {
      if (token.text === "True" || token.text === "False")
        return { ...at, kind: "constant", value: token.text === "True", calls: false };
      if (
        token.text === "p" &&
        this.is("[") &&
        this.token.column === column + 1 &&
        this.token.line === line &&
        this.isPoseAhead()
      ) {
        this.at++;
        return this.list(at, true);
      }
      if (token.text === "run") {
        const name = this.word("The name of a thread");
        return { ...at, kind: "run", name, args: this.arguments(), calls: true };
      }
      if (this.is("(")) return { ...at, kind: "call", name: token.text, args: this.arguments(), calls: true };
      return { ...at, kind: "variable", name: token.text, calls: false };
    }
    this.at--;
    throw this.unexpected("A value");
  }

  /** `p[` begins a pose, unless p is a variable whose item is meant: one index stands in its brackets then. */
  private isPoseAhead(): boolean {
    for (let at = this.at + 1, depth = 0; at < this.tokens.length; at++) {
      const { kind, text } = this.tokens[at]!;
      if (kind === "line" || kind === "end") return false;
      if (kind !== "sign") continue;
      if (text === "(" || text === "[") depth++;
      if (text === "," && depth === 0) return true;
      if ((text === ")" || text === "]") && depth-- === 0) return false;
    }
    return false;
  }

  private list(at: { readonly line: number; readonly column: number }, isPose: boolean): Expression {
    const items: Expression[] = [];
    while (!this.is("]")) {
      items.push(this.expression());
      if (!this.taken(",")) break;
    }
    this.expect("]");
    return { ...at, kind: "list", items, isPose, calls: items.some(item => item.calls) };
  }

  private arguments(): Argument[] {
    const all: Argument[] = [];
    this.expect("(");
    while (!this.is(")")) {
      const next = this.tokens[this.at + 1];
      const name =
        this.token.kind === "word" && next?.kind === "sign" && next.text === "=" ? this.take().text : undefined;
      if (name !== undefined) this.at++;
      all.push({ name, value: this.expression() });
      if (!this.taken(",")) break;
    }
    this.expect(")");
    return all;
  }
}
