import type { TextFault, TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import {
  BINDS_AS_C,
  RecoveringReader,
  readExpression,
  type Argument,
  type Block,
  type Expression,
  type ExpressionRules,
  type Lexicon,
  type Parameter,
  type Routine,
  type Statement,
  type TokenCursor,
} from "../../parser/structured/index.ts";

const LEXICON: Lexicon = {
  comment: "#",
  quotes: "\"'",
  doubled: false,
  lineEnds: true,
  signs: [
    "==",
    "!=",
    "<=",
    ">=",
    "(",
    ")",
    "[",
    "]",
    ",",
    ":",
    "=",
    "<",
    ">",
    "+",
    "-",
    "*",
    "/",
    "%",
    ".",
    "$",
    "@",
    ";",
  ],
};
export const RESERVED: ReadonlySet<string> = new Set([
  "and",
  "or",
  "not",
  "xor",
  "if",
  "elif",
  "else",
  "while",
  "def",
  "thread",
  "end",
  "return",
  "break",
  "continue",
  "global",
  "local",
  "halt",
  "run",
  "kill",
  "join",
  "sec",
  "enter_critical",
  "exit_critical",
  "True",
  "False",
  "pass",
]);
const RULES: ExpressionRules = {
  binary: BINDS_AS_C,
  prefix: { not: 3, "-": 7, "+": 7 },
  constants: { True: true, False: false },
  tags: ["p"],
  index: "[",
  components: true,
  reserved: RESERVED,
  args: readArguments,
};

/**
 * A text that was read: what a person called it, routines by name, and what stands in the program itself or, for a bare
 * script, outside all of them.
 */
export interface Source {
  readonly title: string;
  readonly routines: ReadonlyMap<string, Routine>;
  readonly main: Block;
  /** What the program that is started wants to be given. */
  readonly parameters: readonly Parameter[];
  /** Tasks beside the program, which are kept and not executed. */
  readonly threads: ReadonlyMap<string, Routine>;
}
export type SourceAnswer =
  | { readonly kind: "source"; readonly source: Source }
  | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] };

/** Reads URScript. Goes on after a fault, so that all of them are told at once. */
export const readSource = (text: string): SourceAnswer => new Reader(text).source();

class Reader extends RecoveringReader {
  private readonly routines = new Map<string, Routine>();
  private readonly threads = new Map<string, Routine>();

  constructor(text: string) {
    super(text, LEXICON);
  }

  protected override folded(word: string): string {
    return word;
  }

  source(): SourceAnswer {
    const loose: Statement[] = [];
    const defined: Routine[] = [];
    this.guard(() => {
      this.cursor.advance();
    });
    while (!this.cursor.done && !this.hasEnough) {
      this.takeComments(loose);
      const first = this.routines.size;
      const statement = this.line();
      if (statement !== undefined) loose.push(statement);
      if (this.routines.size > first) defined.push([...this.routines.values()].at(-1)!);
    }
    if (this.faults.length > 0) return { kind: "not-understood", faults: this.faults };
    // What stands outside runs; otherwise the program is the one definition, which the controller starts by itself.
    const entry = defined.at(-1);
    if (loose.some(({ kind }) => kind !== "comment") || entry === undefined)
      return {
        kind: "source",
        source: {
          title: titleOf(loose) ?? entry?.name ?? "Program",
          routines: this.routines,
          main: loose,
          parameters: [],
          threads: this.threads,
        },
      };
    this.routines.delete(entry.name);
    return {
      kind: "source",
      source: {
        title: titleOf(entry.body) ?? entry.name,
        routines: this.routines,
        main: entry.body,
        parameters: entry.parameters,
        threads: this.threads,
      },
    };
  }

  /** One statement with the end of its line; undefined for an empty line, a label, a definition and a fault. */
  private line(): Statement | undefined {
    const { cursor } = this;
    return this.guard(() => {
      if (cursor.kind === "line-end" || cursor.next === ";") {
        cursor.advance();
        return undefined;
      }
      // `$ 5 "A"` names the node of the pendant's program; `@` marks belong to its tools.
      if (cursor.next === "$" || cursor.next === "@") {
        cursor.skip(each => each.kind === "line-end");
        return undefined;
      }
      const statement = this.statement();
      // `if c: movej(q) end` closes its block in the line that opens it.
      const closes = cursor.isAt("word") && CLOSES.has(cursor.next);
      if (!cursor.isAt("end") && cursor.next !== ";" && !closes) {
        if (!cursor.isAt("line-end")) throw cursor.unexpected("the end of the statement");
        cursor.advance();
      }
      return statement;
    });
  }

