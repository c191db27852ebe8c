import { TextError } from "../../parser/index.ts";
import type { Cursor } from "./cursor.ts";
import type { Condition, Move, Operand, Statement, Wire } from "./syntax.ts";

type Body<S> = S extends unknown ? Omit<S, "line" | "column"> : never;
type Reader = (cursor: Cursor) => Body<Statement>;

const POSITION = /^(?:C|L?PX?)[0-9]{3,5}$/i;
/** Positions of further axes that go with a motion. */
const OTHERS = /^(?:BC|EC|BP|EX)[0-9]{3,5}$/i;
const VARIABLE = /^L?[BIDR][0-9]{3}$/i;
const SIGNS = new Set(["=", "<>", "<", ">", "<=", ">="]);

/** `C001` and `C00001` are one position, `P0001` and `P001` one variable. */
export const positionKey = (text: string): string => {
  const upper = text.toUpperCase();
  const letters = /^[A-Z]+/.exec(upper)![0];
  return `${letters}${upper
    .slice(letters.length)
    .replace(/^0+(?=[0-9])/, "")
    .padStart(letters === "C" ? 5 : 3, "0")}`;
};

function position(cursor: Cursor): string {
  const at = cursor.here;
  const text = cursor.take();
  if (!POSITION.test(text)) throw new TextError(at, "a position such as C00000 or P000", `"${text}" is no position.`);
  // PX000 is P000 with the further axes.
  return positionKey(text.replace(/^(L?P)X/i, "$1"));
}

export function variable(cursor: Cursor): string {
  const at = cursor.here;
  const text = cursor.take();
  // B[LB014]: which one is said by a variable.
  if (/^L?[BIDR]$/i.test(text) && cursor.accept("[")) {
    const index = cursor.nextKind === "number" ? String(cursor.number()) : variable(cursor);
    cursor.expect("]");
    return `${text.toUpperCase()}[${index}]`;
  }
  if (!VARIABLE.test(text))
    throw new TextError(
      at,
      "a variable such as B000, I000, D000 or R000",
      `"${text}" is no variable that is understood here.`,
    );
  return text.toUpperCase();
}

const WIRES: Readonly<Record<string, Wire>> = {
  "IN#": "IN",
  "OT#": "OT",
  "SIN#": "SIN",
  "SOUT#": "SOUT",
  "IG#": "IG",
  "OG#": "OG",
  "IGH#": "IGH",
  "OGH#": "OGH",
  "AI#": "AI",
  "RIN#": "RIN",
};

/** `IN#(1)`, `OT#(1)`, or a group of lines as `IG#(1)`. */
function wire(cursor: Cursor): Extract<Operand, { kind: "line" }> {
  const at = cursor.here;
  const word = cursor.take().toUpperCase();
  if (!Object.hasOwn(WIRES, word))
    throw new TextError(at, "IN#(n) or OT#(n)", `"${word}" is no line that is understood here.`);
  return { kind: "line", wire: WIRES[word]!, number: bracketed(cursor) };
}

function bracketed(cursor: Cursor): number {
  cursor.expect("(");
  const at = cursor.here;
  const number = cursor.number();
  if (!Number.isInteger(number) || number < 1)
    throw new TextError(at, "a number from 1", `There is no ${number} here.`);
  cursor.expect(")");
  return number;
}

export function operand(cursor: Cursor): Operand {
  if (cursor.nextKind === "number") return { kind: "number", value: cursor.number() };
  if (Object.hasOwn(WIRES, cursor.next)) return wire(cursor);
  return { kind: "variable", name: variable(cursor) };
}

