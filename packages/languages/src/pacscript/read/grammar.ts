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
  constants: { true: true, on: true, false: false, off: false },
  tags: [],
  index: "[",
  components: false,
  reserved: new Set([
    "sub",
    "end sub",
    "end if",
    "else",
    "elseif",
    "next",
    "loop",
    "wend",
    "end select",
    "case",
    "then",
    "to",
    "step",
    "until",
  ]),
  args: (cursor, depth) => readPlainArguments(cursor, depth, RULES),
};
const elsewhere = (what: string): string => `${what}, which is not executed here.`;
const SIGNS = [
  "<=",
  ">=",
  "<>",
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
  "&",
  ".",
];
const GRAMMAR: BasicGrammar = {
  lexicon: {
    comment: "'",
    quotes: '"',
    doubled: false,
    lineEnds: true,
    signs: SIGNS,
    word: /end[ \t]+(?:sub|if|select)\b|exit[ \t]+(?:sub|for|do)\b|[A-Za-z_][A-Za-z0-9_]*[%!$&]?/iy,
  },
  expression: RULES,
  alike: { endif: "end if", "end program": "end" },
  backByDefault: true,
  shown: {
    extspeed: "it is the operator's speed",
    input: "what comes from outside is not known here",
    on: "errors do not arise here",
    hold: "it waits for a person",
    suspend: "it stops another task",
    run: "another task does not move the arm",
  },
  unsayable: {
    stop: elsewhere("Stop ends all tasks"),
    goto: elsewhere("GoTo jumps"),
    gosub: elsewhere("GoSub jumps to a label"),
    run: elsewhere("Run starts another task"),
    archmove: elsewhere("ArchMove lifts the hand by rules of the controller"),
    drive: elsewhere("Drive turns joints on from where they are"),
    drivea: elsewhere("DriveA turns some joints and leaves others"),
    rotate: elsewhere("Rotate turns about a centre by rules of the controller"),
    rotateh: elsewhere("RotateH turns about the hand"),
    gohome: "GoHome goes to a posture that only the controller knows.",
    on: elsewhere("On belongs to the handling of errors"),
    motionskip: elsewhere("MotionSkip ends a motion by a condition"),
    hold: "Hold waits for a person, who is not here.",
    suspend: elsewhere("Suspend stops another task"),
  },
};
/** Instructions about the controller, of which a motion program keeps nothing. */
const OF_THE_CONTROLLER: ReadonlySet<string> = new Set([
  "takearm",
  "givearm",
  "motor",
  "extspeed",
  "extaccel",
  "extdecel",
  "decel",
  "speedmode",
  "cpmode",
  "highpathaccuracy",
  "singularavoid",
  "eralw",
  "grvctrl",
  "grvoffset",
  "motiontimeout",
  "curlmt",
  "arrive",
  "waitmotion",
  "open",
  "close",
  "input",
  "rem",
]);
const INSTRUCTIONS: ReadonlySet<string> = new Set([
  "speed",
  "accel",
  "delay",
  "changetool",
  "changework",
  "tool",
  "work",
  "set",
  "reset",
  "payload",
  "printdbg",
  "printmsg",
  "print",
]);
const NUMBERS: ReadonlySet<string> = new Set(["integer", "long", "single", "double", "byte", "boolean"]);

/** Reads PacScript: the subs of one file, of which `Main` is started. */
export const readPac = (text: string, asText = false): BasicAnswer => new PacReader(text, GRAMMAR, asText).source();

/** Statements that move the arm by rules of the controller, or call what only it has. */
const MOVES_AWAY: ReadonlySet<string> = new Set([
  "archmove",
  "drive",
  "drivea",
  "rotate",
  "rotateh",
  "gohome",
  "driveaex",
  "driveex",
]);

class PacReader extends BasicReader {
  protected started(): Routine | undefined {
    return this.routines.get("main") ?? [...this.routines.values()][0];
  }

  protected part(): void {
    const { cursor } = this;
    const at = cursor.here;
    this.dropRemarks();
    if (cursor.accept("#")) return this.directive();
    if (cursor.next === "dim") {
      this.declaration();
      return;
    }
    // The form of the RC7: PROGRAM name … END.
    if (this.asText && cursor.accept("program")) {
      const place = cursor.here;
      const name = cursor.name("the name of the program");
      const parameters = this.parameters();
      const body = this.body("program", at, ["end", ""]);
      cursor.accept("end");
      this.routines.set(name, { name, parameters, body, ...place });
      return;
    }
    if (this.asText && (cursor.accept("public") || cursor.accept("private"))) return this.part();
    cursor.expect("sub");
    this.routine("sub", "end sub", at, () => this.parameters());
  }

  /** `#Define name 3` gives a number a name. */
  private directive(): void {
    const { cursor } = this;
    if (cursor.next !== "define") return this.restOfLine();
    cursor.advance();
    const place = cursor.here;
    const name = cursor.name("the name of a constant");
    this.constant(name, place, this.value());
    if (!cursor.isAt("line-end") && !cursor.done) throw cursor.unexpected("the end of the line");
  }

  /** Numbers begin as 0. */
  private declaration(): void {
    const { cursor } = this;
    cursor.advance();
    do {
      const place = cursor.here;
      const name = cursor.name("the name of a variable");
      if (cursor.accept("(")) {
        this.values();
        cursor.expect(")");
      }
      const type = cursor.accept("as") ? cursor.name("a type") : "integer";
      if (cursor.accept("=")) this.constant(name, place, this.value());
      else if (NUMBERS.has(type)) this.constant(name, place, { kind: "number", value: 0, ...place });
    } while (cursor.accept(","));
  }