  private body(opened: string, at: TextPlace, ends: readonly string[]): Block {
    const { cursor } = this;
    return this.nested(at, () => {
      const statements: Statement[] = [];
      while (!ends.includes(cursor.next)) {
        if (cursor.done || this.hasEnough)
          throw new TextError(cursor.here, "end", `The ${opened} of line ${at.line} is not closed.`);
        this.takeComments(statements);
        if (ends.includes(cursor.next)) break;
        const statement = this.line();
        if (statement !== undefined) statements.push(statement);
      }
      this.takeComments(statements);
      return statements;
    });
  }

  private statement(): Statement | undefined {
    const { cursor } = this;
    const at = cursor.here;
    const word = cursor.next;
    if (cursor.kind !== "word") throw cursor.unexpected("a statement");
    switch (word) {
      case "def":
        cursor.advance();
        this.definition(at, this.routines);
        return undefined;
      case "thread":
        cursor.advance();
        this.definition(at, this.threads);
        return undefined;
      case "run":
        return { kind: "do", name: "run", args: [{ value: this.started(), ...at }], ...at };
      case "kill":
      case "join":
        cursor.advance();
        return { kind: "do", name: word, args: [{ value: readExpression(cursor, RULES), ...at }], ...at };
      case "enter_critical":
      case "exit_critical":
        // Holds the other tasks back for a while: the program itself goes on as it stands.
        cursor.advance();
        return undefined;
      case "if":
        cursor.advance();
        return this.branches(at);
      case "while": {
        cursor.advance();
        const when = readExpression(cursor, RULES);
        cursor.expect(":");
        const body = this.body("while", at, ["end"]);
        cursor.expect("end");
        return asWait({ kind: "while", when, body, ...at });
      }
      default:
        return this.ending(at, word);
    }
  }

  /** Statements that end something, and those that begin with a name. */
  private ending(at: TextPlace, word: string): Statement | undefined {
    const { cursor } = this;
    switch (word) {
      case "return": {
        cursor.advance();
        return cursor.isAt("line-end") || cursor.done
          ? { kind: "return", ...at }
          : { kind: "return", value: readExpression(cursor, RULES), ...at };
      }
      case "break":
      case "continue":
      case "halt":
        cursor.advance();
        return { kind: word, ...at };
      case "pass":
        cursor.advance();
        return undefined;
      case "global":
      case "local":
        cursor.advance();
        return this.assignment(at, word === "global");
      case "sec":
        throw new TextError(
          at,
          "a statement of one task",
          `"${word}" belongs to threads, which are not executed here.`,
        );
      default:
        break;
    }
    if (RESERVED.has(word))
      throw cursor.unexpected(word === "end" ? "a statement, since no block is open" : "a statement");
    if (cursor.second === ".") {
      const called = readExpression(cursor, RULES);
      if (called.kind !== "call") throw cursor.unexpected('"(" behind the name of what is called');
      return { kind: "do", name: called.name, args: called.args, ...at };
    }
    if (cursor.second !== "(") return this.assignment(at, false);
    cursor.advance();
    cursor.advance();
    return { kind: "do", name: word, args: readArguments(cursor, 0), ...at };
  }

  private assignment(at: TextPlace, global: boolean): Statement {
    const { cursor } = this;
    const word = cursor.raw;
    if (cursor.kind !== "word" || RESERVED.has(cursor.next)) throw cursor.unexpected("the name of a variable");
    const second = cursor.second;
    if (second !== "=" && second !== "[") {
      throw new TextError(
        at,
        "a statement of URScript",
        `"${word}" is no statement of URScript that is understood here.`,
      );
    }
    const to = readExpression(cursor, RULES, 0, 100);
    cursor.expect("=");
    const value = cursor.next === "run" ? this.started() : readExpression(cursor, RULES);
    return { kind: "assign", to, value, global, ...at };
  }

