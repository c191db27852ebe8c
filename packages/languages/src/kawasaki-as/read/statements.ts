import type { TextFault, TextPlace } from "@twincell/core";
import { TextError, textFault } from "../../parser/index.ts";
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
import { AWAY, INSTRUCTIONS, KEPT, MOTIONS, RECEIVES, SHORT, SPEED_UNITS, UNSUPPORTED } from "./words.ts";

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
  // `.&p[,]` hands all places of a row to a program.
  word: /[#$.]*&?[A-Za-z_][A-Za-z0-9_.]*(?:\[[ ,]*\])?/y,
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
  "svalue",
  "scase",
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
  /** Whether the text is only executed: what does not move the arm may be left out then, and is told. */
  protected readonly asText: boolean;
  /** Lists of lines name places that GOTO goes to only where one does. */
  private readonly jumps: boolean;
  /** Labels of the program that is read, and the jumps to them. */
  private readonly labels = new Set<string>();
  private gotos: (TextPlace & { readonly label: string })[] = [];
  /** Statements that are kept and not executed. */
  protected readonly kept: TextFault[] = [];

  constructor(text: string, asText: boolean) {
    super(text, LEXICON);
    this.asText = asText;
    this.jumps = /\bGOTO\b/i.test(text);
  }

  /** Capitals count for nothing. The words of a long text are few. */
  protected override folded(word: string): string {
    const known = this.words.get(word);
    if (known !== undefined) return known;
    const small = word.toLowerCase().replace("&", "").replace(/\[.*/, "[]");
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
          this.label(statements);
          const read = this.statement();
          if (!cursor.isAt("line-end") && !cursor.done) throw cursor.unexpected("the end of the line");
          return read;
        });
        if (statement !== undefined) statements.push(statement);
      }
      return withBreaks(statements);
    });
  }

  /** At the end of a program: jumps to labels that it does not have are told. */
  protected endOfProgram(): void {
    for (const { label, ...at } of this.gotos)
      if (!this.labels.has(label))
        this.faults.push(textFault(at, "a label of the program", `There is no label ${label} in this program.`));
    this.gotos = [];
    this.labels.clear();
  }

  /** `100` or `name:` before a step, which only GOTO speaks of. */
  private label(into: Statement[]): void {
    const { cursor } = this;
    const at = cursor.here;
    const isName = cursor.isAt("word") && !RESERVED.has(cursor.next) && cursor.second === ":";
    if (!isName && !cursor.isAt("number")) return;
    if (this.jumps) into.push({ kind: "label", name: cursor.next, ...at });
    this.labels.add(cursor.next);
    cursor.advance();
    if (isName) cursor.advance();
  }

  private jump(at: TextPlace): Statement {
    const { cursor } = this;
    cursor.expect("goto");
    if (!cursor.isAt("number") && !cursor.isAt("word")) throw cursor.unexpected("a label");
    const label = cursor.take();
    this.gotos.push({ label, ...at });
    const go: Statement = { kind: "goto", label, ...at };
    if (!cursor.accept("if")) return go;
    return { kind: "if", branches: [{ when: readExpression(cursor, RULES), body: [go] }], ...at };
  }

  private statement(): Statement | undefined {
    const { cursor } = this;
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
        return this.choice(at, "value");
      case "scase":
        cursor.advance();
        return this.choice(at, "svalue");
      case "call": {
        cursor.advance();
        const place = cursor.here;
        const name = cursor.name("the name of a program");
        this.called.add(name);
        const args = cursor.accept("(") ? readArguments(cursor, 0) : [];
        return { kind: "do", name: `call ${name}`, args, ...place };
      }
      case "wait":
        cursor.advance();
        return { kind: "wait-until", when: readExpression(cursor, RULES), ...at };
      case "point":
        cursor.advance();
        return cursor.accept("/") ? this.partly(at) : this.assignment(at);
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
        return this.leaving(at, word) ?? this.byName(at, word);
    }
  }

  /** What leaves a block, a program or all of them. */
  private leaving(at: TextPlace, word: string): Statement | undefined {
    const { cursor } = this;
    switch (word) {
      case "goto":
        return this.jump(at);
      case "return":
        cursor.advance();
        return { kind: "return", ...at };
      case "halt":
      case "abort":
      case "stop":
        cursor.advance();
        return { kind: "halt", ...at };
      default:
        return undefined;
    }
  }

  /** Statements that begin with a name, and instructions. */
  private byName(at: TextPlace, word: string): Statement | undefined {
    const { cursor } = this;
    const { second } = cursor;
    if (this.asText && second !== "=" && (KEPT.has(word) || RECEIVES.test(word) || AWAY.has(word)))
      return this.keptStatement(at, word);
    if (Object.hasOwn(UNSUPPORTED, word) && !(this.asText && word === "xmove"))
      throw new TextError(at, "a statement of the motion program", UNSUPPORTED[word]!);
    if (RESERVED.has(word)) throw cursor.unexpected("a statement");
    if (second === "=" || (second === "[" && !INSTRUCTIONS.has(word))) return this.assignment(at);
    if (second === "on" || second === "off") return this.switched(at);
    if (!INSTRUCTIONS.has(word))
      throw new TextError(at, "a statement of AS", `"${cursor.raw}" is no statement of AS that is understood here.`);
    return this.instruction(at);
  }

  /** A statement that is left out with all of its line; what it receives has no value that is known. */
  private keptStatement(at: TextPlace, word: string): Statement {
    const { cursor } = this;
    if (AWAY.has(word)) {
      this.restOfLine();
      const what =
        word === "scall"
          ? "The program that SCALL chooses by its name"
          : `Where ${word.toUpperCase()} goes, which the controller holds,`;
      return { kind: "do", name: "away", args: [{ value: { kind: "text", value: what, ...at }, ...at }], ...at };
    }
    this.kept.push(
      textFault(at, "a statement that moves the robot", `${word.toUpperCase()} is kept and shown, and not executed.`),
    );
    cursor.advance();
    const args: Argument[] = [];
    while (!cursor.isAt("line-end") && !cursor.done) {
      const place = cursor.here;
      if (cursor.isAt("word")) {
        if (cursor.next === "call" || word === "pcexecute") this.called.add(cursor.second);
        if (RECEIVES.test(word)) args.push({ value: { kind: "variable", name: cursor.next, ...place }, ...place });
      }
      cursor.advance();
    }
    return { kind: "do", name: "received", args, ...at };
  }

  /** `POINT/OAT a = b`: only these numbers of a are given. */
  private partly(at: TextPlace): Statement {
    const { cursor } = this;
    const place = cursor.here;
    const parts = cursor.take();
    const assign = this.assignment(at);
    if (assign.kind !== "assign") return assign;
    // A further axis is no part of the place.
    if (/^[0-9]+$/.test(parts)) return { ...assign, value: assign.to };
    if (!/^[xyzoat]+$/.test(parts))
      throw new TextError(place, "X, Y, Z, O, A or T", `"${parts}" is no part of a place.`);
    const of = (value: Expression): Argument => ({ value, ...place });
    const args = [of({ kind: "text", value: parts, ...place }), of(assign.to), of(assign.value)];
    return { ...assign, value: { kind: "call", name: "point/", args, ...place } };
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
      if (name === "xmove" && cursor.accept("till")) continue;
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
    const value = readExpression(cursor, RULES);
    const place = cursor.here;
    if (this.asText && cursor.accept(",")) {
      readExpression(cursor, RULES);
      this.kept.push(textFault(place, "a place alone", "The posture that stands behind the place is left open."));
    }
    return { kind: "assign", to, value, global: false, ...at };
  }

  private branches(at: TextPlace): Statement {
    const { cursor } = this;
    const branches: { when: Expression; body: Block }[] = [];
    for (;;) {
      const when = readExpression(cursor, RULES);
      if (cursor.next === "goto") {
        branches.push({ when, body: [this.jump(at)] });
        return { kind: "if", branches, ...at };
      }
      if (!cursor.isAt("line-end")) cursor.expect("then");
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
  private choice(at: TextPlace, word: "value" | "svalue"): Statement {
    const { cursor } = this;
    const of = readExpression(cursor, RULES);
    const branches: { when: Expression; body: Block }[] = [];
    const ends = ["end", word, "any"];
    cursor.expect("of");
    this.body("CASE", at, ends);
    let otherwise: Block | undefined;
    while (!cursor.accept("end")) {
      if (cursor.accept("any")) {
        cursor.accept(":");
        otherwise = this.body("CASE", at, ends);
        continue;
      }
      cursor.expect(word);
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
    // `$ENCODE(/F5.2, x)`: how a number is written.
    if (cursor.accept("/")) {
      while (cursor.next !== "," && cursor.next !== ")" && !cursor.isAt("line-end")) cursor.advance();
      continue;
    }
    args.push({
      value: isLeftOut(cursor) ? { kind: "number", value: 0, ...at } : readExpression(cursor, RULES, depth + 1),
      ...at,
    });
  } while (cursor.accept(",") || cursor.accept("by"));
  cursor.expect(")");
  return args;
}
