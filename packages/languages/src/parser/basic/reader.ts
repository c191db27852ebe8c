import type { TextFault, TextPlace } from "@twincell/core";
import { TextError, textFault } from "../faults.ts";
import { missingProgram } from "../missing.ts";
import {
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
} from "../structured/index.ts";

/** A text that was read: what a person called it, the routine that is started, and those that it calls. */
export interface BasicSource {
  readonly title: string;
  readonly main: Block;
  readonly routines: ReadonlyMap<string, Routine>;
  /** What is kept and shown but not executed. */
  readonly kept: readonly TextFault[];
}
export type BasicAnswer =
  | { readonly kind: "source"; readonly source: BasicSource }
  | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] };

/** What tells one BASIC from another before its instructions begin. Names are compared in lower case. */
export interface BasicGrammar {
  readonly lexicon: Lexicon;
  readonly expression: ExpressionRules;
  /** Words that are written in more than one way, or in two parts: `end if` for `EndIf`. */
  readonly alike: Readonly<Record<string, string>>;
  /** Statements that are understood and cannot be written as steps, with what the user is told. */
  readonly unsayable: Readonly<Record<string, string>>;
  /** Whether an argument of which nothing is said hands its value back. */
  readonly backByDefault?: boolean;
  /** Words that call a program of another file, by its name in quotes. */
  readonly callsFile?: ReadonlySet<string>;
  /** Statements that are kept and named where a text is executed as it is: what they do, in a few words. */
  readonly shown?: Readonly<Record<string, string>>;
}

/**
 * Reads blocks, decisions and loops of a BASIC; its routines and instructions are the language's own affair. Goes on
 * after a fault, so that all of them are told at once.
 */
export abstract class BasicReader extends RecoveringReader {
  protected readonly grammar: BasicGrammar;
  protected readonly routines = new Map<string, Routine>();
  /** What is done before the first statement: constants get their values. */
  protected readonly before: Statement[] = [];
  /** Routines that are called, with where. */
  private readonly calls = new Map<string, TextPlace>();
  private readonly words = new Map<string, string>();

  /** The text is executed, not kept as steps. */
  protected readonly asText: boolean;
  protected readonly kept: TextFault[] = [];

  constructor(text: string, grammar: BasicGrammar, asText = false) {
    super(text, grammar.lexicon);
    this.asText = asText;
    this.grammar = grammar;
  }

  /** Another name of the same thing. */
  protected alias(word: string, stands: string): void {
    this.words.set(word, stands);
  }

  /** Capitals count for nothing. The words of a long text are few. */
  protected override folded(word: string): string {
    const known = this.words.get(word);
    if (known !== undefined) return known;
    const small = word.toLowerCase().replace(/\s+/g, " ");
    const folded =
      this.words.get(small) ?? (Object.hasOwn(this.grammar.alike, small) ? this.grammar.alike[small]! : small);
    this.words.set(word, folded);
    return folded;
  }

  /** Keeps a statement of which the robot's motion knows nothing. */
  protected shown(at: TextPlace, what: string): undefined {
    const { cursor } = this;
    cursor.skip(each => each.isAt("line-end"));
    this.kept.push(textFault(at, "a statement that is executed", `Line ${at.line} is shown, not executed: ${what}.`));
    return undefined;
  }

  /** A routine, a declaration, or whatever else stands outside of routines. */
  protected abstract part(): void;
  /** An instruction or an assignment; undefined for one that says nothing to a motion program. */
  protected abstract instruction(at: TextPlace): Statement | undefined;
  /** The routine that a controller starts. */
  protected abstract started(): Routine | undefined;