  /** `run NAME()`: a task that is started beside the program; its handle is its name. */
  private started(): Expression {
    const { cursor } = this;
    const { line, column } = cursor.here;
    cursor.advance();
    const name = cursor.name("the name of a thread");
    cursor.expect("(");
    readArguments(cursor, 0);
    return { kind: "text", value: name, line, column };
  }

  private branches(at: TextPlace): Statement {
    const { cursor } = this;
    const branches: { when: Expression; body: Block }[] = [];
    for (;;) {
      const when = readExpression(cursor, RULES);
      cursor.expect(":");
      branches.push({ when, body: this.body("if", at, ["end", "elif", "else"]) });
      if (!cursor.accept("elif")) break;
    }
    let otherwise: Block | undefined;
    if (cursor.accept("else")) {
      cursor.expect(":");
      otherwise = this.body("if", at, ["end"]);
    }
    cursor.expect("end");
    return otherwise === undefined ? { kind: "if", branches, ...at } : { kind: "if", branches, otherwise, ...at };
  }

  private definition(at: TextPlace, into: Map<string, Routine>): void {
    const { cursor } = this;
    const place = cursor.here;
    const name = cursor.name("the name of the program");
    if (RESERVED.has(name))
      throw new TextError(place, "a name that is no word of the language", `"${name}" is a word of URScript.`);
    const parameters: Parameter[] = [];
    cursor.expect("(");
    while (!cursor.accept(")")) {
      const parameter = cursor.name("the name of a parameter");
      parameters.push(
        cursor.accept("=")
          ? { name: parameter, type: "", value: readExpression(cursor, RULES) }
          : { name: parameter, type: "" },
      );
      if (!cursor.accept(",") && cursor.next !== ")") throw cursor.unexpected('"," or ")"');
    }
    cursor.expect(":");
    // Script files that are taken in twice define their programs anew: the last one counts.
    const body = this.body(`def ${name}`, at, ["end"]);
    cursor.expect("end");
    into.set(name, { name, parameters, body, ...place });
  }
}

/** `a, b=2)` behind an opening bracket. */
function readArguments(cursor: TokenCursor, depth: number): readonly Argument[] {
  const args: Argument[] = [];
  if (cursor.accept(")")) return args;
  do {
    const at = cursor.here;
    if (cursor.kind === "word" && cursor.second === "=") {
      const name = cursor.take();
      cursor.advance();
      args.push({ name, value: readExpression(cursor, RULES, depth + 1), ...at });
    } else args.push({ value: readExpression(cursor, RULES, depth + 1), ...at });
  } while (cursor.accept(","));
  cursor.expect(")");
  return args;
}

/** `#* Title` at the top. */
function titleOf(block: Block): string | undefined {
  const first = block[0];
  return first?.kind === "comment" && first.text.startsWith("*") ? first.text.slice(1).trim() : undefined;
}

const CLOSES: ReadonlySet<string> = new Set(["end", "elif", "else"]);
/** Instructions that only let time pass. */
const IDLE = new Set(["sync", "sleep"]);

/** `while (not input): sync() end` rests until the input is there: no loop to whoever reads it. */
function asWait(loop: Extract<Statement, { kind: "while" }>): Statement {
  const { when, body, line, column } = loop;
  const steps = body.filter(({ kind }) => kind !== "comment");
  if (steps.length === 0 || !steps.every(each => each.kind === "do" && IDLE.has(each.name)) || !readsInput(when))
    return loop;
  return {
    kind: "wait-until",
    when:
      when.kind === "unary" && when.sign === "not" ? when.of : { kind: "unary", sign: "not", of: when, line, column },
    line,
    column,
  };
}

function readsInput(expression: Expression): boolean {
  switch (expression.kind) {
    case "call":
      return /^get_.*(digital|analog)_(in|out)$/.test(expression.name);
    case "unary":
      return readsInput(expression.of);
    case "binary":
      return readsInput(expression.left) || readsInput(expression.right);
    default:
      return false;
  }
}
