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
  type Statement,
} from "../../parser/structured/index.ts";
import type { Action, Motion, Point } from "./actions.ts";
import { MESSAGE, REMARK } from "./listing.ts";

const LEXICON: Lexicon = {
  comment: REMARK,
  quotes: MESSAGE,
  doubled: false,
  lineEnds: true,
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
  binary: {
    or: 1,
    and: 2,
    "=": 4,
    "<>": 4,
    "<": 4,
    ">": 4,
    "<=": 4,
    ">=": 4,
    "+": 5,
    "-": 5,
    "*": 6,
    "/": 6,
    div: 6,
    mod: 6,
  },
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
const LINES = new Set(["do", "ro", "ao", "uo", "so", "go", "di", "ri", "ai", "gi"]);
/** Statements of which nothing shows in the motion. */
const SILENT = new Set([
  "timer",
  "payload",
  "override",
  "ualm",
  "rsr",
  "tc_online",
  "col",
  "lock",
  "unlock",
  "monitor",
  "pause_monitor",
  "collision_guard",
  "motn",
  "stop_tracking",
  "error_prog",
  "resume_prog",
  "joint_max_speed",
  "linear_max_speed",
]);

/** Statements of one program as a tree, jumps still as they stand. */
export interface Reading {
  readonly block: Block;
  readonly actions: Map<Statement, Action>;
  readonly faults: readonly TextFault[];
  /** What is kept and shown but not executed. */
  readonly kept: readonly TextFault[];
}

export const readStatements = (code: string): Reading => new StatementReader(code).read();

class StatementReader extends RecoveringReader {
  private readonly actions = new Map<Statement, Action>();
  private readonly kept: TextFault[] = [];
  /** The line of the statement has been left already. */
  private isOver = false;

  constructor(code: string) {
    super(code, LEXICON);
  }

  protected override folded(word: string): string {
    return word.toLowerCase();
  }

  read(): Reading {
    const { cursor } = this;
    this.guard(() => {
      cursor.advance();
    });
    const block = this.block([], cursor.here);
    return { block, actions: this.actions, faults: this.faults, kept: this.kept };
  }

  private block(ends: readonly string[], opened: TextPlace): Block {
    const { cursor } = this;
    return this.nested(opened, () => {
      const statements: Statement[] = [];
      for (;;) {
        this.toNextLine(statements);
        if (this.hasEnough || cursor.done) {
          if (cursor.done && ends.length > 0)
            throw new TextError(cursor.here, ends[0]!.toUpperCase(), `The block of line ${opened.line} is not closed.`);
          break;
        }
        if (cursor.isAt("word") && ends.includes(cursor.next)) break;
        if (cursor.isAt("line-end")) continue;
        const statement = this.guard(() => {
          const read = this.statement();
          if (!cursor.isAt("line-end") && !cursor.done && !this.isOver) throw cursor.unexpected("the end of the line");
          this.isOver = false;
          return read;
        });
        if (statement !== undefined) statements.push(statement);
      }
      return statements;
    });
  }

  private act(action: Action, at: TextPlace): Statement {
    const statement: Statement = { kind: "do", name: "", args: [], ...at };
    this.actions.set(statement, action);
    return statement;
  }

  private value(): Expression {
    return readExpression(this.cursor, RULES);
  }
  private indexed(): Expression {
    const { cursor } = this;
    cursor.expect("[");
    const value = this.value();
    cursor.expect("]");
    return value;
  }
  private label(): number {
    const { cursor } = this;
    cursor.expect("lbl");
    const at = cursor.here;
    const number = this.indexed();
    if (number.kind !== "number")
      throw new TextError(at, "the number of a label", "Labels that are worked out are not executed here.");
    return number.value;
  }

  private statement(): Statement {
    const { cursor } = this;
    const at = cursor.here;
    const word = cursor.next;
    if (cursor.accept("$")) return this.system(at);
    if (!cursor.isAt("word")) throw cursor.unexpected("a statement");
    const { second } = cursor;
    if ((word === "j" || word === "l" || word === "c") && (second === "p" || second === "pr")) {
      cursor.advance();
      return this.act(this.motion(word), at);
    }
    if (second === "[" && LINES.has(word)) return this.set(word, at);
    cursor.advance();
    switch (word) {
      case "r":
      case "pr":
        return this.assignment(word, at);
      case "ar":
        throw new TextError(at, "a statement of the motion program", "AR[] cannot be given a value.");
      case "sr":
        return this.shown(at, "a text register is given a text");
      case "arc":
        return this.shown(at, "the arc of a welding torch is switched");
      case "uframe":
      case "utool": {
        const number = this.indexed();
        const spelling = this.spelling();
        cursor.expect("=");
        return this.act({ kind: "define", what: word, number, value: this.value(), spelling }, at);
      }
      case "uframe_num":
      case "utool_num":
        cursor.expect("=");
        return this.act({ kind: "select", what: word === "uframe_num" ? "uframe" : "utool", number: this.value() }, at);
      case "wait":
        return this.wait(at);
      case "skip":
        cursor.expect("condition");
        return this.act({ kind: "skip-condition", when: this.value() }, at);
      case "offset": {
        cursor.expect("condition");
        cursor.expect("pr");
        return this.act({ kind: "offset-condition", register: this.indexed() }, at);
      }
      case "tool_offset": {
        cursor.expect("condition");
        cursor.expect("pr");
        return this.act({ kind: "tool-offset-condition", register: this.indexed() }, at);
      }
      case "if":
        return this.decision(at);
      case "select":
        return this.selection(at);
      case "for":
        return this.counting(at);
      case "lbl": {
        const number = this.indexed();
        if (number.kind !== "number") throw new TextError(at, "the number of a label", "A label has a number.");
        return this.act({ kind: "label", label: number.value }, at);
      }
      case "jmp":
        return this.act({ kind: "jump", label: this.label() }, at);
      case "call":
        return this.call(at);
      case "end":
        return { kind: "return", ...at };
      case "abort":
      case "pause":
        return { kind: "halt", ...at };
      case "message": {
        if (!cursor.isAt("text")) throw cursor.unexpected("[text]");
        const text = cursor.raw;
        cursor.advance();
        return this.act({ kind: "message", text }, at);
      }
      default:
        if (!SILENT.has(word))
          throw new TextError(
            at,
            "a statement of TP",
            `"${word.toUpperCase()}" is no statement of TP that is executed here.`,
          );
        while (!cursor.isAt("line-end") && !cursor.done) cursor.advance();
        return this.act({ kind: "nothing" }, at);
    }
  }

  /** Keeps a statement of which the robot's motion knows nothing. */
  private shown(at: TextPlace, what: string): Statement {
    const { cursor } = this;
    while (!cursor.isAt("line-end") && !cursor.done) cursor.advance();
    this.kept.push(textFault(at, "a statement that is executed", `Line ${at.line} is shown, not executed: ${what}.`));
    return this.act({ kind: "nothing" }, at);
  }

  /** Where the right side of an assignment begins: names of registers are told by their places. */
  private spelling(): string {
    return `${this.cursor.here.line}`;
  }

  private set(word: string, at: TextPlace): Statement {
    const { cursor } = this;
    cursor.advance();
    const number = this.indexed();
    cursor.expect("=");
    if (!cursor.accept("pulse")) return this.act({ kind: "set", word, number, value: this.value() }, at);
    const truth: Expression = { kind: "truth", value: true, ...at };
    if (!cursor.accept(","))
      return this.act({ kind: "set", word, number, value: truth, pulse: { kind: "number", value: 0.1, ...at } }, at);
    const pulse = this.value();
    cursor.expect("sec");
    return this.act({ kind: "set", word, number, value: truth, pulse }, at);
  }

  private assignment(word: "r" | "pr", at: TextPlace): Statement {
    const { cursor } = this;
    cursor.expect("[");
    const indices = [this.value()];
    while (cursor.accept(",")) indices.push(this.value());
    cursor.expect("]");
    cursor.expect("=");
    const value = this.value();
    const [first] = indices;
    const variable: Expression = {
      kind: "variable",
      name: first!.kind === "number" ? `${word}${first!.value}` : word,
      ...at,
    };
    const to: Expression =
      indices.length === 1 && first!.kind === "number"
        ? variable
        : { kind: "index", of: { kind: "variable", name: word, ...at }, indices, ...at };
    return { kind: "assign", to, value, global: true, ...at };
  }

  private system(at: TextPlace): Statement {
    const { cursor } = this;
    const name = cursor.name("the name of a system variable");
    while (!cursor.isAt("line-end") && !cursor.done && cursor.next !== "=") cursor.advance();
    cursor.expect("=");
    const value = this.value();
    return this.act(name === "waittmout" ? { kind: "timeout", value } : { kind: "nothing" }, at);
  }

  private wait(at: TextPlace): Statement {
    const { cursor } = this;
    const first = this.value();
    if (cursor.next === "(" && cursor.second === "sec") {
      cursor.advance();
      cursor.advance();
      cursor.expect(")");
      return this.act({ kind: "wait", s: first }, at);
    }
    if (first.kind === "number" || (first.kind === "index" && first.of.kind === "variable" && first.of.name === "r"))
      return this.act({ kind: "wait", s: first }, at);
    if (!cursor.accept("timeout")) return this.act({ kind: "wait-for", when: first }, at);
    cursor.expect(",");
    return this.act({ kind: "wait-for", when: first, label: this.label() }, at);
  }

  private decision(at: TextPlace): Statement {
    const { cursor } = this;
    const when = this.value();
    if (cursor.accept(",")) return { kind: "if", branches: [{ when, body: [this.statement()] }], ...at };
    cursor.expect("then");
    const body = this.block(["endif", "else"], at);
    const otherwise = cursor.accept("else") ? this.block(["endif"], at) : undefined;
    cursor.expect("endif");
    return { kind: "if", branches: [{ when, body }], ...(otherwise === undefined ? {} : { otherwise }), ...at };
  }

  /** SELECT R[1]=1,JMP LBL[1] and on the lines below it =2,CALL PICK and ELSE,JMP LBL[9]: a chain of comparisons. */
  private selection(at: TextPlace): Statement {
    const { cursor } = this;
    const first = this.value();
    const branches: { when: Expression; body: Block }[] = [];
    if (first.kind !== "binary" || first.sign !== "=")
      throw new TextError(at, "R[n]=value", "SELECT compares a register with a value.");
    const branch = (when: Expression): void => {
      cursor.expect(",");
      branches.push({ when, body: [this.statement()] });
    };
    branch(first);
    let otherwise: Block | undefined;
    for (;;) {
      const below: string = cursor.isAt("line-end") ? cursor.second : "";
      if (below !== "=" && below !== "else") break;
      cursor.advance();
      if (cursor.accept("=")) {
        branch({ ...first, right: this.value() });
        continue;
      }
      // The ELSE of an IF around it stands alone in its line.
      this.isOver = true;
      if (cursor.second === ",") {
        this.isOver = false;
        cursor.advance();
        cursor.advance();
        otherwise = [this.statement()];
      }
      break;
    }
    return { kind: "if", branches, ...(otherwise === undefined ? {} : { otherwise }), ...at };
  }

  private counting(at: TextPlace): Statement {
    const { cursor } = this;
    cursor.expect("r");
    const number = this.indexed();
    if (number.kind !== "number") throw new TextError(at, "R[n]", "The register of the loop has a number.");
    cursor.expect("=");
    const from = this.value();
    const down = cursor.accept("downto");
    if (!down) cursor.expect("to");
    const to = this.value();
    const body = this.block(["endfor"], at);
    cursor.expect("endfor");
    return {
      kind: "for",
      variable: `r${number.value}`,
      from,
      to,
      step: { kind: "number", value: down ? -1 : 1, ...at },
      body,
      ...at,
    };
  }

  private call(at: TextPlace): Statement {
    const { cursor } = this;
    const name = cursor.name("the name of a program");
    const args: Argument[] = [];
    if (cursor.accept("(")) {
      while (!cursor.accept(")")) {
        if (args.length > 0) cursor.expect(",");
        args.push({ value: this.value(), ...at });
      }
    }
    return { kind: "do", name, args, ...at };
  }

  // --- motions ----------------------------------------------------------------------------------------------------

  private point(): Point {
    const { cursor } = this;
    const register = cursor.next;
    if (register !== "p" && register !== "pr") throw cursor.unexpected("P[n] or PR[n]");
    cursor.advance();
    return { register, number: this.indexed() };
  }

  private motion(word: "j" | "l" | "c"): Motion {
    const { cursor } = this;
    const path = word.toUpperCase() as "J" | "L" | "C";
    const first = this.point();
    let via: Point | undefined;
    let goal = first;
    let offset: Motion["offset"];
    let toolOffset: Motion["toolOffset"];
    let coordinated = false;
    if (word === "c") {
      via = first;
      // A point on the way may be shifted as its end is.
      if (cursor.accept("offset")) this.offset();
      while (cursor.isAt("line-end")) cursor.advance();
      // The second line may begin with a colon that has no number before it.
      cursor.accept(":");
      goal = this.point();
    }
    const speed = this.value();
    const unit = this.unit(path);
    let cnt: Expression | undefined;
    let acceleration: Expression | undefined;
    let skip: number | undefined;
    const at = cursor.here;
    const term = cursor.next;
    if (!cursor.accept("fine")) {
      cnt = this.suffixed("cnt");
      if (cnt === undefined)
        throw new TextError(at, "FINE or CNT", `"${term.toUpperCase()}" says not how the point is reached.`);
    }
    while (!cursor.isAt("line-end") && !cursor.done) {
      const found = this.suffixed("acc");
      if (found !== undefined) {
        acceleration = found;
        continue;
      }
      if (cursor.accept("offset")) {
        offset = this.offset();
        continue;
      }
      if (cursor.accept("tool_offset")) {
        toolOffset = this.offset();
        continue;
      }
      if (cursor.accept("coord")) {
        coordinated = true;
        continue;
      }
      if (cursor.accept("skip")) {
        cursor.expect(",");
        skip = this.label();
        continue;
      }
      if (
        cursor.accept("pth") ||
        cursor.accept("wjnt") ||
        cursor.accept("rtcp") ||
        cursor.accept("break") ||
        cursor.accept(",")
      )
        continue;
      throw cursor.unexpected("an option of the motion that is executed here");
    }
    return {
      kind: "motion",
      path,
      goal,
      speed,
      unit,
      ...(via === undefined ? {} : { via }),
      ...(cnt === undefined ? {} : { cnt }),
      ...(acceleration === undefined ? {} : { acceleration }),
      ...(offset === undefined ? {} : { offset }),
      ...(toolOffset === undefined ? {} : { toolOffset }),
      coordinated,
      ...(skip === undefined ? {} : { skip }),
    };
  }

  private offset(): { readonly register: Expression | undefined } {
    const { cursor } = this;
    if (!cursor.accept(",")) return { register: undefined };
    cursor.expect("pr");
    return { register: this.indexed() };
  }

  /** CNT50, or CNT R[1]. */
  private suffixed(word: string): Expression | undefined {
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

  private unit(path: Motion["path"]): Motion["unit"] {
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
    throw cursor.unexpected(path === "J" ? "% or sec" : "mm/sec, cm/min, inch/min or sec");
  }
}