  source(): BasicAnswer {
    const { cursor, faults } = this;
    this.guard(() => {
      cursor.advance();
    });
    while (!cursor.done && !this.hasEnough) {
      if (cursor.isAt("line-end")) {
        this.guard(() => {
          cursor.advance();
        });
        continue;
      }
      const { length } = faults;
      this.guard(() => {
        this.part();
      });
      if (faults.length > length && this.closes(cursor.next))
        this.guard(() => {
          cursor.advance();
        });
    }
    for (const [name, at] of this.calls)
      if (!this.routines.has(name) && !this.asText) faults.push(missingProgram(at, name).fault);
    const main = this.started();
    if (main === undefined && faults.length === 0)
      faults.push(new TextError(cursor.here, "a program", "The text holds no program.").fault);
    if (faults.length > 0 || main === undefined) return { kind: "not-understood", faults };
    return {
      kind: "source",
      source: {
        title: titleOf(main.body) ?? main.name,
        main: [...this.before, ...main.body],
        routines: this.routines,
        kept: this.kept,
      },
    };
  }

  /** Remarks outside of routines say nothing. */
  protected dropRemarks(): void {
    while (this.cursor.comment() !== undefined);
  }
  protected value(least = 0): Expression {
    return readExpression(this.cursor, this.grammar.expression, 0, least);
  }
  protected get atEnd(): boolean {
    return this.cursor.isAt("line-end") || this.cursor.done || this.cursor.next === ";";
  }

  /** `a, b` up to the end of the statement; a value left out between commas is not there. */
  protected values(): Argument[] {
    const { cursor } = this;
    const args: Argument[] = [];
    while (!this.atEnd) {
      const at = cursor.here;
      args.push(cursor.next === "," && cursor.kind === "sign" ? at : { value: this.value(), ...at });
      if (!cursor.accept(",")) break;
    }
    return args;
  }

  /** A call of a routine, of which the name comes; its arguments stand in brackets. */
  protected calling(at: TextPlace): Statement {
    const { cursor, grammar } = this;
    const place = cursor.here;
    const name = cursor.name("the name of a routine");
    this.isCalled(name, place);
    return { kind: "do", name, args: cursor.accept("(") ? grammar.expression.args(cursor, 0) : [], ...at };
  }

  /** A routine from its name on, up to the word that closes it. */
  protected routine(opened: string, close: string, at: TextPlace, head: () => Parameter[]): void {
    const { cursor } = this;
    const place = cursor.here;
    const name = cursor.name(`the name of a ${opened}`);
    const parameters = head();
    if (!cursor.isAt("line-end")) throw cursor.unexpected("the end of the line");
    if (this.routines.has(name))
      this.faults.push(new TextError(place, "a name used once", `The ${opened} ${name} is there twice.`).fault);
    const body = this.body(opened, at, [close]);
    cursor.expect(close);
    this.routines.set(name, { name, parameters, body, ...place });
  }

  /** `(ByVal a As Integer, b As Real)`, where there are any. */
  protected parameters(): Parameter[] {
    const { cursor } = this;
    const all: Parameter[] = [];
    if (!cursor.accept("(") || cursor.accept(")")) return all;
    do {
      const isBack = cursor.accept("byref") || (!cursor.accept("byval") && this.grammar.backByDefault === true);
      const name = cursor.name("the name of an argument");
      all.push({ name, type: cursor.accept("as") ? cursor.name("a type") : "", isBack });
    } while (cursor.accept(","));
    cursor.expect(")");
    return all;
  }

  /** A name gets a number, once for all. */
  protected constant(name: string, place: TextPlace, value: Expression): void {
    this.before.push({ kind: "assign", to: { kind: "variable", name, ...place }, value, global: true, ...place });
  }

  /** Every routine that is called must be there. */
  protected isCalled(name: string, at: TextPlace): void {
    if (!this.calls.has(name)) this.calls.set(name, at);
  }

  protected body(opened: string, at: TextPlace, ends: readonly string[]): Block {
    const { cursor } = this;
    return this.nested(at, () => {
      const statements: Statement[] = [];
      for (;;) {
        if (cursor.isAt("line-end") || cursor.next === ";") {
          this.guard(() => {
            cursor.advance();
          });
          continue;
        }
        this.takeComments(statements);
        // The number of a step.
        if (cursor.isAt("number")) {
          this.guard(() => {
            cursor.advance();
          });
          continue;
        }
        if (cursor.kind === "word" && ends.includes(cursor.next)) break;
        if (cursor.done && ends.includes("")) break;
        if (cursor.done || this.closes(cursor.next))
          throw new TextError(cursor.here, ends[0]!, `The ${opened} of line ${at.line} is not closed.`);
        if (this.hasEnough) break;
        const statement = this.guard(() => {
          const read = this.statement();
          if (!this.atEnd) throw cursor.unexpected("the end of the line");
          return read;
        });
        if (statement !== undefined) statements.push(statement);
        statements.push(...this.trailing());
      }
      return statements;
    });
  }

