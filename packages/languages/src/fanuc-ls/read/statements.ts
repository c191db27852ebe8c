import type { TextFault, TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import type { Argument, Block, Expression, Statement } from "../../parser/structured/index.ts";
import type { Action } from "./actions.ts";
import { MotionReader } from "./motion-lines.ts";

const LINES = new Set(["do", "ro", "ao", "uo", "so", "go", "di", "ri", "ai", "gi", "f", "m"]);

/** Functions of one register or value, written with square brackets. */
export const FUNCTIONS: ReadonlySet<string> = new Set([
  "sin",
  "cos",
  "tan",
  "asin",
  "acos",
  "atan",
  "sqrt",
  "abs",
  "round",
  "trunc",
  "ln",
  "exp",
]);

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

/** Statements that are kept and named: what they do does not move the robot, or is no matter of a plan. */
const SHOWN: Readonly<Record<string, string>> = {
  softfloat: "the arm gives way to a push",
  soft: "the arm gives way to a push",
  run: "another program is started beside this one",
  vision: "a camera looks for parts",
  call_vision: "a camera looks for parts",
  force: "the force sensor is set",
  diag: "the controller notes how it is",
  print: "a text is printed",
  getat: "the time is noted",
  strlen: "a text is measured",
  lockreg: "registers are kept from other programs",
  touch: "the touch sensor is switched",
  track: "the seam is tracked by the arc",
  palletizing: "the pallet's own record is set",
  cycle: "a count of the controller is set",
  str_speed: "a speed is noted",
  send: "a message goes to another device",
  receive: "a message of another device is read",
  spot: "a spot gun is moved and closed",
  gun: "a spot gun is set",
  backup: "a copy of the controller is made",
};

/** Statements of one program as a tree, jumps still as they stand. */
export interface Reading {
  readonly block: Block;
  readonly actions: Map<Statement, Action>;
  readonly faults: readonly TextFault[];
  /** What is kept and shown but not executed. */
  readonly kept: readonly TextFault[];
}

export const readStatements = (code: string): Reading => new StatementReader(code).read();

export class StatementReader extends MotionReader {
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
        const { behind } = this;
        this.behind = undefined;
        if (statement !== undefined && behind !== undefined) statements.push(behind);
      }
      return statements;
    });
  }

  protected statement(): Statement {
    const { cursor } = this;
    const at = cursor.here;
    const word = cursor.next;
    if (cursor.isAt("word") && word.startsWith("$")) return this.system(at);
    if (!cursor.isAt("word")) throw cursor.unexpected("a statement");
    const { second } = cursor;
    if ((word === "j" || word === "l" || word === "c") && (second === "p" || second === "pr")) {
      cursor.advance();
      return this.act(this.motion(word), at);
    }
    if (second === "[" && (word === "f" || word === "m")) return this.flag(word, at);
    if (second === "[" && LINES.has(word)) return this.set(word, at);
    if (second === "[" && word === "p") return this.point_(at);
    cursor.advance();
    switch (word) {
      case "r":
      case "pr":
        return this.assignment(word, at);
      case "ar":
        throw new TextError(at, "a statement of the motion program", "AR[] cannot be given a value.");
      default:
        return this.named(at, word);
    }
  }

  /** Frames, tools and conditions. */
  private named(at: TextPlace, word: string): Statement {
    const { cursor } = this;
    switch (word) {
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
      default:
        return this.flow(at, word);
    }
  }

  /** What decides, repeats, jumps and ends. */
  private flow(at: TextPlace, word: string): Statement {
    const { cursor } = this;
    switch (word) {
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
        return this.jump(at);
      case "call":
        return this.call(at);
      case "end":
        return { kind: "return", ...at };
      case "abort":
        return { kind: "halt", ...at };
      case "pause":
        return this.act({ kind: "pause" }, at);
      case "message": {
        if (!cursor.isAt("text")) throw cursor.unexpected("[text]");
        const text = cursor.raw;
        cursor.advance();
        return this.act({ kind: "message", text }, at);
      }
      default:
        if (Object.hasOwn(SHOWN, word)) return this.shown(at, SHOWN[word]!);
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

  /** F[n] and M[n]: flags that the program and those beside it share. */
  private flag(word: string, at: TextPlace): Statement {
    const { cursor } = this;
    cursor.advance();
    const number = this.indexed();
    cursor.expect("=");
    if (!cursor.accept("pulse")) return this.act({ kind: "flag", word, number, value: this.value() }, at);
    return this.shown(at, "a flag is set for a moment");
  }

  /** P[n]=…: the position of this program is given another value. */
  private point_(at: TextPlace): Statement {
    const { cursor } = this;
    cursor.advance();
    cursor.expect("[");
    const number = this.value();
    if (cursor.accept(","))
      throw new TextError(at, "PR[n,1]", "A part of a taught position is not given a value here.");
    cursor.expect("]");
    cursor.expect("=");
    return this.act({ kind: "move-register", number, value: this.value() }, at);
  }

  private assignment(word: "r" | "pr", at: TextPlace): Statement {
    const { cursor } = this;
    cursor.expect("[");
    if (word === "pr" && this.otherGroup()) return this.shown(at, "a position of further axes is given a value");
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
    const name = cursor.take();
    cursor.expect("=");
    const value = this.value();
    if (name === "$waittmout") return this.act({ kind: "timeout", value }, at);
    return this.shown(at, "a system variable is given a value");
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
      for (let first = true; !cursor.accept(")"); first = false) {
        if (!first) cursor.expect(",");
        // VW's macros are called with words: they are for people.
        if (this.isWording()) {
          this.passArgument();
          args.push({ value: { kind: "number", value: 0, ...at }, ...at });
        } else args.push({ value: this.argument(), ...at });
      }
    }
    return { kind: "do", name, args, ...at };
  }

  /** Whether an argument is a text for people: a word that is no register, or nothing at all. */
  private isWording(): boolean {
    const { cursor } = this;
    if (cursor.next === "," || cursor.next === ")") return true;
    return (
      cursor.isAt("word") &&
      cursor.second !== "[" &&
      cursor.next !== "on" &&
      cursor.next !== "off" &&
      cursor.next !== "!"
    );
  }

  private passArgument(): void {
    const { cursor } = this;
    for (let depth = 0; !cursor.isAt("line-end") && !cursor.done; cursor.advance()) {
      if (cursor.next === "(") depth++;
      if (depth === 0 && (cursor.next === "," || cursor.next === ")")) return;
      if (cursor.next === ")") depth--;
    }
  }
}
