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
  type Statement,
  type TokenCursor,
} from "../../parser/structured/index.ts";

/** Stands for the two slashes of a remark, which are no single sign. */
export const REMARK = "\u0002";
const LEXICON: Lexicon = {
  comment: REMARK,
  quotes: '"',
  doubled: false,
  lineEnds: true,
  // Names of a library stand behind that of the library: `gripper:open`.
  word: /[A-Za-z_]\w*(?::[A-Za-z_]\w*)?/y,
  signs: [
    "==",
    "!=",
    "<=",
    ">=",
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ",",
    "=",
    "<",
    ">",
    "+",
    "-",
    "*",
    "/",
    "%",
    ".",
    "!",
    "&",
    ":",
  ],
};
const RESERVED: ReadonlySet<string> = new Set([
  "begin",
  "end",
  "if",
  "elseif",
  "else",
  "endif",
  "while",
  "endwhile",
  "for",
  "to",
  "step",
  "endfor",
  "do",
  "until",
  "switch",
  "case",
  "default",
  "break",
  "endswitch",
  "call",
  "return",
  "and",
  "or",
  "xor",
]);
const RULES: ExpressionRules = {
  binary: BINDS_AS_C,
  prefix: { "!": 7, "-": 7, "+": 7 },
  constants: { true: true, false: false },
  tags: [],
  index: "[",
  components: true,
  reserved: RESERVED,
  args: cursor => readArguments(cursor),
};
/** What ends code without "begin" and "end". */
const TEXT_END = "the end of the code";
const TASKS: ReadonlySet<string> = new Set(["taskcreate", "taskcreatesync"]);
const CLOSES: ReadonlySet<string> = new Set([
  "end",
  "endif",
  "endwhile",
  "endfor",
  "endswitch",
  "until",
  "else",
  "elseif",
]);

/** `{…}` is a list as `[…]` is elsewhere: `trsf` literals are told by their braces. */
function readArguments(cursor: TokenCursor): readonly Argument[] {
  const args: Argument[] = [];
  if (cursor.accept(")")) return args;
  do args.push({ value: readValue(cursor), ...cursor.here });
  while (cursor.accept(","));
  cursor.expect(")");
  return args;
}

function readValue(cursor: TokenCursor): Expression {
  const { line, column } = cursor.here;
  if (!cursor.accept("{")) return readExpression(cursor, RULES);
  const items: Expression[] = [];
  do items.push(readExpression(cursor, RULES));
  while (cursor.accept(","));
  cursor.expect("}");
  return { kind: "list", tag: "", items, line, column };
}

/** @param isMain  `return` ends the whole program. */
export function readCode(
  code: string,
  isMain: boolean,
): { readonly block: Block; readonly faults: readonly TextFault[] } {
  return new CodeReader(code, isMain).read();
}

class CodeReader extends RecoveringReader {
  private readonly isMain: boolean;