/** EXPRESS a + b * c: sums of products, with brackets; deep ones end with the line. */
function expression(cursor: Cursor, depth = 0): Operand {
  if (depth > 20)
    throw new TextError(cursor.here, "a simpler expression", "The expression is nested more than 20 deep.");
  const term = (): Operand => {
    if (cursor.accept("-")) return { kind: "sum", sign: "-", left: { kind: "number", value: 0 }, right: term() };
    if (!cursor.accept("(")) return operand(cursor);
    const inner = expression(cursor, depth + 1);
    cursor.expect(")");
    return inner;
  };
  const product = (): Operand => {
    let left = term();
    while (cursor.next === "*" || cursor.next === "/") {
      const sign = cursor.take() as "*" | "/";
      left = { kind: "sum", sign, left, right: term() };
    }
    return left;
  };
  let left = product();
  for (;;) {
    // B001-1 is read as B001 and −1.
    if (cursor.nextKind === "number" && cursor.next.startsWith("-"))
      left = { kind: "sum", sign: "+", left, right: product() };
    else if (cursor.next === "+" || cursor.next === "-") {
      const sign = cursor.take() as "+" | "-";
      left = { kind: "sum", sign, left, right: product() };
    } else return left;
  }
}

const JOINS = new Set(["ANDEXP", "OREXP", "ANDIF", "ORIF"]);

/** One comparison, or several joined by ANDEXP and OREXP. */
export function condition(cursor: Cursor): Condition {
  const first = comparison(cursor);
  const more: { join: "and" | "or"; condition: Condition }[] = [];
  while (JOINS.has(cursor.next)) {
    const join = cursor.take().toUpperCase().startsWith("AND") ? "and" : "or";
    more.push({ join, condition: comparison(cursor) });
  }
  return more.length === 0 ? first : { ...first, more };
}

function comparison(cursor: Cursor): Condition {
  const left = operand(cursor);
  const at = cursor.here;
  const sign = cursor.take();
  if (!SIGNS.has(sign)) throw new TextError(at, "=, <>, <, >, <= or >=", `"${sign}" compares nothing.`);
  if (cursor.next === "ON" || cursor.next === "OFF")
    return { left, sign: sign as Condition["sign"], right: cursor.take().toUpperCase() as "ON" | "OFF" };
  return { left, sign: sign as Condition["sign"], right: operand(cursor) };
}

const when = (cursor: Cursor): Condition | undefined =>
  cursor.accept("IF") || cursor.accept("IFEXPRESS") ? condition(cursor) : undefined;
const isOn = (cursor: Cursor): boolean => {
  if (cursor.next !== "ON" && cursor.next !== "OFF") throw cursor.unexpected("ON or OFF");
  return cursor.take().toUpperCase() === "ON";
};

/** What a motion can say besides its position. */
interface Said {
  vj?: number | undefined;
  v?: number | undefined;
  pl?: number | undefined;
  cr?: number | undefined;
  acc?: number | undefined;
  dec?: number | undefined;
  isLastOfArc: boolean;
  until?: Condition | undefined;
  others: string[];
  by: Move["by"];
  speedIn: { v?: Operand; vj?: Operand };
}
const NUMBERS = { VJ: "vj", V: "v", PL: "pl", CR: "cr", ACC: "acc", DEC: "dec" } as const;
/** Tags of which the path and the place of the tool know nothing. */
const UNSEEN = new Set(["VR", "VE", "SPD", "CV", "DIS", "SYNCHRO"]);

function move(motion: Move["motion"], cursor: Cursor, how: "follows" | "by" | undefined = undefined): Body<Statement> {
  const to = position(cursor);
  const said: Said = {
    isLastOfArc: false,
    others: [],
    speedIn: {},
    by: how === "by" ? { frame: "BASE", user: 0 } : undefined,
  };
  while (!cursor.done) {
    const at = cursor.here;
    const before = cursor.next;
    // Another group goes with it.
    if (before === "+") {
      said.others.push(cursor.rest());
      break;
    }
    if (OTHERS.test(before)) said.others.push(positionKey(cursor.take()));
    else if (!option(said, cursor) || (!cursor.done && cursor.here.column === at.column))
      throw new TextError(
        at,
        "VJ=, V=, PL=, CR=, ACC=, DEC=, NWAIT, FPT or UNTIL",
        `"${before}" is no part of ${motion} that is understood here.`,
      );
  }
  const { others, by, speedIn, isLastOfArc, vj, v, pl, cr, acc, dec, until } = said;
  return {
    kind: "move",
    motion,
    position: to,
    vj,
    v,
    pl,
    cr,
    acc,
    dec,
    isLastOfArc,
    until,
    ...(others.length === 0 ? {} : { others }),
    ...(Object.keys(speedIn).length === 0 ? {} : { speedIn }),
    ...(how === "follows" ? { follows: true } : {}),
    ...(by === undefined ? {} : { by }),
  };
}