  /** A statement about a label: where it stands, or that the program goes on there. */
  protected labelled(name: "label" | "goto", label: string, at: TextPlace): Statement {
    return { kind: "do", name, args: [{ value: { kind: "text", value: label, ...at }, ...at }], ...at };
  }

  /** The statement that is read stands in the line of its If: a label there is where the program goes on. */
  protected isAfterThen = false;

  /** Statements that were read beside the last one and are done behind it. */
  protected trailing(): Statement[] {
    return [];
  }
  /** A statement that only a text that is executed may hold; undefined for one that is refused. */
  protected statementAsText(_word: string, _at: TextPlace): Statement | undefined {
    return undefined;
  }

  /** Whether a word ends a routine, so that a block inside it cannot go on. */
  protected override closes(word: string): boolean {
    return word === "end sub" || word === "fend";
  }

  private statement(): Statement | undefined {
    const { cursor, grammar } = this;
    const at = cursor.here;
    const word = cursor.next;
    if (cursor.kind === "word") {
      switch (word) {
        case "if":
          cursor.advance();
          return this.decision(at);
        case "for":
          cursor.advance();
          return this.counting(at);
        case "while": {
          cursor.advance();
          const when = this.value();
          const body = this.body("While", at, ["wend"]);
          cursor.expect("wend");
          return {
            kind: "while",
            when: isNumber(when)
              ? { kind: "truth", value: when.value !== 0, line: when.line, column: when.column }
              : when,
            body,
            ...at,
          };
        }
        case "do":
          cursor.advance();
          return this.looping(at);
        case "select":
          cursor.advance();
          cursor.accept("case");
          return this.choice(at);
        default:
          break;
      }
      const shown = this.asText && Object.hasOwn(grammar.shown ?? {}, word) ? grammar.shown![word] : undefined;
      if (shown !== undefined && cursor.second !== "=") return this.shown(at, shown);
      const asText = this.asText ? this.statementAsText(word, at) : undefined;
      if (asText !== undefined) return asText;
      if (grammar.callsFile?.has(word) === true) {
        cursor.advance();
        throw missingProgram(at, cursor.raw);
      }
      if (Object.hasOwn(grammar.unsayable, word))
        throw new TextError(at, "a statement of the motion program", grammar.unsayable[word]!);
      if (grammar.expression.reserved.has(word)) throw cursor.unexpected("a statement");
    }
    return this.instruction(at);
  }

  /** `name = value`, where the word that comes is one. */
  protected assignment(at: TextPlace, read: () => Expression = () => this.value()): Statement {
    const to = readExpression(this.cursor, this.grammar.expression, 0, 100);
    this.cursor.expect("=");
    return { kind: "assign", to, value: read(), global: false, ...at };
  }

  private decision(at: TextPlace): Statement {
    const { cursor } = this;
    const branches: { when: Expression; body: Block }[] = [];
    const first = this.value();
    cursor.expect("then");
    if (!cursor.isAt("line-end")) return this.inOneLine(first, at);
    branches.push({ when: first, body: this.body("If", at, ["end if", "elseif", "else"]) });
    while (cursor.accept("elseif")) {
      const when = this.value();
      cursor.expect("then");
      branches.push({ when, body: this.body("If", at, ["end if", "elseif", "else"]) });
    }
    const otherwise = cursor.accept("else") ? this.body("If", at, ["end if"]) : undefined;
    cursor.expect("end if");
    return otherwise === undefined ? { kind: "if", branches, ...at } : { kind: "if", branches, otherwise, ...at };
  }