  constructor(code: string, isMain: boolean) {
    // Remarks begin with two slashes, except in a text.
    super(code.replace(/^((?:[^"\n/]|"[^"\n]*"|\/(?!\/))*)\/\//gm, `$1 ${REMARK}`), LEXICON);
    this.isMain = isMain;
  }

  protected override folded(word: string): string {
    const small = word.toLowerCase();
    return small in KEYWORDS ? small : word;
  }

  read(): { readonly block: Block; readonly faults: readonly TextFault[] } {
    const { cursor } = this;
    this.guard(() => {
      cursor.advance();
    });
    while (cursor.isAt("line-end"))
      this.guard(() => {
        cursor.advance();
      });
    const block = this.guard(() => {
      const at = cursor.here;
      // Some editors leave both words out.
      if (!cursor.accept("begin")) return this.block([TEXT_END], at);
      const inside = this.block(["end"], at);
      cursor.expect("end");
      return inside;
    });
    return { block: block ?? [], faults: this.faults };
  }

  private block(ends: readonly string[], opened: TextPlace): Block {
    const { cursor } = this;
    return this.nested(opened, () => {
      const statements: Statement[] = [];
      for (;;) {
        this.toNextLine(statements);
        if (cursor.done && ends[0] === TEXT_END) break;
        if (cursor.done || this.hasEnough)
          throw new TextError(cursor.here, ends[0]!, `The block of line ${opened.line} is not closed.`);
        if (cursor.isAt("word") && ends.includes(cursor.next)) break;
        if (cursor.isAt("line-end")) continue;
        if (cursor.isAt("word") && CLOSES.has(cursor.next))
          throw new TextError(cursor.here, ends[0]!, `The block of line ${opened.line} is not closed.`);
        const statement = this.guard(() => {
          const read = this.statement();
          if (!cursor.isAt("line-end") && !cursor.done) throw cursor.unexpected("the end of the line");
          return read;
        });
        if (statement !== undefined) statements.push(statement);
      }
      return statements;
    });
  }

  private value(): Expression {
    return readValue(this.cursor);
  }

  private statement(): Statement {
    const { cursor } = this;
    const at = cursor.here;
    const word = cursor.next;
    if (!cursor.isAt("word")) throw cursor.unexpected("a statement");
    if (TASKS.has(word.toLowerCase())) return this.task(at);
    if (!RESERVED.has(word) && !(word in KEYWORDS)) {
      if (cursor.second === "(") {
        cursor.advance();
        cursor.advance();
        return { kind: "do", name: word, args: readArguments(cursor), ...at };
      }
      return this.assignment(at);
    }
    cursor.advance();
    switch (word) {
      case "if":
        return this.decision(at);
      case "while": {
        const when = this.value();
        const body = this.block(["endwhile"], at);
        cursor.expect("endwhile");
        return { kind: "while", when, body, ...at };
      }
      case "do": {
        // do … until c  is  while true … if c break.
        const body = this.block(["until"], at);
        cursor.expect("until");
        const when = this.value();
        return {
          kind: "while",
          when: { kind: "truth", value: true, ...at },
          body: [...body, { kind: "if", branches: [{ when, body: [{ kind: "break", ...at }] }], ...at }],
          ...at,
        };
      }
      case "for":
        return this.counting(at);
      case "switch":
        return this.choice(at);
      case "call": {
        const name = cursor.name("the name of a program");
        cursor.expect("(");
        return { kind: "do", name: `call ${name}`, args: readArguments(cursor), ...at };
      }
      case "return":
        return this.isMain ? { kind: "halt", ...at } : { kind: "return", ...at };
      case "break":
        return { kind: "break", ...at };
      case "wait": {
        cursor.expect("(");
        const when = this.value();
        cursor.expect(")");
        return { kind: "wait-until", when, ...at };
      }
      default:
        throw new TextError(at, "a statement", `"${word}" begins no statement.`);
    }
  }

  /** `taskCreate "arm", 10, cycle(1)`: a program that runs beside this one. */
  private task(at: TextPlace): Statement {
    const { cursor } = this;
    const name = cursor.take();
    const args: Argument[] = [{ value: this.value(), ...cursor.here }];
    while (cursor.accept(",")) args.push({ value: this.value(), ...cursor.here });
    return { kind: "do", name: name.toLowerCase() === "taskcreatesync" ? "taskCreateSync" : "taskCreate", args, ...at };
  }

  private assignment(at: TextPlace): Statement {
    const { cursor } = this;
    const to = readExpression(cursor, RULES, 0, 100);
    cursor.expect("=");
    const value = this.value();
    // The whole frame changes with its place.
    if (to.kind === "component" && to.name === "trsf")
      return {
        kind: "assign",
        to: to.of,
        value: {
          kind: "call",
          name: "placed",
          args: [
            { value: to.of, ...at },
            { value, ...at },
          ],
          ...at,
        },
        global: true,
        ...at,
      };
    return { kind: "assign", to, value, global: true, ...at };
  }

  private decision(at: TextPlace): Statement {
    const { cursor } = this;
    const branches: { when: Expression; body: Block }[] = [];
    let otherwise: Block | undefined;
    do branches.push({ when: this.value(), body: this.block(["endif", "elseif", "else"], at) });
    while (cursor.accept("elseif"));
    if (cursor.accept("else")) otherwise = this.block(["endif"], at);
    cursor.expect("endif");
    const watched = branches.length === 1 && otherwise === undefined ? this.watched(branches[0]!) : undefined;
    if (watched !== undefined) return { kind: "wait-until", ...watched, ...at };
    return { kind: "if", branches, ...(otherwise === undefined ? {} : { otherwise }), ...at };
  }

  /** `if !watch(condition, s)` that ends the program is a wait with a longest time. */
  private watched({
    when,
    body,
  }: {
    readonly when: Expression;
    readonly body: Block;
  }): { readonly when: Expression; readonly timeout: Expression } | undefined {
    const inner =
      when.kind === "unary" && when.sign === "!"
        ? when.of
        : when.kind === "binary" && when.sign === "==" && when.right.kind === "truth" && !when.right.value
          ? when.left
          : undefined;
    if (
      inner?.kind !== "call" ||
      inner.name !== "watch" ||
      body
        .filter(({ kind }) => kind !== "comment")
        .map(({ kind }) => kind)
        .join() !== "halt"
    )
      return undefined;
    const [condition, timeout] = inner.args.map(({ value }) => value);
    return condition === undefined || timeout === undefined ? undefined : { when: condition, timeout };
  }

  private counting(at: TextPlace): Statement {
    const { cursor } = this;
    const variable = cursor.name("the name of the loop variable");
    cursor.expect("=");
    const from = this.value();
    cursor.expect("to");
    const to = this.value();
    const step: Expression = cursor.accept("step") ? this.value() : { kind: "number", value: 1, ...at };
    const body = this.block(["endfor"], at);
    cursor.expect("endfor");
    return { kind: "for", variable, from, to, step, body, ...at };
  }

  private choice(at: TextPlace): Statement {
    const { cursor } = this;
    const of = this.value();
    const branches: { when: Expression; body: Block }[] = [];
    let otherwise: Block | undefined;
    while (cursor.isAt("line-end")) cursor.advance();
    while (!cursor.accept("endswitch")) {
      if (cursor.accept("default")) otherwise = this.block(["break", "endswitch"], at);
      else {
        cursor.expect("case");
        let when: Expression | undefined;
        do {
          const right = this.value();
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
        branches.push({ when, body: this.block(["break", "case", "default", "endswitch"], at) });
      }
      cursor.accept("break");
      while (cursor.isAt("line-end")) cursor.advance();
    }
    return { kind: "if", branches, ...(otherwise === undefined ? {} : { otherwise }), ...at };
  }
}

const KEYWORDS: Readonly<Record<string, true>> = Object.assign(
  Object.create(null) as Record<string, true>,
  Object.fromEntries([...RESERVED, "wait", "true", "false"].map(word => [word, true])),
);