/** One thing that a motion says besides its position; false where none stands. */
function option(said: Said, cursor: Cursor): boolean {
  const word = cursor.next;
  if ((word === "V" || word === "VJ") && cursor.second === "=") {
    cursor.take();
    cursor.take();
    const key = word === "V" ? "v" : "vj";
    if (cursor.nextKind === "number") said[key] = cursor.number();
    else said.speedIn[key] = operand(cursor);
    return true;
  }
  if (Object.hasOwn(NUMBERS, word) && cursor.second === "=") {
    said[NUMBERS[word as keyof typeof NUMBERS]] = cursor.tag(word);
    return true;
  }
  if (UNSEEN.has(word) && cursor.second === "=") return cursor.tag(word) !== undefined;
  if (cursor.accept("FPT")) return (said.isLastOfArc = true);
  // A search ends at its line as a motion with UNTIL does.
  if (cursor.accept("UNTIL") || cursor.accept("SRCH")) {
    said.until = condition(cursor);
    return true;
  }
  if (said.by !== undefined) {
    const frames = { BF: "BASE", RF: "ROBOT", TF: "TOOL" } as const;
    if (word === "BF" || word === "RF" || word === "TF") {
      cursor.take();
      said.by = { frame: frames[word], user: 0 };
      return true;
    }
    if (cursor.accept("UF#")) {
      said.by = { frame: "USER", user: bracketed(cursor) };
      return true;
    }
  }
  return cursor.accept("NWAIT");
}

const arithmetic =
  (word: "SET" | "ADD" | "SUB" | "MUL" | "DIV"): Reader =>
  cursor => {
    if (/^L?PX?[0-9]/.test(cursor.next)) {
      const to = position(cursor);
      if (word === "MUL" || word === "DIV") throw cursor.unexpected("a number");
      const at = cursor.here;
      const by = position(cursor);
      if (by.startsWith("C")) throw new TextError(at, "a position variable", `${by} belongs to its motion.`);
      // A position is cleared by taking it from itself.
      return word === "SUB" && by === to ? { kind: "clear", from: to, count: 1 } : { kind: "positions", word, to, by };
    }
    if (/^L?(?:S|BP|EX)[0-9]/.test(cursor.next)) return shown("a text or a position of further axes is set")(cursor);
    const to = variable(cursor);
    return { kind: "arithmetic", word, to, by: cursor.accept("EXPRESS") ? expression(cursor) : operand(cursor) };
  };
const count =
  (word: "ADD" | "SUB"): Reader =>
  cursor => ({ kind: "arithmetic", word, to: variable(cursor), by: { kind: "number", value: 1 } });
/** Kept and named: of what the robot's motion knows nothing. */
const shown =
  (what: string): Reader =>
  cursor => {
    cursor.skip();
    return { kind: "shown", what };
  };
/** A variable that takes what only the controller knows. */
const unknown =
  (from: string): Reader =>
  cursor => {
    const to = /^L?PX?[0-9]/.test(cursor.next) ? position(cursor) : variable(cursor);
    cursor.skip();
    return { kind: "unknown", to, from };
  };
