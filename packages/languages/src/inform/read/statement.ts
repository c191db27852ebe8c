import { TextError } from "../../parser/index.ts";
import type { Cursor } from "./cursor.ts";
import type { Condition, Move, Operand, Statement } from "./syntax.ts";

type Body<S> = S extends unknown ? Omit<S, "line" | "column"> : never;
type Reader = (cursor: Cursor) => Body<Statement>;

const POSITION = /^(?:C|L?P)[0-9]{3,5}$/i;
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
  return positionKey(text);
}

export function variable(cursor: Cursor): string {
  const at = cursor.here;
  const text = cursor.take();
  if (!VARIABLE.test(text))
    throw new TextError(
      at,
      "a variable such as B000, I000, D000 or R000",
      `"${text}" is no variable that is understood here.`,
    );
  return text.toUpperCase();
}

/** `IN#(1)` or `OT#(1)`. */
function wire(cursor: Cursor): Extract<Operand, { kind: "line" }> {
  const at = cursor.here;
  const word = cursor.take().toUpperCase();
  if (word !== "IN#" && word !== "OT#")
    throw new TextError(at, "IN#(n) or OT#(n)", `"${word}" is no line that is understood here.`);
  return { kind: "line", wire: word === "IN#" ? "IN" : "OT", number: bracketed(cursor) };
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
  if (cursor.next === "IN#" || cursor.next === "OT#") return wire(cursor);
  return { kind: "variable", name: variable(cursor) };
}

export function condition(cursor: Cursor): Condition {
  const left = operand(cursor);
  const at = cursor.here;
  const sign = cursor.take();
  if (!SIGNS.has(sign)) throw new TextError(at, "=, <>, <, >, <= or >=", `"${sign}" compares nothing.`);
  if (cursor.next === "ON" || cursor.next === "OFF")
    return { left, sign: sign as Condition["sign"], right: cursor.take().toUpperCase() as "ON" | "OFF" };
  return { left, sign: sign as Condition["sign"], right: operand(cursor) };
}

const when = (cursor: Cursor): Condition | undefined => (cursor.accept("IF") ? condition(cursor) : undefined);
const isOn = (cursor: Cursor): boolean => {
  if (cursor.next !== "ON" && cursor.next !== "OFF") throw cursor.unexpected("ON or OFF");
  return cursor.take().toUpperCase() === "ON";
};

function move(motion: Move["motion"], cursor: Cursor): Body<Statement> {
  const to = position(cursor);
  let vj: number | undefined;
  let v: number | undefined;
  let pl: number | undefined;
  let cr: number | undefined;
  let acc: number | undefined;
  let dec: number | undefined;
  let isLastOfArc = false;
  let until: Condition | undefined;
  while (!cursor.done) {
    const at = cursor.here;
    const before = cursor.next;
    vj = cursor.tag("VJ") ?? vj;
    v = cursor.tag("V") ?? v;
    pl = cursor.tag("PL") ?? pl;
    cr = cursor.tag("CR") ?? cr;
    acc = cursor.tag("ACC") ?? acc;
    dec = cursor.tag("DEC") ?? dec;
    cursor.tag("VR");
    cursor.tag("SPD");
    if (cursor.accept("FPT")) isLastOfArc = true;
    else if (cursor.accept("UNTIL")) until = condition(cursor);
    else cursor.accept("NWAIT");
    if (!cursor.done && cursor.here.column === at.column)
      throw new TextError(
        at,
        "VJ=, V=, PL=, CR=, ACC=, DEC=, NWAIT, FPT or UNTIL",
        `"${before}" is no part of ${motion} that is understood here.`,
      );
  }
  return { kind: "move", motion, position: to, vj, v, pl, cr, acc, dec, isLastOfArc, until };
}

