import type { TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import { BasicReader, readPlainArguments, type BasicAnswer, type BasicGrammar } from "../../parser/basic/index.ts";
import type {
  Argument,
  Block,
  Expression,
  ExpressionRules,
  Routine,
  Statement,
  TokenCursor,
} from "../../parser/structured/index.ts";

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
    "=<": 3,
    "=>": 3,
    "+": 4,
    "-": 4,
    "*": 5,
    "/": 5,
    mod: 5,
    "^": 7,
  },
  prefix: { not: 2, "-": 6, "+": 6 },
  constants: { on: true, off: false },
  tags: [],
  index: "[",
  components: true,
  reserved: new Set([
    "end if",
    "else",
    "elseif",
    "next",
    "wend",
    "end select",
    "case",
    "default",
    "then",
    "to",
    "step",
    "return",
  ]),
  args: (cursor, depth) => readPlainArguments(cursor, depth, RULES),
};
const elsewhere = (what: string): string => `${what}, which is not executed here.`;
const SIGNS = [
  "<=",
  ">=",
  "<>",
  "><",
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
  "&",
  ".",
  "#",
  "@",
  "?",
];
const GRAMMAR: BasicGrammar = {
  lexicon: {
    comment: "'",
    quotes: '"',
    doubled: false,
    lineEnds: true,
    signs: SIGNS,
    word: /end[ \t]+select\b|[A-Za-z_][A-Za-z0-9_]*[%!$&#]?/iy,
  },
  expression: RULES,
  alike: { endif: "end if" },
  callsFile: new Set(["callp"]),
  shown: {
    act: "interrupts do not arise here",
    input: "what comes from outside is not known here",
    on: "jumps by what comes from outside are not taken",
    trk: "nothing is followed here",
    xrun: "another task does not move the arm",
    xlod: "another task does not move the arm",
    xstp: "another task does not move the arm",
    cmp: "axes yield by rules of the controller",
    jrc: "turns are not counted anew",
    skip: "it ends a motion by an appended condition",
  },
  unsayable: {
    goto: elsewhere("GoTo jumps"),
    input: elsewhere("Input takes a value from outside"),
    on: elsewhere("On jumps by a value"),
    act: elsewhere("Act belongs to interrupts"),
    mva: elsewhere("Mva moves along an arch of the controller"),
    mvc: elsewhere("Mvc goes round a whole circle"),
    mvr2: elsewhere("Mvr2 draws an arc beside a point"),
    mvr3: elsewhere("Mvr3 draws an arc around a centre"),
    mvspl: elsewhere("MvSpl keeps its path in a file"),
    jrc: elsewhere("JRC counts turns of a joint anew"),
    mxt: elsewhere("Mxt follows positions from outside"),
    xrun: elsewhere("XRun starts another task"),
    trk: elsewhere("Trk follows a conveyor"),
    cmp: elsewhere("Cmp makes axes yield"),
    skip: elsewhere("Skip ends a motion by an appended condition"),
  },
};
/** Instructions about the controller, of which a motion program keeps nothing. */
const OF_THE_CONTROLLER: ReadonlySet<string> = new Set([
  "servo",
  "dim",
  "fine",
  "prec",
  "loadset",
  "oadl",
  "colchk",
  "collvl",
  "getm",
  "relm",
  "clr",
  "open",
  "close",
  "print",
  "torq",
  "rem",
  "fprm",
  "cnt0",
]);
const INSTRUCTIONS: ReadonlySet<string> = new Set(["ovrd", "jovrd", "spd", "accel", "cnt", "dly", "hopen", "hclose"]);
const MOTIONS: ReadonlySet<string> = new Set(["mov", "mvs", "mvr"]);

/** Reads MELFA-BASIC: one program, the routines behind it that it calls, and the list of its positions. */
export const readMelfa = (text: string, asText = false): BasicAnswer => new MelfaReader(text, asText).source();

/** Definitions that name a variable and its sort. */
const SORTS: ReadonlySet<string> = new Set(["pos", "jnt", "char", "inte", "long", "float", "double"]);
/** Statements that move the arm by rules of the controller. */
const MOVES_AWAY: ReadonlySet<string> = new Set(["mva", "mvc", "mvr2", "mvr3", "mvspl", "mxt"]);

class MelfaReader extends BasicReader {
  /** Labels that are called as routines. */
  private readonly labels: ReadonlySet<string>;
  private main: Routine | undefined;

  constructor(text: string, asText: boolean) {
    // A # behind a number says that it is held in double precision.
    super(text.replace(/(\d)#(?!\w)/g, "$1 "), GRAMMAR, asText);
    this.labels = new Set(Array.from(text.matchAll(/\bgosub\s*\*\s*(\w+)/gi), found => found[1]!.toLowerCase()));
  }

  protected override closes(word: string): boolean {
    return word === "return" && !(this.asText && this.labels.size === 0);
  }
  protected started(): Routine | undefined {
    return this.main;
  }

  protected part(): void {
    const { cursor } = this;
    const at = cursor.here;
    if (this.main === undefined) {
      // Where jumps are carried out, End is one of several ends.
      const body = this.body("program", at, this.asText && this.labels.size === 0 ? [""] : ["end", ""]);
      cursor.accept("end");
      this.main = { name: "program", parameters: [], body: this.withoutList(body), ...at };
      return;
    }
    if (cursor.isAt("number")) return cursor.advance();
    if (cursor.next === "*") return this.routineAt(at);
    // The list of positions, as the controller keeps it.
    const listed =
      cursor.kind === "word" && (cursor.second === "=" || cursor.second === "(") ? this.assigned(at) : undefined;
    if (listed === undefined)
      throw new TextError(at, "a label or a position", `"${cursor.raw}" stands behind the end of the program.`);
    if (!this.atEnd) throw cursor.unexpected("the end of the line");
    this.before.push(listed);
  }

  /** The list of positions that stands behind the last statement is there before the first one. */
  private withoutList(body: Block): Block {
    let from = body.length;
    while (from > 0 && (body[from - 1]!.kind === "assign" || body[from - 1]!.kind === "comment")) from--;
    const last = body[from - 1];
    const isEnd = last?.kind === "return" || last?.kind === "halt" || (last?.kind === "do" && last.name === "goto");
    if (!isEnd) return body;
    this.before.push(...body.slice(from));
    return body.slice(0, from);
  }

  private routineAt(at: TextPlace): void {
    const { cursor } = this;
    cursor.advance();
    const name = cursor.name("a label");
    cursor.accept(":");
    if (this.routines.has(`*${name}`))
      this.faults.push(new TextError(at, "a label used once", `The label ${name} is there twice.`).fault);
    const body = this.body("routine", at, ["return"]);
    cursor.expect("return");
    if (cursor.isAt("number")) cursor.advance();
    this.routines.set(`*${name}`, { name, parameters: [], body, ...at });
  }

  protected override statementAsText(word: string, at: TextPlace): Statement | undefined {
    const { cursor } = this;
    if (word === "goto") {
      cursor.advance();
      cursor.expect("*");
      return this.labelled("goto", cursor.name("a label"), at);
    }
    if (word === "return") {
      cursor.advance();
      return { kind: "return", ...at };
    }
    if (word === "error") {
      cursor.advance();
      this.restOfLine();
      return { kind: "halt", ...at };
    }
    if (!MOVES_AWAY.has(word)) return undefined;
    cursor.skip(each => each.isAt("line-end"));
    const value: Expression = { kind: "text", value: word.replace(/^./, letter => letter.toUpperCase()), ...at };
    return { kind: "do", name: "away", args: [{ value, ...at }], ...at };
  }

  /** `Def Plt 1, P1, P2, P3, P4, 3, 2, 1`; other definitions only name variables, or are refused. */
  private defined(at: TextPlace): Statement | undefined {
    const { cursor } = this;
    cursor.advance();
    const place = cursor.here;
    const sort = cursor.name("what is defined");
    if (sort === "plt") return { kind: "do", name: "plt", args: this.values(), ...at };
    if (SORTS.has(sort)) {
      this.restOfLine();
      return undefined;
    }
    if (this.asText && (sort === "act" || sort === "arch")) return this.shown(at, `Def ${sort} is kept`);
    throw new TextError(
      place,
      "Plt, Pos, Jnt or a sort of numbers",
      elsewhere(
        `Def ${cursor.raw === "" ? sort : sort.replace(/^./, letter => letter.toUpperCase())} gives a word another meaning`,
      ),
    );
  }

  protected instruction(at: TextPlace): Statement | undefined {
    const { cursor } = this;
    const word = cursor.next;
    const given = (args: readonly Argument[]): Statement => ({ kind: "do", name: word, args, ...at });
    if (cursor.accept("*")) {
      const place = cursor.here;
      const name = cursor.name("a label");
      const isNamed = cursor.accept(":") || this.atEnd;
      if (this.asText) return this.labelled(isNamed && !this.isAfterThen ? "label" : "goto", name, at);
      if (this.isAfterThen) throw new TextError(at, "a statement", elsewhere("A label behind Then jumps"));
      if (this.labels.has(name))
        throw new TextError(place, "End before it", `The program runs into the routine ${name}.`);
      return undefined;
    }
    if (cursor.kind !== "word") throw cursor.unexpected("a statement");
    if (MOTIONS.has(word)) {
      cursor.advance();
      return this.motion(word, at);
    }
    if (cursor.second === "=" || cursor.second === ".") return this.assigned(at);
    if (word === "def") return this.defined(at);
    if (OF_THE_CONTROLLER.has(word)) {
      cursor.advance();
      this.restOfLine();
      return undefined;
    }
    if (INSTRUCTIONS.has(word)) {
      cursor.advance();
      return given(this.values());
    }
    return this.leaving(word, at) ?? this.special(word, at);
  }

  /** What ends a program or a case; undefined for anything else. */
  private leaving(word: string, at: TextPlace): Statement | undefined {
    const { cursor } = this;
    switch (word) {
      case "end":
        cursor.advance();
        return { kind: "return", ...at };
      case "error":
      case "hlt":
        cursor.advance();
        this.restOfLine();
        return { kind: "halt", ...at };
      default:
        return undefined;
    }
  }

  private special(word: string, at: TextPlace): Statement | undefined {
    const { cursor } = this;
    const given = (args: readonly Argument[]): Statement => ({ kind: "do", name: word, args, ...at });
    switch (word) {
      case "tool":
      case "base": {
        cursor.advance();
        const place = cursor.here;
        return given([{ value: this.position(), ...place }]);
      }
      case "gosub": {
        cursor.advance();
        cursor.expect("*");
        const place = cursor.here;
        const name = cursor.name("a label");
        this.isCalled(`*${name}`, place);
        return { kind: "do", name: `*${name}`, args: [], ...place };
      }
      case "wait":
        cursor.advance();
        return { kind: "wait-until", when: this.value(), ...at };
      // It ends a case, which nothing falls out of here.
      case "break":
        cursor.advance();
        return undefined;
      case "m_out":
        return this.output(at);
      default:
        break;
    }
    if (cursor.second === "(") return this.assigned(at);
    throw new TextError(
      at,
      "a statement of MELFA-BASIC",
      `"${cursor.raw}" is no statement of MELFA-BASIC that is understood here.`,
    );
  }

  /** `M_Out(3)=1`, with `Dly 0.5` behind it for a pulse. */
  private output(at: TextPlace): Statement {
    const { cursor } = this;
    const place = cursor.here;
    const line = this.value(100);
    cursor.expect("=");
    const to = this.value(3);
    const args: Argument[] = [
      { value: line, ...place },
      { value: to, ...at },
    ];
    if (cursor.accept("dly")) args.push({ value: this.value(), ...at });
    return { kind: "do", name: "m_out", args, ...at };
  }

  private assigned(at: TextPlace): Statement {
    const { cursor } = this;
    const sort = cursor.next[0];
    return this.assignment(
      at,
      sort === "p" ? () => this.position() : sort === "j" ? () => this.position("joints") : undefined,
    );
  }

  private motion(name: string, at: TextPlace): Statement {
    const { cursor } = this;
    const args: Argument[] = [];
    for (;;) {
      const place = cursor.here;
      args.push(
        cursor.next === ","
          ? place
          : { value: args.length === 0 || name === "mvr" ? this.position() : this.value(), ...place },
      );
      if (!cursor.accept(",")) break;
    }
    // How the hand turns on the way, and which way round, is left to the controller.
    if (cursor.accept("type")) this.values();
    if (cursor.next === "wth" || cursor.next === "wthif")
      throw new TextError(
        cursor.here,
        "the end of the line",
        elsewhere("A statement appended by Wth is carried out during the motion"),
      );
    return { kind: "do", name, args, ...at };
  }

  /** A position, made of others: `P1*(P2+P3)`, `(x, y, z, a, b, c)(flag1, flag2)`. */
  private position(sort: "position" | "joints" = "position"): Expression {
    const { cursor } = this;
    let left = this.part1(sort);
    while (cursor.kind === "sign" && ["*", "/", "+", "-"].includes(cursor.next)) {
      const { line, column } = cursor.here;
      const sign = cursor.take();
      left = { kind: "binary", sign, left, right: this.part1(sort), line, column };
    }
    return left;
  }

  /** The number of a pallet and of one of its places. */
  private two(): Argument[] {
    const { cursor } = this;
    const first = cursor.here;
    const pallet = this.value();
    cursor.expect(",");
    const second = cursor.here;
    return [
      { value: pallet, ...first },
      { value: this.value(), ...second },
    ];
  }

  private part1(sort: "position" | "joints"): Expression {
    const { cursor } = this;
    const { line, column } = cursor.here;
    // `(Plt 1, M1)`: a place of a pallet.
    if (cursor.next === "plt" && cursor.second !== "(" && cursor.second !== "=") {
      cursor.advance();
      return { kind: "call", name: "plt", args: this.two(), line, column };
    }
    if (cursor.kind !== "sign" || !cursor.accept("(")) return this.value(6);
    const args: Argument[] = [];
    for (;;) {
      const at = cursor.here;
      const isLeftOut = cursor.kind === "sign" && (cursor.next === "," || cursor.next === ")");
      args.push(isLeftOut ? at : { value: args.length === 0 ? this.position(sort) : this.value(), ...at });
      if (!cursor.accept(",")) break;
    }
    cursor.expect(")");
    const only = args.length === 1 ? args[0]!.value : undefined;
    if (only !== undefined && cursor.next !== "(") return only;
    if (cursor.accept("(")) args.push(...flags(cursor));
    return { kind: "call", name: sort, args, line, column };
  }
}

/** `7, 0)`: the posture, and the turns of the joints. */
function flags(cursor: TokenCursor): Argument[] {
  const args: Argument[] = [];
  for (const name of ["flag", "turns"]) {
    const at = cursor.here;
    if (cursor.next === "," || cursor.next === ")") args.push({ name, ...at });
    else args.push({ name, value: { kind: "number", value: flag(cursor), ...at }, ...at });
    if (!cursor.accept(",")) break;
  }
  cursor.expect(")");
  return args;
}

function flag(cursor: TokenCursor): number {
  cursor.accept("+");
  const isCoded = cursor.accept("&");
  const at = cursor.here;
  const text = cursor.take();
  const value = !isCoded
    ? Number(text)
    : text.startsWith("h")
      ? Number.parseInt(text.slice(1), 16)
      : text.startsWith("b")
        ? Number.parseInt(text.slice(1), 2)
        : Number.NaN;
  if (!Number.isInteger(value)) throw new TextError(at, "a whole number", `"${text}" is no flag.`);
  return value;
}