/** Does what is written in the controller: it may move the robot. */
const away =
  (what: string): Reader =>
  cursor => {
    const text = cursor.rest();
    return { kind: "away", what: `${what} ${text}`.trim() };
  };
const nothing: Reader = cursor => {
  cursor.skip();
  return { kind: "nothing" };
};

const READERS: Readonly<Record<string, Reader>> = {
  MOVJ: cursor =>
    OTHERS.test(cursor.next.replace(/^L/, "")) ? shown("further axes move")(cursor) : move("MOVJ", cursor),
  MOVL: cursor =>
    OTHERS.test(cursor.next.replace(/^L/, "")) ? shown("further axes move")(cursor) : move("MOVL", cursor),
  MOVC: cursor => move("MOVC", cursor),
  MOVS: cursor => move("MOVS", cursor),
  TIMER: cursor => {
    cursor.expect("T");
    cursor.expect("=");
    const isHundredths = cursor.nextKind !== "number";
    return { kind: "timer", s: operand(cursor), isHundredths };
  },
  SMOVL: cursor => move("MOVL", cursor, "follows"),
  SMOVC: cursor => move("MOVC", cursor, "follows"),
  IMOV: cursor =>
    OTHERS.test(cursor.next.replace(/^L/, "")) ? shown("further axes move")(cursor) : move("MOVL", cursor, "by"),
  DOUT: cursor => {
    if (cursor.next === "OG#" || cursor.next === "OGH#") {
      const { wire: word, number } = wire(cursor);
      return { kind: "group", wire: word as "OG" | "OGH", number, to: operand(cursor) };
    }
    const { number, wire: on } = output(cursor);
    if (on === "SOUT") return { kind: "dout", number, to: isOn(cursor), wire: "SOUT" };
    return { kind: "dout", number, to: isOn(cursor) };
  },
  PULSE: cursor => {
    const { number } = output(cursor);
    return { kind: "pulse", number, s: cursor.tag("T") ?? 0.3 };
  },
  AOUT: cursor => {
    cursor.expect("AO#");
    const number = bracketed(cursor);
    return { kind: "aout", number, to: cursor.number() };
  },
  DIN: cursor => {
    const to = variable(cursor);
    return { kind: "din", to, from: wire(cursor) };
  },
  WAIT: cursor => {
    const awaited = condition(cursor);
    if (!cursor.accept("T")) return { kind: "wait", when: awaited };
    cursor.expect("=");
    const isHundredths = cursor.nextKind !== "number";
    const s = operand(cursor);
    return {
      kind: "wait",
      when: awaited,
      s: isHundredths ? { kind: "sum", sign: "/", left: s, right: { kind: "number", value: 100 } } : s,
    };
  },
  HAND: cursor => {
    cursor.number("the number of the hand");
    return { kind: "hand", to: isOn(cursor) };
  },
  CALL: cursor => {
    cursor.expect("JOB");
    cursor.expect(":");
    const job = cursor.name("the name of a job");
    const args: Operand[] = [];
    while (cursor.next.startsWith("ARGF")) args.push(argument(cursor));
    return { kind: "call", job, when: when(cursor), ...(args.length === 0 ? {} : { args }) };
  },
  RET: cursor => ({ kind: "return", when: when(cursor) }),
  ABORT: cursor => ({ kind: "abort", when: when(cursor) }),
  PAUSE: cursor => {
    when(cursor);
    return { kind: "nothing" };
  },
  MSG: cursor => {
    if (cursor.nextKind !== "text") throw cursor.unexpected("a text in quotes");
    return { kind: "message", text: cursor.take().slice(1, -1) };
  },
  SET: arithmetic("SET"),
  ADD: arithmetic("ADD"),
  SUB: arithmetic("SUB"),
  MUL: arithmetic("MUL"),
  DIV: arithmetic("DIV"),
  INC: count("ADD"),
  DEC: count("SUB"),
  SETE: cursor => {
    if (OTHERS.test(cursor.next.replace(/^L/, ""))) return shown("a position of further axes is set")(cursor);
    const to = position(cursor);
    const element = bracketed(cursor);
    return { kind: "element", get: false, position: to, element, with: operand(cursor) };
  },
  GETE: cursor => {
    const name = variable(cursor);
    if (OTHERS.test(cursor.next.replace(/^L/, "")))
      return { kind: "unknown", to: name, from: `${cursor.rest()}, a position of further axes` };
    const from = position(cursor);
    return { kind: "element", get: true, position: from, element: bracketed(cursor), with: { kind: "variable", name } };
  },
  GETS: cursor => {
    const at = cursor.here;
    const to = cursor.take().toUpperCase();
    if (/^L?[BIDR][0-9]{3}$/.test(to)) {
      const from = cursor.rest();
      return { kind: "unknown", to, from };
    }
    if (!/^L?PX[0-9]{3,5}$/.test(to)) throw new TextError(at, "a variable such as PX000", `"${to}" takes no position.`);
    const key = positionKey(to.replace("PX", "P"));
    const from = cursor.take().toUpperCase();
    if (!/^\$PX[0-9]+$/.test(from))
      throw new TextError(at, "$PX000, the position of the robot", `"${from}" is no position.`);
    // $PX000 and $PX001 are where the robot is; others are what sensors found.
    if (from !== "$PX000" && from !== "$PX001")
      return { kind: "unknown", to: key, from: `${from}, a position of a sensor` };
    return { kind: "here", position: key };
  },
  CLEAR: cursor => {
    if (cursor.next === "STACK" || cursor.next === "MPF") return nothing(cursor);
    const from = /^L?P[0-9]/.test(cursor.next) ? position(cursor) : variable(cursor);
    return { kind: "clear", from, count: cursor.accept("ALL") ? 1000 : cursor.number() };
  },
  SFTON: cursor => {
    const to = position(cursor);
    if (cursor.accept("UF#")) return { kind: "shift", position: to, frame: "USER", user: bracketed(cursor) };
    if (cursor.next === "TF")
      throw new TextError(cursor.here, "BF, RF or UF#(n)", "A shift along the tool is not understood here.");
    const isRobot = cursor.accept("RF");
    if (!isRobot) cursor.accept("BF");
    return { kind: "shift", position: to, frame: isRobot ? "ROBOT" : "BASE", user: 0 };
  },
  SFTOF: () => ({ kind: "shift-off" }),
  SPEED: cursor => {
    let vj: number | undefined;
    let v: number | undefined;
    while (!cursor.done) {
      const before = cursor.here.column;
      vj = cursor.tag("VJ") ?? vj;
      v = cursor.tag("V") ?? v;
      cursor.tag("VR");
      if (!cursor.done && cursor.here.column === before) throw cursor.unexpected("VJ=, V= or VR=");
    }
    return { kind: "speed", vj, v };
  },
  GETARG: cursor => {
    const to = variable(cursor);
    cursor.expect("IARG#");
    return { kind: "argument", to, number: bracketed(cursor) };
  },
  GETREG: unknown("a register of the controller"),
  GETPOS: unknown("the position of a step"),
  CNVRT: unknown("a position in other numbers"),
  MULMAT: unknown("a product of positions"),
  INVMAT: unknown("the inverse of a position"),
  VERSION: unknown("the version of the controller"),
  MFRAME: cursor => {
    cursor.expect("UF#");
    const user = bracketed(cursor);
    const through = [position(cursor), position(cursor), position(cursor)] as const;
    cursor.accept("MTOOL");
    return { kind: "frame", user, through };
  },
  SSFTOF: shown("the shift of the seam search is switched off"),
  SSFTON: away("SSFTON"),
  MEMOF: shown("the memory of shifts is switched off"),
  MEMON: shown("the memory of shifts is switched on"),
  CLRSENS: shown("the arc sensor is reset"),
  COMARCON: away("the arc sensor"),
  COMARCOF: shown("the arc sensor is switched off"),
  FORMAPR: away("FORMAPR"),
  FORMCUT: away("FORMCUT"),
  WVON: away("WVON"),
  WVOF: shown("the weaving ends"),
  ARCON: shown("the arc of a welding torch is switched"),
  ARCOF: shown("the arc of a welding torch is switched"),
  ARCSET: shown("the current of the weld is set"),
  ARCCTS: shown("the current of the weld is set"),
  ARCCTE: shown("the current of the weld is set"),
  AWELD: shown("the current of the weld is set"),
  VWELD: shown("the voltage of the weld is set"),
  WVADJ: shown("the weaving is set"),
  SETREG: shown("a register of the controller is set"),
  SETUALM: shown("an alarm is raised"),
  SETFILE: shown("a file of the controller is set"),
  SKILLSND: shown("a message goes to another device"),
  PSTART: shown("another job is started beside this one"),
  PWAIT: shown("the end of another job is awaited"),
  TWAIT: shown("another job is awaited"),
  TSYNC: shown("another job is awaited"),
  SYNCH: shown("another job is awaited"),
  WSET: shown("a value of another device is set"),
  DIALOG: shown("a person is asked"),
  INPUT: shown("a person is asked"),
  ADVINIT: shown("the reading ahead is set"),
  ADVSTOP: shown("the reading ahead is stopped"),
  COMM: shown("a comment"),
  TOOLON: shown("a tool is switched"),
  TOOLOF: shown("a tool is switched"),
  SVSPOT: shown("a spot gun is closed"),
  SPOT: shown("a spot gun is closed"),
  SVGUNCL: shown("a spot gun is closed"),
  GUNCL: shown("a spot gun is closed"),
  GUNCHG: shown("the gun is changed"),
  SETMSG: shown("a message is set"),
  TEXT: shown("a text is made"),
  STR$: shown("a text is made"),
  CHR$: shown("a text is made"),
  CAT$: shown("a text is made"),
  LEN: unknown("the length of a text"),
  VAL: unknown("a text"),
  ASC: unknown("a text"),
  NOP: () => ({ kind: "nothing" }),
  REFP: nothing,
  CLS: nothing,
};

