import type { TextFault, TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import {
  BINDS_AS_BASIC,
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

const LEXICON: Lexicon = {
  comment: "!",
  quotes: '"',
  doubled: true,
  lineEnds: false,
  signs: [
    ":=",
    "<=",
    ">=",
    "<>",
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ",",
    ";",
    ":",
    "=",
    "<",
    ">",
    "+",
    "-",
    "*",
    "/",
    ".",
    "\\",
    "%",
    "|",
    "?",
  ],
};

const RESERVED: ReadonlySet<string> = new Set([
  "alias",
  "and",
  "backward",
  "case",
  "connect",
  "const",
  "default",
  "div",
  "do",
  "else",
  "elseif",
  "endfor",
  "endfunc",
  "endif",
  "endmodule",
  "endproc",
  "endrecord",
  "endtest",
  "endtrap",
  "endwhile",
  "error",
  "exit",
  "false",
  "for",
  "from",
  "func",
  "goto",
  "if",
  "inout",
  "local",
  "mod",
  "module",
  "not",
  "or",
  "pers",
  "proc",
  "raise",
  "record",
  "retry",
  "return",
  "step",
  "task",
  "test",
  "then",
  "to",
  "trap",
  "true",
  "trynext",
  "undo",
  "var",
  "while",
  "with",
  "xor",
]);

const RULES: ExpressionRules = {
  binary: { ...BINDS_AS_BASIC, xor: 1 },
  prefix: { not: 3, "-": 7, "+": 7 },
  constants: { true: true, false: false },
  tags: [],
  index: "{",
  components: true,
  reserved: RESERVED,
  args: (cursor, depth) => readArguments(cursor, ")", depth),
};

const NAME_LENGTH = 32;

const STRING_LENGTH = 80;

/** A datum of a module or a routine. */
export interface DataDeclaration extends TextPlace {
  readonly storage: string;
  /** The module that alone knows it; undefined where all know it. */
  readonly module?: string | undefined;
  readonly type: string;
  readonly name: string;
  readonly sizes: readonly Expression[];
  readonly value?: Expression;
}

export interface Component {
  readonly name: string;
  readonly type: string;
}

/** A statement of another module than the first that is not understood: that matters when it is reached. */
export const FAULT = "\u0000fault";

/** A call whose routine is named by a text. */
export const LATE_CALL = "%";

/** The name under which a routine or a datum that is LOCAL to a module is kept. */
export const ownName = (name: string, module: string): string => `${name}@${module}`;

/** Statements of RAPID and the blocks they stand in. */
export abstract class StatementReader extends RecoveringReader {
  protected readonly data: DataDeclaration[] = [];
  protected readonly routines = new Map<string, Routine>();
  protected readonly local = new Map<string, DataDeclaration[]>();
  protected readonly forgiving = new Set<string>();
  protected readonly spelling = new Map<string, string>();
  protected readonly remarks: string[] = [];
  protected readonly records = new Map<string, readonly Component[]>();
  protected readonly own = new Map<string, Set<string>>();
  protected readonly moduleOf = new Map<string, string>();
  private readonly met = new Set<string>();
  protected current: DataDeclaration[] | undefined;
  protected title = "";
  protected modules = 0;
  protected inside = "";
  protected hasJumps = false;
  /** What was not understood in the statement that is read, in another module than the first. */
  private late: TextFault | undefined;

  constructor(text: string) {
    // The header of old save files is no RAPID.
    super(
      text.replace(/^[ \t\uFEFF]*%%%[^%]*%%%/gm, header => header.replace(/[^\r\n]/g, " ")),
      LEXICON,
    );
  }

  protected override folded(word: string): string {
    const name = word.toLowerCase();
    if (!this.spelling.has(name)) this.spelling.set(name, word);
    return name;
  }

  /** What was read, or undefined after a fault; data then belong again to where they did before. */
  protected override guard<T>(read: () => T): T | undefined {
    const {
      current,
      faults: { length },
    } = this;
    const got = super.guard(read);
    if (this.faults.length > length) {
      this.current = current;
      // What is wrong in another module than the first matters where it is reached.
      if (this.modules > 1) [this.late] = this.faults.splice(length);
    }
    return got;
  }

  protected override restOfLine(): void {
    this.cursor.skip(cursor => cursor.next === ";" || ENDS.has(cursor.next));
    if (this.cursor.next === ";" && !this.hasEnough)
      this.guard(() => {
        this.cursor.advance();
      });
  }

  protected declared(expected: string): { readonly name: string; readonly at: TextPlace } {
    const { cursor } = this;
    const at = cursor.here;
    const { raw } = cursor;
    const name = cursor.name(expected);
    if (RESERVED.has(name)) throw new TextError(at, expected, `"${raw}" is a word of RAPID.`);
    if (name.length > NAME_LENGTH)
      throw new TextError(
        at,
        `a name of at most ${NAME_LENGTH} characters`,
        `The name "${raw}" has ${name.length} characters; RAPID takes ${NAME_LENGTH}.`,
      );
    return { name, at };
  }

  private takeLate(): TextFault | undefined {
    const { late } = this;
    this.late = undefined;
    return late;
  }

  protected takeRemarks(): void {
    for (let comment = this.cursor.comment(); comment !== undefined; comment = this.cursor.comment())
      this.remarks.push(comment.text);
  }

  /** `CONST robtarget p10{2} := …;` */
  protected datum(into: DataDeclaration[], isOwn = false): void {
    const { cursor } = this;
    const storage = cursor.take();
    const type = cursor.name("the type of the datum");
    const { name, at } = this.declared("the name of the datum");
    const sizes: Expression[] = [];
    if (cursor.accept("{")) {
      do sizes.push(readExpression(cursor, RULES));
      while (cursor.accept(","));
      cursor.expect("}");
    }
    const value = cursor.accept(":=") ? readExpression(cursor, RULES) : undefined;
    cursor.expect(";");
    const isHidden = isOwn || (this.modules > 1 && into === this.data && this.met.has(name));
    const module = isHidden ? this.inside : undefined;
    if (isHidden) this.own.get(this.inside)!.add(name);
    // A large program has thousands of data: they are looked up, not gone through.
    const key = isHidden ? ownName(name, this.inside) : name;
    const isTwice = into === this.data ? this.met.has(key) : into.some(other => other.name === name);
    if (isTwice) throw new TextError(at, "a name used once", `"${name}" is declared twice.`);
    if (into === this.data) this.met.add(key);
    into.push({ storage, module, type, name, sizes, ...(value === undefined ? {} : { value }), ...at });
  }

  /** An error handler: only one that goes on behind a fruitless search means something to steps. */
  protected handler(routine: string, end: string): void {
    const { cursor } = this;
    const words: string[] = [];
    cursor.advance();
    while (cursor.next !== end && cursor.next !== "undo" && cursor.next !== "backward") {
      if (cursor.done) throw cursor.unexpected(end.toUpperCase());
      words.push(cursor.next);
      cursor.advance();
    }
    if (words.join(" ") === "if errno = err_whlsearch then trynext ; endif") this.forgiving.add(routine);
  }

  protected body(opened: TextPlace, ends: readonly string[]): Block {
    const { cursor } = this;
    return this.nested(opened, () => {
      const statements: Statement[] = [];
      for (;;) {
        this.takeComments(statements);
        if (ends.includes(cursor.next) && cursor.kind === "word") break;
        if (cursor.done || ROUTINE_ENDS.has(cursor.next))
          throw new TextError(cursor.here, ends[0]!.toUpperCase(), `The block of line ${opened.line} is not closed.`);
        if (this.hasEnough) break;
        const before = cursor.here;
        this.late = undefined;
        const statement = this.guard(() => this.statement());
        const late = this.takeLate();
        if (late !== undefined) statements.push(faultStatement(late));
        if (statement !== undefined) statements.push(statement);
        else if (
          before.line === cursor.here.line &&
          before.column === cursor.here.column &&
          !cursor.done &&
          !ends.includes(cursor.next)
        )
          this.guard(() => {
            cursor.advance();
          });
      }
      return statements;
    });
  }

  private statement(): Statement | undefined {
    const { cursor } = this;
    const at = cursor.here;
    const word = cursor.next;
    if (cursor.accept(";")) return undefined;
    if (cursor.kind === "sign" && word === "%") return this.lateCall(at);
    if (cursor.kind === "sign" && word === "<") return this.placeholder(at);
    if (cursor.kind !== "word") throw cursor.unexpected("a statement");
    switch (word) {
      case "const":
      case "pers":
      case "var":
        this.datum(this.current ?? this.data);
        return undefined;
      case "if":
        cursor.advance();
        return this.decision(at);
      case "while": {
        cursor.advance();
        const when = readExpression(cursor, RULES);
        cursor.expect("do");
        const body = this.body(at, ["endwhile"]);
        cursor.expect("endwhile");
        return { kind: "while", when, body, ...at };
      }
      case "for":
        cursor.advance();
        return this.counting(at);
      case "test":
        cursor.advance();
        return this.test(at);
      default:
        return this.ending(at, word);
    }
    if (RESERVED.has(word)) throw cursor.unexpected("a statement");
    const { second } = cursor;
    if (second === ":=" || second === "{" || second === ".") {
      const to = readExpression(cursor, RULES, 0, 100);
      cursor.expect(":=");
      const value = readExpression(cursor, RULES);
      cursor.expect(";");
      return { kind: "assign", to, value, global: false, ...at };
    }
    cursor.advance();
    if (second === ":") {
      cursor.advance();
      return { kind: "label", name: word, ...at };
    }
    return { kind: "do", name: word, args: readArguments(cursor, ";", 0), ...at };
  }

  /** Statements that end something, and what is read to its semicolon. */
  private ending(at: TextPlace, word: string): Statement | undefined {
    const { cursor } = this;
    switch (word) {
      case "return": {
        cursor.advance();
        if (cursor.accept(";")) return { kind: "return", ...at };
        const value = readExpression(cursor, RULES);
        cursor.expect(";");
        return { kind: "return", value, ...at };
      }
      case "exit":
        cursor.advance();
        cursor.expect(";");
        return { kind: "halt", ...at };
      case "goto": {
        cursor.advance();
        const label = cursor.name("a label");
        cursor.expect(";");
        this.hasJumps = true;
        return { kind: "goto", label, ...at };
      }
      case "connect": {
        cursor.advance();
        const value = readExpression(cursor, RULES);
        cursor.expect("with");
        cursor.name("the name of a trap");
        cursor.expect(";");
        return { kind: "do", name: "connect", args: [{ value, ...at }], ...at };
      }
      case "raise":
      case "retry":
      case "trynext":
        throw new TextError(at, "a statement of the motion program", `${word.toUpperCase()} is not executed here.`);
      default:
        break;
    }
    if (RESERVED.has(word)) throw cursor.unexpected("a statement");
    const { second } = cursor;
    if (second === ":=" || second === "{" || second === ".") {
      const to = readExpression(cursor, RULES, 0, 100);
      cursor.expect(":=");
      const value = readExpression(cursor, RULES);
      cursor.expect(";");
      return { kind: "assign", to, value, global: false, ...at };
    }
    cursor.advance();
    if (second === ":") {
      cursor.advance();
      return { kind: "label", name: word, ...at };
    }
    return { kind: "do", name: word, args: readArguments(cursor, ";", 0), ...at };
  }

  /** `%"part"+NumToStr(n,0)%;`: the name of the routine is worked out. */
  private lateCall(at: TextPlace): Statement {
    const { cursor } = this;
    cursor.advance();
    const value = readExpression(cursor, RULES);
    cursor.expect("%");
    return { kind: "do", name: LATE_CALL, args: [{ value, ...at }, ...readArguments(cursor, ";", 0)], ...at };
  }

  /** `<SMT>`: a place that the editor keeps for a statement; the controller stops there. */
  private placeholder(at: TextPlace): Statement {
    const { cursor } = this;
    cursor.advance();
    const what = cursor.name("the name of a placeholder");
    cursor.expect(">");
    cursor.accept(";");
    return faultStatement({
      ...at,
      expected: "a statement instead of the placeholder",
      sentence: `<${what.toUpperCase()}> stands for a statement that is still to be written.`,
    });
  }

  private decision(at: TextPlace): Statement {
    const { cursor } = this;
    const branches: { when: Expression; body: Block }[] = [];
    let when = readExpression(cursor, RULES);
    if (cursor.next !== "then") {
      // IF condition instruction;
      const one = this.statement();
      return { kind: "if", branches: [{ when, body: one === undefined ? [] : [one] }], ...at };
    }
    for (;;) {
      cursor.expect("then");
      branches.push({ when, body: this.body(at, ["endif", "elseif", "else"]) });
      if (!cursor.accept("elseif")) break;
      when = readExpression(cursor, RULES);
    }
    const otherwise = cursor.accept("else") ? this.body(at, ["endif"]) : undefined;
    cursor.expect("endif");
    return otherwise === undefined ? { kind: "if", branches, ...at } : { kind: "if", branches, otherwise, ...at };
  }

  private counting(at: TextPlace): Statement {
    const { cursor } = this;
    const variable = cursor.name("the name of the loop variable");
    cursor.expect("from");
    const from = readExpression(cursor, RULES);
    cursor.expect("to");
    const to = readExpression(cursor, RULES);
    const step = cursor.accept("step") ? readExpression(cursor, RULES) : undefined;
    cursor.expect("do");
    const body = this.body(at, ["endfor"]);
    cursor.expect("endfor");
    return { kind: "for", variable, from, to, ...(step === undefined ? {} : { step }), body, ...at };
  }

  /** TEST … CASE is a chain of comparisons. */
  private test(at: TextPlace): Statement {
    const { cursor } = this;
    const of = readExpression(cursor, RULES);
    const branches: { when: Expression; body: Block }[] = [];
    let otherwise: Block | undefined;
    while (!cursor.accept("endtest")) {
      if (cursor.accept("default")) {
        cursor.expect(":");
        otherwise = this.body(at, ["endtest", "case"]);
        continue;
      }
      cursor.expect("case");
      let when: Expression | undefined;
      do {
        const right = readExpression(cursor, RULES);
        const equal: Expression = {
          kind: "binary",
          sign: "=",
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
      cursor.expect(":");
      branches.push({ when, body: this.body(at, ["endtest", "case", "default"]) });
    }
    return { kind: "if", branches, ...(otherwise === undefined ? {} : { otherwise }), ...at };
  }
}

const faultStatement = ({ line, column, expected, sentence }: TextFault): Statement => ({
  kind: "do",
  name: FAULT,
  args: [expected, sentence].map(value => ({ value: { kind: "text", value, line, column }, line, column })),
  line,
  column,
});

const ROUTINE_ENDS = new Set(["endproc", "endfunc", "endtrap", "endmodule", "proc", "func", "trap"]);

const ENDS = new Set([
  ...ROUTINE_ENDS,
  "endif",
  "endwhile",
  "endfor",
  "endtest",
  "else",
  "elseif",
  "error",
  "local",
  "const",
  "pers",
]);

/** `a,b\Opt:=c\Switch` up to and with the sign that ends it. A comma before a backslash is at will. */
function readArguments(cursor: TokenCursor, end: string, depth: number): readonly Argument[] {
  const args: Argument[] = [];
  while (!cursor.accept(end)) {
    const at = cursor.here;
    if (args.length > 0 && cursor.next !== "\\" && !cursor.accept(",")) throw cursor.unexpected(`"," or "${end}"`);
    if (args.length === 0 && cursor.next === ",") throw cursor.unexpected("an argument");
    if (cursor.accept("\\")) {
      const name = cursor.name("the name of an optional argument");
      if (cursor.accept(":=")) args.push({ name, value: readExpression(cursor, RULES, depth + 1), ...at });
      else if (cursor.accept("?")) {
        const { line, column } = cursor.here;
        const parameter = cursor.name("the name of an optional parameter");
        args.push({ name, value: { kind: "variable", name: parameter, line, column }, ifPresent: true, ...at });
      } else args.push({ name, ...at });
      continue;
    }
    const value = readExpression(cursor, RULES, depth + 1);
    if (value.kind === "text" && value.value.length > STRING_LENGTH)
      throw new TextError(
        value,
        `a text of at most ${STRING_LENGTH} characters`,
        `The text has ${value.value.length} characters; RAPID takes ${STRING_LENGTH}.`,
      );
    args.push({ value, ...at });
  }
  return args;
}
