import type { TextPlace } from "@twincell/core";
import { TextError, textFault } from "../../parser/index.ts";
import { BasicReader, readPlainArguments, type BasicAnswer, type BasicGrammar } from "../../parser/basic/index.ts";
import type { Argument, Expression, ExpressionRules, Routine, Statement } from "../../parser/structured/index.ts";
import { takePoints, type TaughtPoint } from "./points.ts";

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
    "**": 7,
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
  "**",
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
  "{",
  "}",
  "$",
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
  shown: Object.fromEntries(
    Object.entries({
      "errors and interrupts are looked after": "trap onerr error eresume ercl",
      "another task is watched": "resume pause signal waitsig synclock syncunlock tmout",
      "a person is told or asked": "inputbox msgbox input line writeport gset gget gshow gclose gshowdialog",
      "another device is spoken to":
        "openchnet closenet opencom closecom opennet setcom setnet waitnet write writebin read readbin chknet chkcom aopen bopen ropen wopen uopen rename del kill mkdir copy fopen close flush",
      "a camera looks": "vrun vget vset vcal vload vsave vcls vteach vshowmodel",
      "a list of the controller is kept":
        "workque_autoremove workque_add workque_reset workque_remove workque_sort workque_userdata cnv_queadd cnv_queremove cnv_quemove cnv_quereject cnv_quelen cnv_queuserdata cnv_trigger",
      "the controller is set":
        "robot collisiondetect cp lowspeed brake errb inertia box plane boxclr planeclr xylim range base arm armset ecp ecpset eclr qp ptpboost ptpboostok sense avoidsingularity singularityangle singularityspeed jrange cx hordr mcordr hofs weight2 tclim tcspeed tc tctarget force_sensor force_setstart xyLimClr limitTorque fine2 speedfactor loadpoints savepoints clearpoints plabel pdel pdescription sethw setlatch setin setinw setsw memout memoutw time date tmreset resetelapsedtime elapsedtime startmain exitwithcode shutdown restart recover randomize redim strlen rtrim ltrim cls cal mcal logstart logend slock sfree sync cooljoint",
      "a group of outputs takes a number": "outw",
    }).flatMap(([what, words]) => words.split(" ").map(word => [word.toLowerCase(), what])),
  ),
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
const INSTRUCTIONS: ReadonlySet<string> = new Set([
  "out",
  "memon",
  "memoff",
  "speed",
  "speeds",
  "tlset",
  "tool",
  "local",
  "on",
  "off",
  "print",
]);
const MOTIONS: Readonly<Record<string, number>> = { go: 1, move: 1, tgo: 1, tmove: 1, arc3: 2 };
/** Motions that are executed where a text is, and are not kept as steps. */
const MOTIONS_AS_TEXT: Readonly<Record<string, number>> = { jump: 1, jump3: 3, jump3cp: 3, arc: 2 };

/** Reads SPEL+: the functions of one file, of which `main` is started. */
export function readSpel(text: string, asText = false): BasicAnswer {
  const { code, points } = takePoints(text);
  return new SpelReader(code, points, asText).source();
}

class SpelReader extends BasicReader {
  /** Names that stand for points. */
  private readonly points = new Set<string>();
  /** Functions of the text. */
  private readonly functions = new Set<string>();

  constructor(code: string, taught: readonly TaughtPoint[], asText: boolean) {
    super(code, GRAMMAR, asText);
    this.take(taught);
    for (const [, name] of code.matchAll(/^[ \t]*Function[ \t]+(\w+)/gim)) this.functions.add(name!.toLowerCase());
  }