  protected override statementAsText(word: string, at: TextPlace): Statement | undefined {
    const { cursor } = this;
    if (word === "goto") {
      cursor.advance();
      cursor.accept("*");
      return this.labelled("goto", cursor.name("a label"), at);
    }
    if (word === "stop" && cursor.second === "") {
      cursor.advance();
      return { kind: "halt", ...at };
    }
    if (!MOVES_AWAY.has(word)) return undefined;
    cursor.skip(each => each.isAt("line-end"));
    const value: Expression = { kind: "text", value: word.replace(/^./, letter => letter.toUpperCase()), ...at };
    return { kind: "do", name: "away", args: [{ value, ...at }], ...at };
  }

  protected instruction(at: TextPlace): Statement | undefined {
    const { cursor } = this;
    const word = cursor.next;
    if (this.asText && cursor.accept("*")) return this.label(at);
    if (cursor.kind !== "word") throw cursor.unexpected("a statement");
    if (cursor.second === "=" || (cursor.second === "[" && word !== "io")) return this.assignment(at);
    if (OF_THE_CONTROLLER.has(word)) {
      cursor.advance();
      this.restOfLine();
      return undefined;
    }
    if (INSTRUCTIONS.has(word)) {
      cursor.advance();
      return { kind: "do", name: word, args: this.values(), ...at };
    }
    switch (word) {
      case "move":
      case "approach":
      case "depart":
      case "draw":
        cursor.advance();
        return this.motion(word, at);
      case "dim":
        this.declaration();
        return undefined;
      case "call":
        cursor.advance();
        return this.calling(at);
      case "halt":
        cursor.advance();
        this.restOfLine();
        return { kind: "halt", ...at };
      default:
        return this.leaving(at, word);
    }
  }

  /** `*Label:`; behind THEN it is where the program goes on. */
  private label(at: TextPlace): Statement {
    const { cursor } = this;
    const name = cursor.name("a label");
    const isHere = cursor.accept(":") || cursor.isAt("line-end");
    return this.labelled(isHere && !this.isAfterThen ? "label" : "goto", name, at);
  }

  /** What leaves a block, waits or sets a line, and subs that are called by their names. */
  private leaving(at: TextPlace, word: string): Statement | undefined {
    const { cursor } = this;
    switch (word) {
      case "exit sub":
        cursor.advance();
        return { kind: "return", ...at };
      case "exit for":
      case "exit do":
        cursor.advance();
        return { kind: "break", ...at };
      case "wait": {
        cursor.advance();
        const when = this.value();
        if (cursor.next === ",")
          throw new TextError(
            cursor.here,
            "the end of the line",
            "Wait with a limit of time goes on as if nothing had been waited for, which a step cannot say.",
          );
        return { kind: "wait-until", when, ...at };
      }
      case "io": {
        const place = cursor.here;
        const line = this.value(100);
        cursor.expect("=");
        return {
          kind: "do",
          name: "io",
          args: [
            { value: line, ...place },
            { value: this.value(), ...at },
          ],
          ...at,
        };
      }
      default:
        break;
    }
    const { second } = cursor;
    // A sub may be called by its name alone.
    if (second === "(" || second === "") return this.calling(at);
    throw new TextError(
      at,
      "a statement of PacScript",
      `"${cursor.raw}" is no statement of PacScript that is understood here.`,
    );
  }

  /**
   * `Move L, @P goal, Speed = 50`. How a point is passed stands before the last goal, or before the distance of an
   * approach.
   */
  private motion(name: string, at: TextPlace): Statement {
    const { cursor } = this;
    const args: Argument[] = [];
    const place = cursor.here;
    const way = cursor.name("P, L or C");
    args.push({ value: { kind: "text", value: way === "ptp" ? "p" : way, ...place }, ...place });
    cursor.expect(",");
    for (let count = name === "approach" || (name === "move" && way === "c") ? 2 : 1; count > 0; count--) {
      this.passing(args);
      const here = cursor.here;
      args.push({ value: this.value(), ...here });
      if (count > 1) cursor.expect(",");
    }
    while (cursor.accept(",")) {
      const here = cursor.here;
      const option = cursor.name("Speed, Accel or Decel");
      if (option === "next") continue;
      if (cursor.next !== "=")
        throw new TextError(
          here,
          "Speed, Accel or Decel",
          "Several goals in one motion are not understood here: write one motion for each.",
        );
      cursor.advance();
      const value = this.value();
      if (option === "speed" || option === "s")
        args.push(
          value.kind === "call" && value.name === "mps"
            ? { ...value.args[0]!, name: "mps" }
            : { name: "speed", value, ...here },
        );
      else if (option === "accel") args.push({ name: "accel", value, ...here });
      else if (option !== "decel")
        throw new TextError(here, "Speed, Accel or Decel", `The option ${option} is not understood here.`);
    }
    return { kind: "do", name, args, ...at };
  }

  /** `@P` passes, `@20` passes 20 mm away, `@0` and `@E` stop. */
  private passing(args: Argument[]): void {
    const { cursor } = this;
    const at = cursor.here;
    if (!cursor.accept("@")) return;
    const inBrackets = cursor.accept("[");
    const word = cursor.isAt("word") ? cursor.take() : undefined;
    if (word !== undefined && word !== "p" && word !== "e")
      throw new TextError(at, "@P, @E, @0 or a distance", `"@${word}" is not understood here.`);
    // The sign of a number that follows in brackets belongs to a value.
    const value = word === "p" ? -1 : word === "e" ? 0 : undefined;
    const away = value === undefined ? this.value(8) : ({ kind: "number", value, ...at } as const);
    if (inBrackets) cursor.expect("]");
    cursor.accept(",");
    args.push({ name: "pass", value: away, ...at });
  }
}