const arithmetic =
  (word: "SET" | "ADD" | "SUB" | "MUL" | "DIV"): Reader =>
  cursor => {
    if (/^L?P[0-9]/.test(cursor.next)) {
      const to = position(cursor);
      // A position is cleared by taking it from itself.
      if (word !== "SUB" || positionKey(cursor.take()) !== to) throw cursor.unexpected("a number");
      return { kind: "clear", from: to, count: 1 };
    }
    return { kind: "arithmetic", word, to: variable(cursor), by: operand(cursor) };
  };
const count =
  (word: "ADD" | "SUB"): Reader =>
  cursor => ({ kind: "arithmetic", word, to: variable(cursor), by: { kind: "number", value: 1 } });
const nothing: Reader = cursor => {
  cursor.skip();
  return { kind: "nothing" };
};

const READERS: Readonly<Record<string, Reader>> = {
  MOVJ: cursor => move("MOVJ", cursor),
  MOVL: cursor => move("MOVL", cursor),
  MOVC: cursor => move("MOVC", cursor),
  MOVS: cursor => move("MOVS", cursor),
  TIMER: cursor => {
    cursor.expect("T");
    cursor.expect("=");
    const isHundredths = cursor.nextKind !== "number";
    return { kind: "timer", s: operand(cursor), isHundredths };
  },
  DOUT: cursor => {
    const { number } = output(cursor);
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
    if (cursor.next === "T")
      throw new TextError(
        cursor.here,
        "a wait without an end",
        "After the time of T= the job goes on as if nothing were missing: that is not understood here.",
      );
    return { kind: "wait", when: awaited };
  },
  HAND: cursor => {
    cursor.number("the number of the hand");
    return { kind: "hand", to: isOn(cursor) };
  },
  CALL: cursor => {
    cursor.expect("JOB");
    cursor.expect(":");
    const job = cursor.name("the name of a job");
    return { kind: "call", job, when: when(cursor) };
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
    const to = position(cursor);
    const element = bracketed(cursor);
    return { kind: "element", get: false, position: to, element, with: operand(cursor) };
  },
  GETE: cursor => {
    const name = variable(cursor);
    const from = position(cursor);
    return { kind: "element", get: true, position: from, element: bracketed(cursor), with: { kind: "variable", name } };
  },
  GETS: cursor => {
    const at = cursor.here;
    const to = cursor.take().toUpperCase();
    if (!/^PX[0-9]{3}$/.test(to)) throw new TextError(at, "a variable such as PX000", `"${to}" takes no position.`);
    if (cursor.next !== "$PX000") throw cursor.unexpected("$PX000, the position of the robot");
    cursor.take();
    return { kind: "here", position: positionKey(`P${to.slice(2)}`) };
  },
  CLEAR: cursor => {
    if (cursor.next === "STACK") return nothing(cursor);
    const from = variable(cursor);
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
  NOP: () => ({ kind: "nothing" }),
  REFP: nothing,
  CLS: nothing,
};

function output(cursor: Cursor): Extract<Operand, { kind: "line" }> {
  const at = cursor.here;
  const line = wire(cursor);
  if (line.wire !== "OT") throw new TextError(at, "OT#(n)", "An input is not written.");
  return line;
}

/** Why a word that INFORM knows is refused here. */
const REFUSED: Readonly<Record<string, string>> = {
  IMOV: "IMOV moves by an amount: write the position.",
  PSTART: "PSTART begins a second task, which is not understood here.",
};

/** One instruction that moves, sets or waits; control words (IFTHENEXP, FOR, JUMP, …) are read by `job.ts`. */
export function readStatement(cursor: Cursor): Statement {
  const { line, column } = cursor.here;
  const word = cursor.next;
  const reader = Object.hasOwn(READERS, word) ? READERS[word] : undefined;
  if (reader === undefined) {
    throw new TextError(
      { line, column },
      "an instruction of INFORM",
      (Object.hasOwn(REFUSED, word) ? REFUSED[word] : undefined) ??
        `"${cursor.done ? "" : cursor.take()}" is no instruction of INFORM that is understood here.`,
    );
  }
  cursor.take();
  const body = reader(cursor);
  cursor.expectEnd();
  return { ...body, line, column };
}