  /** Points of the point files are there before the program begins; of two with one number the first is meant. */
  private take(taught: readonly TaughtPoint[]): void {
    const known = new Map<number, TaughtPoint>();
    for (const point of taught) {
      const { number, label, values, local, posture, line, column } = point;
      const at = { line, column };
      const before = known.get(number);
      if (before !== undefined) {
        if (before.values.some((value, i) => value !== values[i]))
          this.kept.push(
            textFault(at, "one point of that number", `P${number} is in several point files: the first is taken.`),
          );
        continue;
      }
      known.set(number, point);
      const name = `p${number}`;
      if (/^[A-Za-z_]\w*$/.test(label)) {
        this.alias(label.toLowerCase(), name);
        this.alias(label, name);
      }
      const call: Expression = {
        kind: "call",
        name: "xy",
        args: values.map(value => ({ value: { kind: "number", value, ...at }, ...at })),
        ...at,
      };
      const asked = [...posture, ...(local === 0 ? [] : [String(local)])];
      const value = asked.reduce<Expression>(
        (left, word) => ({ kind: "binary", sign: "/", left, right: { kind: "text", value: word, ...at }, ...at }),
        call,
      );
      this.before.push({ kind: "assign", to: { kind: "variable", name, ...at }, value, global: true, ...at });
    }
  }

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
    if (cursor.kind !== "word" && word !== "#") throw cursor.unexpected("a statement");
    if (cursor.second === "=" && cursor.kind === "word") return this.assigned(at);
    if (word === "#") {
      // #ifdef, #include and their like.
      if (!this.asText) throw cursor.unexpected("a statement");
      cursor.advance();
      this.directive();
      return undefined;
    }
    if (Object.hasOwn(MOTIONS, word)) {
      cursor.advance();
      return this.motion(word, at, MOTIONS[word]!);
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
    return this.byWord(at, word);
  }

  /** Instructions that are read each in its own way. */
  private byWord(at: TextPlace, word: string): Statement | undefined {
    const { cursor } = this;
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
    return this.byFunctionName(at, word);
  }

