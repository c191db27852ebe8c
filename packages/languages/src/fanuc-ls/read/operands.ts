import type { TextFault, TextPlace } from "@twincell/core";
import { TextError, textFault } from "../../parser/index.ts";
import {
  BINDS_AS_BASIC,
  RecoveringReader,
  readExpression,
  type Expression,
  type ExpressionRules,
  type Lexicon,
  type Statement,
} from "../../parser/structured/index.ts";
import type { Action, Motion } from "./actions.ts";
import { MESSAGE, REMARK } from "./listing.ts";

const LEXICON: Lexicon = {
  comment: REMARK,
  quotes: MESSAGE,
  doubled: false,
  lineEnds: true,
  // A system variable with its parts is one word: $MCR.$GENOVERRIDE, $PARAM_GROUP[2].$LOWERLIMS[1].
  word: /\$[A-Za-z_]\w*(?:\[[^\]\r\n]{0,40}\])?(?:\.\$?[A-Za-z_]\w*(?:\[[^\]\r\n]{0,40}\])?)*/y,
  signs: [
    "<>",
    "<=",
    ">=",
    "(",
    ")",
    "[",
    "]",
    ",",
    "=",
    "<",
    ">",
    "+",
    "-",
    "*",
    "/",
    "%",
    "!",
    "$",
    ".",
    ":",
    "'",
    "#",
  ],
};

const RESERVED: ReadonlySet<string> = new Set([
  "then",
  "else",
  "endif",
  "endfor",
  "to",
  "downto",
  "timeout",
  "jmp",
  "call",
  "if",
  "for",
  "wait",
  "lbl",
  "end",
  "and",
  "or",
  "div",
  "mod",
]);

const RULES: ExpressionRules = {
  binary: BINDS_AS_BASIC,
  prefix: { "!": 7, "-": 7, "+": 7 },
  constants: { on: true, off: false },
  tags: [],
  index: "[",
  components: false,
  reserved: RESERVED,
  args: cursor => {
    throw cursor.unexpected("an operator");
  },
};

/** Values, lines and labels that statements of TP programs name. */
export abstract class OperandReader extends RecoveringReader {
  protected readonly actions = new Map<Statement, Action>();
  protected readonly kept: TextFault[] = [];
  /** The line of the statement has been left already. */
  protected isOver = false;
  /** What is done at the end of the motion that was read last. */
  protected behind: Statement | undefined;

  constructor(code: string) {
    super(code, LEXICON);
  }

  protected override folded(word: string): string {
    return word.toLowerCase();
  }

  protected act(action: Action, at: TextPlace): Statement {
    const statement: Statement = { kind: "do", name: "", args: [], ...at };
    this.actions.set(statement, action);
    return statement;
  }

  protected value(): Expression {
    return readExpression(this.cursor, RULES);
  }

  /** An argument of a call: a value, or a text, which no motion reads. */
  protected argument(): Expression {
    const { cursor } = this;
    const at = cursor.here;
    if (cursor.isAt("text")) {
      cursor.advance();
      return { kind: "number", value: 0, ...at };
    }
    return this.value();
  }

  protected indexed(): Expression {
    const { cursor } = this;
    cursor.expect("[");
    const value = this.value();
    cursor.expect("]");
    return value;
  }

  protected label(): number {
    const { cursor } = this;
    cursor.expect("lbl");
    const at = cursor.here;
    const number = this.indexed();
    if (number.kind !== "number")
      throw new TextError(at, "the number of a label", "Labels that are worked out are not executed here.");
    return number.value;
  }

  protected jump(at: TextPlace): Statement {
    this.cursor.expect("lbl");
    const number = this.indexed();
    return this.act(
      number.kind === "number" ? { kind: "jump", label: number.value } : { kind: "jump-to", label: number },
      at,
    );
  }

  /** Keeps a statement of which the robot's motion knows nothing. */
  protected shown(at: TextPlace, what: string): Statement {
    const { cursor } = this;
    while (!cursor.isAt("line-end") && !cursor.done) cursor.advance();
    this.kept.push(textFault(at, "a statement that is executed", `Line ${at.line} is shown, not executed: ${what}.`));
    return this.act({ kind: "nothing" }, at);
  }

  /** Where the right side of an assignment begins: names of registers are told by their places. */
  protected spelling(): string {
    return `${this.cursor.here.line}`;
  }

  /** Whether GP2: or the like stands before the number of a register: it is the further axes'. */
  protected otherGroup(): boolean {
    const { cursor } = this;
    const group = /^gp([0-9])$/.exec(cursor.next)?.[1];
    if (group === undefined) return false;
    cursor.advance();
    cursor.expect(":");
    return group !== "1";
  }

  /** CNT50, or CNT R[1]. */
  protected suffixed(word: string): Expression | undefined {
    const { cursor } = this;
    const { line, column } = cursor.here;
    const { next } = cursor;
    if (!next.startsWith(word)) return undefined;
    if (next === word) {
      cursor.advance();
      return this.value();
    }
    const digits = next.slice(word.length);
    if (!/^[0-9]{1,3}$/.test(digits)) return undefined;
    cursor.advance();
    return { kind: "number", value: Number(digits), line, column };
  }

  protected unit(path: Motion["path"]): Motion["unit"] {
    const { cursor } = this;
    if (path === "J" && cursor.accept("%")) return "%";
    if (cursor.accept("sec")) return "sec";
    if (cursor.accept("msec")) return "msec";
    const word = cursor.next;
    if (path !== "J" && (word === "mm" || word === "cm" || word === "inch")) {
      cursor.advance();
      cursor.expect("/");
      cursor.expect(word === "mm" ? "sec" : "min");
      return word === "mm" ? "mm/sec" : word === "cm" ? "cm/min" : "inch/min";
    }
    if (path !== "J" && word === "deg") {
      cursor.advance();
      cursor.expect("/");
      cursor.expect("sec");
      return "deg/sec";
    }
    throw cursor.unexpected(path === "J" ? "% or sec" : "mm/sec, cm/min, inch/min or sec");
  }
}
