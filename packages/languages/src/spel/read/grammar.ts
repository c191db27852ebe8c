import type { TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import { BasicReader, readPlainArguments, type BasicAnswer, type BasicGrammar } from "../../parser/basic/index.ts";
import type { Argument, Expression, ExpressionRules, Routine, Statement } from "../../parser/structured/index.ts";

const RULES: ExpressionRules = {
  binary: {
    or: 1,
    xor: 1,
    and: 2,
    "=": 3,
    "<>": 3,
    "><": 3,
    "<": 3,
    ">": 3,
    "<=": 3,
    ">=": 3,
    "+": 4,
    "-": 4,
    "*": 5,
    "/": 5,
    mod: 5,
    "^": 7,
  },
  prefix: { not: 2, "-": 6, "+": 6 },
  constants: { true: true, on: true, high: true, false: false, off: false, low: false },
  tags: [],
  index: "[",
  components: false,
  reserved: new Set([
    "function",
    "fend",
    "end if",
    "else",
    "elseif",
    "next",
    "loop",
    "wend",
    "end select",
    "case",
    "default",
    "then",
    "to",
    "step",
    "until",
  ]),
  args: (cursor, depth) => readPlainArguments(cursor, depth, RULES),
};
const SIGNS = [
  "<=",
  ">=",
  "<>",
  "><",
  "(",
  ")",
  "[",
  "]",
  ",",
  ":",
  ";",
  "=",
  "<",
  ">",
  "+",
  "-",
  "*",
  "/",
  "^",
  "#",
  "!",
  "&",
  "@",
  ".",
];
const elsewhere = (what: string): string => `${what}, which is not executed here.`;
const GRAMMAR: BasicGrammar = {
  lexicon: {
    comment: "'",
    quotes: '"',
    doubled: false,
    lineEnds: true,
    signs: SIGNS,
    word: /[A-Za-z_][A-Za-z0-9_]*\$?/y,
  },
  expression: RULES,
  alike: { endif: "end if", send: "end select" },
  unsayable: {
    goto: elsewhere("GoTo jumps"),
    gosub: elsewhere("GoSub jumps to a label"),
    xqt: elsewhere("Xqt starts another task"),
    trap: elsewhere("Trap belongs to interrupts"),
    onerr: elsewhere("OnErr belongs to the handling of errors"),
    jump: elsewhere("Jump lifts the hand by rules of the controller"),
    jump3: elsewhere("Jump3 moves through a gate by rules of the controller"),
    jump3cp: elsewhere("Jump3CP moves through a gate by rules of the controller"),
    bgo: elsewhere("BGo moves in a local by offsets"),
    bmove: elsewhere("BMove moves in a local by offsets"),
    curve: elsewhere("Curve keeps its path in a file"),
    cvmove: elsewhere("CVMove goes along a path in a file"),
    pass: elsewhere("Pass goes near several points"),
    home: "Home goes to a posture that only the controller knows.",
    pulse: "Pulse counts in pulses, of which only the controller knows the size.",
    arc: elsewhere("Arc stays level: write Arc3"),
    pause: "Pause waits for a person, who is not here.",
  },
};
const TYPES: ReadonlySet<string> = new Set([
  "integer",
  "int32",
  "short",
  "byte",
  "long",
  "real",
  "double",
  "boolean",
  "string",
  "global",
  "preserve",
]);
/** Instructions about the controller, of which a motion program keeps nothing. */
const OF_THE_CONTROLLER: ReadonlySet<string> = new Set([
  "motor",
  "power",
  "reset",
  "accel",
  "accels",
  "accelr",
  "speedr",
  "weight",
  "inertia",
  "tmreset",
  "fine",
  "limz",
  "arch",
]);
const INSTRUCTIONS: ReadonlySet<string> = new Set(["speed", "speeds", "tlset", "tool", "local", "on", "off", "print"]);
const MOTIONS: Readonly<Record<string, number>> = { go: 1, move: 1, tgo: 1, tmove: 1, arc3: 2 };

/** Reads SPEL+: the functions of one file, of which `main` is started. */
export const readSpel = (text: string): BasicAnswer => new SpelReader(text, GRAMMAR).source();

class SpelReader extends BasicReader {
  /** Names that stand for points. */
  private readonly points = new Set<string>();

  protected part(): void {
    const { cursor } = this;
    const at = cursor.here;
    this.dropRemarks();
    if (cursor.accept("#")) return this.directive();
    if (cursor.kind === "word" && TYPES.has(cursor.next)) return this.restOfLine();
    cursor.expect("function");
    this.routine("function", "fend", at, () => {
      const parameters = this.parameters();
      if (cursor.accept("as")) cursor.name("a type");
      return parameters;
    });
  }

  protected started(): Routine | undefined {
    return this.routines.get("main") ?? [...this.routines.values()][0];
  }

  /** `#define name 3` gives a number a name, `#define name P3` a point. */
  private directive(): void {
    const { cursor } = this;
    if (cursor.next !== "define") return this.restOfLine();
    cursor.advance();
    const place = cursor.here;
    const name = cursor.name("the name of a constant");
    if (cursor.kind === "word" && isPoint(cursor.next)) {
      this.alias(cursor.take(), name);
      this.points.add(name);
    } else this.constant(name, place, this.value());
    if (!cursor.isAt("line-end") && !cursor.done) throw cursor.unexpected("the end of the line");
  }

  protected instruction(at: TextPlace): Statement | undefined {
    const { cursor } = this;
    const word = cursor.next;
    const given = (args: readonly Argument[]): Statement => ({ kind: "do", name: word, args, ...at });
    if (cursor.kind !== "word") throw cursor.unexpected("a statement");
    if (cursor.second === "=" && cursor.kind === "word") return this.assigned(at);
    if (Object.hasOwn(MOTIONS, word)) {
      cursor.advance();
      return this.motion(word, at);
    }
    if (TYPES.has(word)) {
      this.declaration();
      return undefined;
    }
    if (OF_THE_CONTROLLER.has(word)) {
      cursor.advance();
      this.restOfLine();
      return undefined;
    }
    if (INSTRUCTIONS.has(word)) {
      cursor.advance();
      return given(word === "tlset" || word === "local" ? this.numberAndPoint() : this.values());
    }
    switch (word) {
      case "p":
        return this.assigned(at);
      case "call":
        cursor.advance();
        return this.calling(at);
      case "quit":
        cursor.advance();
        cursor.name("All, or the name of a task");
        return { kind: "halt", ...at };
      case "exit": {
        cursor.advance();
        const what = cursor.name("Function, For or Do");
        return what === "function" ? { kind: "return", ...at } : { kind: "break", ...at };
      }
      case "wait":
        cursor.advance();
        return this.wait(at);
      default:
        break;
    }
    const { second } = cursor;
    // A function may be called by its name alone.
    if (second === "(" || second === "") return this.calling(at);
    throw new TextError(
      at,
      "a statement of SPEL+",
      `"${cursor.raw}" is no statement of SPEL+ that is understood here.`,
    );
  }

  /** Variables begin as 0. */
  private declaration(): void {
    const { cursor } = this;
    while (cursor.kind === "word" && TYPES.has(cursor.next)) cursor.advance();
    do {
      const place = cursor.here;
      const name = cursor.name("the name of a variable");
      if (cursor.accept("(")) {
        this.value();
        cursor.expect(")");
      }
      this.constant(name, place, { kind: "number", value: 0, ...place });
    } while (cursor.accept(","));
  }

  private assigned(at: TextPlace): Statement {
    const isPlace = isPoint(this.cursor.next) || this.points.has(this.cursor.next);
    return this.assignment(at, isPlace ? () => this.point() : undefined);
  }

  private numberAndPoint(): Argument[] {
    const { cursor } = this;
    const at = cursor.here;
    const number = this.value();
    cursor.expect(",");
    const place = cursor.here;
    return [
      { value: number, ...at },
      { value: this.point(), ...place },
    ];
  }

  private wait(at: TextPlace): Statement {
    const when = this.value();
    if (
      (when.kind === "binary" && ["=", "<>", "<", ">", "<=", ">=", "and", "or"].includes(when.sign)) ||
      when.kind === "call" ||
      (when.kind === "unary" && when.sign === "not")
    ) {
      if (this.cursor.next === ",")
        throw new TextError(
          this.cursor.here,
          "the end of the line",
          "Wait with a limit of time goes on as if nothing had been waited for, which a step cannot say.",
        );
      return { kind: "wait-until", when, ...at };
    }
    return { kind: "do", name: "wait", args: [{ value: when, ...at }], ...at };
  }

  private motion(name: string, at: TextPlace): Statement {
    const { cursor } = this;
    const args: Argument[] = [];
    for (let count = MOTIONS[name]!; count > 0; count--) {
      const place = cursor.here;
      args.push({ value: this.point(), ...place });
      if (count > 1) cursor.expect(",");
    }
    while (!this.atEnd) {
      const place = cursor.here;
      const word = cursor.name("CP");
      if (word === "till" || word === "find" || word === "sense")
        throw new TextError(
          place,
          "CP",
          `${word.replace(/^./, letter => letter.toUpperCase())} looks at a line during the motion, which is not executed here.`,
        );
      if (word !== "cp" && word !== "rot")
        throw new TextError(place, "CP", `"${word}" behind a motion is not understood here.`);
      if (word === "cp") args.push({ name: "cp", ...place });
    }
    return { kind: "do", name, args, ...at };
  }

  /** A place with steps from it and what it asks for: `P1 +TLZ(10) /1 /L`. */
  private point(): Expression {
    const { cursor } = this;
    let left = this.value(5);
    for (;;) {
      const { line, column } = cursor.here;
      if (!cursor.isAt("sign")) return left;
      if (cursor.accept("/")) {
        if (!cursor.isAt("number") && !cursor.isAt("word")) throw cursor.unexpected("a local or a posture");
        const value = cursor.take();
        left = { kind: "binary", sign: "/", left, right: { kind: "text", value, line, column }, line, column };
      } else if (cursor.next === "+" || cursor.next === "-") {
        const sign = cursor.take();
        left = { kind: "binary", sign, left, right: this.value(5), line, column };
      } else return left;
    }
  }
}

const isPoint = (word: string): boolean => /^p[0-9]*$/.test(word);