  /** Functions that are called by their names. */
  private byFunctionName(at: TextPlace, word: string): Statement | undefined {
    const { cursor } = this;
    const given = (args: readonly Argument[]): Statement => ({ kind: "do", name: word, args, ...at });
    const { second } = cursor;
    // An element of an array takes a value.
    if (this.asText && second === "(" && !this.functions.has(word)) {
      const place = cursor.here;
      const to = this.value(100);
      if (cursor.accept("=")) return { kind: "assign", to, value: this.value(), global: false, ...at };
      return { kind: "do", name: word, args: to.kind === "call" ? to.args : [], ...place };
    }
    // A function may be called with its arguments behind its name.
    if (this.asText && second === "(" && this.functions.has(word)) return this.calling(at);
    if (this.asText && second !== "=" && this.functions.has(word)) {
      cursor.advance();
      return given(this.values());
    }
    // A function may be called by its name alone.
    if (second === "(" || (second === "" && !this.asText)) return this.calling(at);
    if (this.asText) {
      // A function of another file, or an instruction that is not known here: it may move the robot, and is named.
      cursor.advance();
      cursor.skip(each => each.isAt("line-end"));
      return given([]);
    }
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
      this.constant(
        name,
        place,
        name.endsWith("$") && this.asText
          ? { kind: "text", value: "", ...place }
          : { kind: "number", value: 0, ...place },
      );
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
      if (this.asText && this.cursor.accept(",")) return { kind: "wait-until", when, timeout: this.value(), ...at };
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

  private motion(name: string, at: TextPlace, points: number): Statement {
    const { cursor } = this;
    const args: Argument[] = [];
    for (let count = points; count > 0; count--) {
      const place = cursor.here;
      args.push({ value: this.point(), ...place });
      if (count > 1) cursor.expect(",");
    }
    while (!this.atEnd && !(this.asText && cursor.next === "else")) {
      const place = cursor.here;
      if (this.asText && cursor.next === "!") {
        this.parallel();
        continue;
      }
      const word = cursor.name("CP");
      if (this.asText && this.optionAsText(word, args, place)) continue;
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

  /** `!D50; On 1!`: what is done during the motion is done at its end, and said. */
  private parallel(): void {
    const { cursor } = this;
    const at = cursor.here;
    cursor.advance();
    const inside: Statement[] = [];
    while (cursor.next !== "!" && !cursor.isAt("line-end") && !cursor.done) {
      if (cursor.accept(";")) continue;
      if (cursor.kind === "word" && /^d[0-9]+$/.test(cursor.next)) {
        cursor.advance();
        continue;
      }
      if (cursor.next === "on" || cursor.next === "off" || cursor.next === "wait") {
        const place = cursor.here;
        const name = cursor.take();
        const value = this.value();
        const statement: Statement = { kind: "do", name, args: [{ value, ...place }], ...place };
        if (name !== "wait") inside.push(statement);
        continue;
      }
      cursor.advance();
    }
    cursor.accept("!");
    this.kept.push(
      textFault(
        at,
        "statements behind the motion",
        `Line ${at.line}: what is done during the motion is done when it is over.`,
      ),
    );
    this.behind.push(...inside);
  }
  /** What was read beside a motion, to be done behind it. */
  private readonly behind: Statement[] = [];

  protected override trailing(): Statement[] {
    return this.behind.splice(0);
  }

  protected override statementAsText(word: string, at: TextPlace): Statement | undefined {
    const { cursor } = this;
    const simple = (name: string): Statement => {
      cursor.skip(each => each.isAt("line-end"));
      return { kind: "do", name, args: [], ...at };
    };
    if (Object.hasOwn(MOTIONS_AS_TEXT, word)) {
      cursor.advance();
      return this.motion(word, at, MOTIONS_AS_TEXT[word]!);
    }
    if (cursor.kind === "word" && cursor.second === ":") {
      cursor.advance();
      cursor.advance();
      return this.labelled("label", word, at);
    }
    switch (word) {
      case "goto":
        cursor.advance();
        return this.labelled("goto", cursor.name("a label"), at);
      case "pallet": {
        cursor.advance();
        return this.pallet(at);
      }
      case "bmove":
      case "bgo":
        cursor.advance();
        return this.motion(word, at, 1);
      case "xqt":
      case "home":
      case "pulse":
        return simple(word);
      case "limz":
        cursor.advance();
        return { kind: "do", name: "limz", args: this.values(), ...at };
      case "till": {
        cursor.advance();
        return { kind: "do", name: "till", args: [{ value: this.value(), ...at }], ...at };
      }
      default:
        return undefined;
    }
  }

  /** `Pallet 1, P1, P2, P3[, P4], 3, 2`: a number, the corners, how many along either side. */
  private pallet(at: TextPlace): Statement {
    const { cursor } = this;
    cursor.accept("outside");
    cursor.accept(",");
    return { kind: "do", name: "pallet", args: this.values(), ...at };
  }

  /** Options of a motion that are executed, or kept and named. */
  private optionAsText(word: string, args: Argument[], place: TextPlace): boolean {
    const { cursor } = this;
    if (word === "till" || word === "find" || word === "sense") {
      if (this.atEnd || cursor.next === "!") args.push({ name: "till", ...place });
      else args.push({ name: "till", value: this.value(), ...place });
      return true;
    }
    if (word === "limz") {
      args.push({ name: "limz", value: this.value(5), ...place });
      return true;
    }
    if (/^c[0-7]$/.test(word) || word === "perform" || word === "ecp") return true;
    return false;
  }

  /** A place with steps from it and what it asks for: `P1 +TLZ(10) /1 /L`. */
  private point(): Expression {
    const { cursor } = this;
    let left = this.value(5);
    for (;;) {
      const { line, column } = cursor.here;
      if (!cursor.isAt("sign")) return left;
      if (cursor.accept("/")) {
        if (this.asText && cursor.accept("(")) {
          const right = this.value();
          cursor.expect(")");
          left = { kind: "binary", sign: "/", left, right, line, column };
          continue;
        }
        if (!cursor.isAt("number") && !cursor.isAt("word")) throw cursor.unexpected("a local or a posture");
        const value = cursor.take();
        left = { kind: "binary", sign: "/", left, right: { kind: "text", value, line, column }, line, column };
      } else if (this.asText && cursor.next === ":" && cursor.kind === "sign") {
        cursor.advance();
        left = { kind: "binary", sign: ":", left, right: this.value(5), line, column };
      } else if (cursor.next === "+" || cursor.next === "-") {
        const sign = cursor.take();
        left = { kind: "binary", sign, left, right: this.value(5), line, column };
      } else return left;
    }
  }
}

const isPoint = (word: string): boolean => /^p[0-9]*$/.test(word);