  private inOneLine(when: Expression, at: TextPlace): Statement {
    const { cursor } = this;
    const one = (): Block => {
      this.isAfterThen = true;
      try {
        const read = this.statement();
        return read === undefined ? [] : [read];
      } finally {
        this.isAfterThen = false;
      }
    };
    const { branches, otherwise } = this.nested(at, () => ({
      branches: [{ when, body: one() }],
      otherwise: cursor.accept("else") ? one() : undefined,
    }));
    cursor.accept("end if");
    return otherwise === undefined ? { kind: "if", branches, ...at } : { kind: "if", branches, otherwise, ...at };
  }

  private counting(at: TextPlace): Statement {
    const { cursor } = this;
    const variable = cursor.name("the name of the loop variable");
    cursor.expect("=");
    const from = this.value();
    cursor.expect("to");
    const to = this.value();
    const one: Expression = { kind: "number", value: 1, ...at };
    const step = cursor.accept("step") ? this.value() : one;
    const body = this.body("For", at, ["next"]);
    cursor.expect("next");
    if (!this.atEnd && cursor.name("the name of the loop variable") !== variable)
      throw new TextError(cursor.here, variable, "Another loop is closed than the last one that was opened.");
    return { kind: "for", variable, from, to, step, body, ...at };
  }

  /** Do … Loop, with While or Until at either end. Asked for at the end, the body is gone through once before. */
  private looping(at: TextPlace): Statement {
    const { cursor } = this;
    const before = this.condition(at);
    const body = this.body("Do", at, ["loop"]);
    cursor.expect("loop");
    const after = this.condition(at);
    const always: Expression = { kind: "truth", value: true, ...at };
    if (before !== undefined || after === undefined) return { kind: "while", when: before ?? always, body, ...at };
    return {
      kind: "if",
      branches: [{ when: always, body: [...body, { kind: "while", when: after, body, ...at }] }],
      ...at,
    };
  }

  private condition(at: TextPlace): Expression | undefined {
    if (this.cursor.accept("while")) return this.value();
    return this.cursor.accept("until") ? { kind: "unary", sign: "not", of: this.value(), ...at } : undefined;
  }

  /** A choice is a chain of comparisons. */
  private choice(at: TextPlace): Statement {
    const { cursor } = this;
    const of = this.value();
    const ends = ["end select", "case", "default"];
    const branches: { when: Expression; body: Block }[] = [];
    this.body("Select", at, ends);
    let otherwise: Block | undefined;
    while (!cursor.accept("end select")) {
      if (
        cursor.accept("default") ||
        (cursor.next === "case" && cursor.second === "else" && (cursor.advance(), cursor.accept("else")))
      ) {
        otherwise = this.body("Select", at, ends);
        continue;
      }
      cursor.expect("case");
      let when: Expression | undefined;
      do {
        const right = this.value();
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
      branches.push({ when, body: this.body("Select", at, ends) });
    }
    if (branches.length === 0) throw new TextError(at, "Case", "The choice has no case.");
    return { kind: "if", branches, ...(otherwise === undefined ? {} : { otherwise }), ...at };
  }
}

const isNumber = (expression: Expression): expression is Extract<Expression, { kind: "number" }> =>
  expression.kind === "number";

/**
 * `a, b)` behind an opening bracket, for languages whose arguments have no names; one may be left out between commas.
 */
export function readPlainArguments(cursor: TokenCursor, depth: number, rules: ExpressionRules): readonly Argument[] {
  const args: Argument[] = [];
  if (cursor.accept(")")) return args;
  do {
    const at = cursor.here;
    // Said in the call as well, where a value comes back.
    if (cursor.next === "byref") cursor.advance();
    const isLeftOut = cursor.kind === "sign" && (cursor.next === "," || cursor.next === ")");
    args.push(isLeftOut ? at : { value: readExpression(cursor, rules, depth + 1), ...at });
  } while (cursor.accept(","));
  cursor.expect(")");
  return args;
}

/** `'* Title` at the top. */
function titleOf(block: Block): string | undefined {
  const first = block[0];
  return first?.kind === "comment" && first.text.startsWith("*") ? first.text.slice(1).trim() : undefined;
}