function output(cursor: Cursor): Extract<Operand, { kind: "line" }> {
  const at = cursor.here;
  const line = wire(cursor);
  if (line.wire !== "OT" && line.wire !== "SOUT") throw new TextError(at, "OT#(n)", "An input is not written.");
  return line;
}

/** ARGF and a value close behind it: ARGF12.5, ARGFB000. */
function argument(cursor: Cursor): Operand {
  const at = cursor.here;
  const text = cursor.name("ARGF and a value").slice(4);
  if (VARIABLE.test(text)) return { kind: "variable", name: text.toUpperCase() };
  const value = Number(text);
  if (text === "" || !Number.isFinite(value)) throw new TextError(at, "ARGF and a value", `"${text}" is no argument.`);
  return { kind: "number", value };
}

/** One instruction that moves, sets or waits; control words (IFTHENEXP, FOR, JUMP, …) are read by `job.ts`. */
export function readStatement(cursor: Cursor): Statement {
  const { line, column } = cursor.here;
  const word = cursor.next;
  const macro = /^MACRO?[0-9]*$/.test(word) || word === "MJ#";
  const reader = Object.hasOwn(READERS, word) ? READERS[word] : macro ? away("the macro") : undefined;
  if (word === "+") {
    cursor.skip();
    return { kind: "shown", what: "another group moves", line, column };
  }
  if (reader === undefined) {
    throw new TextError(
      { line, column },
      "an instruction of INFORM",
      `"${cursor.done ? "" : cursor.take()}" is no instruction of INFORM that is understood here.`,
    );
  }
  cursor.take();
  const body = reader(cursor);
  cursor.expectEnd();
  return { ...body, line, column };
}
