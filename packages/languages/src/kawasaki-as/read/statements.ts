import type { TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import {
  RecoveringReader,
  readExpression,
  type Argument,
  type Block,
  type Expression,
  type ExpressionRules,
  type Lexicon,
  type Routine,
  type Statement,
  type TokenCursor,
} from "../../parser/structured/index.ts";
import { INSTRUCTIONS, MOTIONS, SHORT, SPEED_UNITS, UNSUPPORTED } from "./words.ts";

const LEXICON: Lexicon = {
  comment: ";",
  quotes: '"',
  doubled: false,
  lineEnds: true,
  signs: [
    "==",
    "<>",
    "<=",
    ">=",
    "=<",
    "=>",
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
    "^",
    "#",
    "@",
    "?",
    "&",
    "!",
  ],
  word: /[#$.]*[A-Za-z_][A-Za-z0-9_.]*/y,
};

export const RESERVED: ReadonlySet<string> = new Set([
  "and",
  "or",
  "not",
  "xor",
  "mod",
  "if",
  "then",
  "else",
  "elseif",
  "end",
  "while",
  "do",
  "until",
  "for",
  "to",
  "step",
  "case",
  "of",
  "value",
  "any",
  "by",
  "goto",
  "call",
  "return",
  "point",
  ".program",
  ".end",
  ".trans",
  ".joints",
  ".reals",
  ".strings",
]);

export const RULES: ExpressionRules = {
  binary: {
    or: 1,
    xor: 1,
    and: 2,
    "==": 4,
    "<>": 4,
    "<": 4,
    ">": 4,
    "<=": 4,
    ">=": 4,
    "=<": 4,
    "=>": 4,
    "+": 5,
    "-": 5,
    "*": 6,
    "/": 6,
    mod: 6,
    "^": 8,
  },
  prefix: { not: 3, "-": 7, "+": 7, "#": 9 },
  constants: { true: true, on: true, false: false, off: false },
  tags: [],
  index: "[",
  components: false,
  reserved: RESERVED,
  args: readArguments,
};

/** Statements of AS and the blocks they stand in. */
export abstract class StatementReader extends RecoveringReader {
  protected readonly routines = new Map<string, Routine>();
  protected readonly called = new Set<string>();

  protected readonly lists: Statement[] = [];
  private readonly words = new Map<string, string>();

  constructor(text: string) {
    super(text, LEXICON);
  }

  /** Capitals count for nothing. The words of a long text are few. */
  protected override folded(word: string): string {
    const known = this.words.get(word);
    if (known !== undefined) return known;
    const small = word.toLowerCase();
    this.words.set(word, small);
    return small;
  }

  protected body(opened: string, at: TextPlace, ends: readonly string[]): Block {
    const { cursor } = this;
    return this.nested(at, () => {
      const statements: Statement[] = [];
      for (;;) {
        if (cursor.isAt("line-end")) {
          this.guard(() => {
            cursor.advance();
          });
          continue;
        }
        this.takeComments(statements);
        if (cursor.kind === "word" && ends.includes(cursor.next)) break;
        if (cursor.done || cursor.next === ".program" || cursor.next === ".end")
          throw new TextError(cursor.here, ends[0]!.toUpperCase(), `The ${opened} of line ${at.line} is not closed.`);
        if (this.hasEnough) break;
        const statement = this.guard(() => {
          const read = this.statement();
          if (!cursor.isAt("line-end") && !cursor.done) throw cursor.unexpected("the end of the line");
          return read;
        });
        if (statement !== undefined) statements.push(statement);
      }
      return withBreaks(statements);
    });
  }

  private statement(): Statement | undefined {
    const { cursor } = this;
    // The number of a step, which only GOTO speaks of.
    if (cursor.isAt("number")) cursor.advance();
    if (cursor.isAt("line-end")) return undefined;
    const at = cursor.here;
    const word = cursor.next;
    if (cursor.kind !== "word") throw cursor.unexpected("a statement");
    switch (word) {
      case "if":
        cursor.advance();
        return this.branches(at);
      case "while": {
        cursor.advance();
        const when = readExpression(cursor, RULES);
        cursor.accept("do");
        const body = this.body("WHILE", at, ["end"]);
        cursor.expect("end");
        return { kind: "while", when, body, ...at };
      }
      case "do":
        cursor.advance();
        return this.untilLoop(at);
      case "for":
        cursor.advance();
        return this.counting(at);
      case "case":
        cursor.advance();
        return this.choice(at);
      case "call": {
        cursor.advance();
        const place = cursor.here;
        const name = cursor.name("the name of a program");
        this.called.add(name);
        const args = cursor.accept("(") ? readArguments(cursor, 0) : [];
        return { kind: "do", name: `call ${name}`, args, ...place };
      }
      case "return":
        cursor.advance();
        return { kind: "return", ...at };
      case "halt":
      case "stop":
        cursor.advance();
        return { kind: "halt", ...at };
      case "point":
        cursor.advance();
        return this.assignment(at);
      case "swait": {
        cursor.advance();
        let when: Expression | undefined;
        do {
          const value = readExpression(cursor, RULES);
          const one: Expression = { kind: "call", name: "sig", args: [{ value, ...at }], ...at };
          when = when === undefined ? one : { kind: "binary", sign: "and", left: when, right: one, ...at };
        } while (cursor.accept(","));
        return { kind: "wait-until", when, ...at };
      }
      default:
        break;
    }
    return this.byName(at, word);
  }

  /** Statements that begin with a name, and instructions. */
  private byName(at: TextPlace, word: string): Statement | undefined {
    const { cursor } = this;
    if (Object.hasOwn(UNSUPPORTED, word))
      throw new TextError(at, "a statement of the motion program", UNSUPPORTED[word]!);
    if (RESERVED.has(word)) throw cursor.unexpected("a statement");
    const { second } = cursor;
    if (second === "=" || (second === "[" && !INSTRUCTIONS.has(word))) return this.assignment(at);
    if (second === ":") {
      cursor.advance();
      cursor.advance();
      return undefined;
    }
    if (second === "on" || second === "off") return this.switched(at);
    if (!INSTRUCTIONS.has(word))
      throw new TextError(at, "a statement of AS", `"${cursor.raw}" is no statement of AS that is understood here.`);
    return this.instruction(at);
  }

  /** `CP OFF` */
  private switched(at: TextPlace): Statement {
    const { cursor } = this;
    const place = cursor.here;
    const name = cursor.take();
    const value: Expression = { kind: "truth", value: cursor.take() === "on", ...place };
    return {
      kind: "do",
      name: "switch",
      args: [
        { value: { kind: "text", value: name, ...place }, ...place },
        { value, ...place },
      ],
      ...at,
    };
  }

  private instruction(at: TextPlace): Statement {
    const { cursor } = this;
    const word = cursor.take();
    const name = SHORT[word] ?? word;
    const args: Argument[] = [];
    const mark = (mark: string, value: string, place: TextPlace): void => {
      args.push({ name: mark, value: { kind: "text", value, ...place }, ...place });
    };
    if (name === "print" || name === "type") {
      // A number and a colon choose the window.
      if (cursor.second === ":") {
        cursor.advance();
        cursor.advance();
      }
    }
    while (!cursor.isAt("line-end") && !cursor.done) {
      const place = cursor.here;
      if (cursor.next === "/" && name === "print") {
        cursor.advance();
        cursor.advance();
        cursor.accept(",");
        continue;
      }
      args.push({
        value: isLeftOut(cursor) ? { kind: "number", value: 0, ...place } : readExpression(cursor, RULES),
        ...place,
      });
      if (name === "decompose" && cursor.accept("=")) continue;
      if (cursor.accept(",")) {
        if (cursor.isAt("line-end")) throw cursor.unexpected("a value");
        continue;
      }
      if (name === "speed") this.unit(mark);
      for (const said of ["always", "fine"])
        if (cursor.next === said && cursor.kind === "word") {
          mark(said, said, cursor.here);
          cursor.advance();
        }
      break;
    }
    return { kind: "do", name, args, ...at };
  }

  /** `MM/S`, `MM/MIN`, `S` behind a speed. */
  private unit(mark: (mark: string, value: string, place: TextPlace) => void): void {
    const { cursor } = this;
    const place = cursor.here;
    if (cursor.kind !== "word" || cursor.next === "always") return;
    let unit = cursor.take();
    if (cursor.accept("/")) unit += `/${cursor.name("a unit of time")}`;
    if (!Object.hasOwn(SPEED_UNITS, unit))
      throw new TextError(place, "MM/S, MM/MIN, CM/MIN or S", `"${unit.toUpperCase()}" is no unit of a speed.`);
    mark("unit", unit, place);
  }

  private assignment(at: TextPlace): Statement {
    const { cursor } = this;
    if (cursor.kind !== "word" || RESERVED.has(cursor.next)) throw cursor.unexpected("the name of a variable");
    const to = readExpression(cursor, RULES, 0, 100);
    cursor.expect("=");
    return { kind: "assign", to, value: readExpression(cursor, RULES), global: false, ...at };
  }

  private branches(at: TextPlace): Statement {
    const { cursor } = this;
    const branches: { when: Expression; body: Block }[] = [];
    for (;;) {
      const when = readExpression(cursor, RULES);
      if (cursor.next === "goto") throw new TextError(cursor.here, "THEN", UNSUPPORTED["goto"]!);
      cursor.expect("then");
      branches.push({ when, body: this.body("IF", at, ["end", "elseif", "else"]) });
      if (!cursor.accept("elseif")) break;
    }
    const otherwise = cursor.accept("else") ? this.body("IF", at, ["end"]) : undefined;
    cursor.expect("end");
    return otherwise === undefined ? { kind: "if", branches, ...at } : { kind: "if", branches, otherwise, ...at };
  }

  /** DO … UNTIL goes through its body once before it asks. */
  private untilLoop(at: TextPlace): Statement {
    const { cursor } = this;
    const body = this.body("DO", at, ["until"]);
    cursor.expect("until");
    const place = cursor.here;
    const of = readExpression(cursor, RULES);
    const again: Statement = { kind: "while", when: { kind: "unary", sign: "not", of, ...place }, body, ...at };
    return { kind: "if", branches: [{ when: { kind: "truth", value: true, ...at }, body: [...body, again] }], ...at };
  }

  private counting(at: TextPlace): Statement {
    const { cursor } = this;
    const variable = cursor.name("the name of the loop variable");
    cursor.expect("=");
    const from = readExpression(cursor, RULES);
    cursor.expect("to");
    const to = readExpression(cursor, RULES);
    const one: Expression = { kind: "number", value: 1, ...at };
    const step = cursor.accept("step") ? readExpression(cursor, RULES) : one;
    const body = this.body("FOR", at, ["end"]);
    cursor.expect("end");
    return { kind: "for", variable, from, to, step, body, ...at };
  }

  /** CASE … OF is a chain of comparisons. */
  private choice(at: TextPlace): Statement {
    const { cursor } = this;
    const of = readExpression(cursor, RULES);
    const branches: { when: Expression; body: Block }[] = [];
    const ends = ["end", "value", "any"];
    cursor.expect("of");
    this.body("CASE", at, ends);
    let otherwise: Block | undefined;
    while (!cursor.accept("end")) {
      if (cursor.accept("any")) {
        cursor.accept(":");
        otherwise = this.body("CASE", at, ends);
        continue;
      }
      cursor.expect("value");
      let when: Expression | undefined;
      do {
        const right = readExpression(cursor, RULES);
        const equal: Expression = {
          kind: "binary",
          sign: "==",
          left: of,
          right,
          line: right.line,
          column: right.column,
        };
        when =
          when === undefined
            ? equal
            : { kind: "binary", sign: "or", left: when, right: equal, line: right.line, column: right.column };
      } while (cursor.accept(","));
      cursor.accept(":");
      branches.push({ when, body: this.body("CASE", at, ends) });
    }
    return { kind: "if", branches, ...(otherwise === undefined ? {} : { otherwise }), ...at };
  }
}

/** A move with BREAK behind it stops at its target: the mark goes to the move. */
function withBreaks(block: readonly Statement[]): Block {
  let move = -1;
  const marked: Statement[] = [];
  for (const statement of block) {
    if (statement.kind === "do" && statement.name === "break" && move >= 0) {
      const moved = marked[move]!;
      if (moved.kind === "do")
        marked[move] = {
          ...moved,
          args: [...moved.args, { name: "break", line: statement.line, column: statement.column }],
        };
    }
    if (statement.kind !== "comment")
      move = statement.kind === "do" && MOTIONS.has(statement.name) ? marked.length : -1;
    marked.push(statement);
  }
  return marked;
}

/** A value that is left out between commas is 0. */
const isLeftOut = (cursor: TokenCursor): boolean =>
  cursor.kind === "sign" && (cursor.next === "," || cursor.next === ")");

/** `a, b)` behind an opening bracket; SHIFT has BY in place of a comma. */
function readArguments(cursor: TokenCursor, depth: number): readonly Argument[] {
  const args: Argument[] = [];
  if (cursor.accept(")")) return args;
  do {
    const at = cursor.here;
    cursor.accept("&");
    args.push({
      value: isLeftOut(cursor) ? { kind: "number", value: 0, ...at } : readExpression(cursor, RULES, depth + 1),
      ...at,
    });
  } while (cursor.accept(",") || cursor.accept("by"));
  cursor.expect(")");
  return args;
}
