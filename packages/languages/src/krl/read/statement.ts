import { TextError } from "../../parser/index.ts";
import type { Cursor } from "./cursor.ts";
import { readArguments, readExpression, readVariable } from "./expression.ts";
import type { Expression, Motion, MotionKind, Statement } from "./syntax.ts";

type Body<S> = S extends unknown ? Omit<S, "line" | "column"> : never;
type Reader = (cursor: Cursor) => Body<Statement>;

const nothing: Reader = cursor => {
  cursor.skip();
  return { kind: "nothing" };
};
const APPROXIMATIONS = new Set(["C_PTP", "C_DIS", "C_ORI", "C_VEL", "C_SPL"]);

function approximations(cursor: Cursor): string[] {
  const words: string[] = [];
  while (APPROXIMATIONS.has(cursor.next)) {
    words.push(cursor.take().toUpperCase());
    cursor.accept(",");
  }
  return words;
}

/** `WITH $VEL.CP=0.2,$TOOL=T` */
function readSettings(cursor: Cursor): Motion["settings"] {
  const settings: [ReturnType<typeof readVariable>, Expression][] = [];
  if (!cursor.accept("WITH")) return settings;
  do {
    const to = readVariable(cursor);
    cursor.expect("=");
    settings.push([to, readExpression(cursor)]);
  } while (cursor.accept(","));
  return settings;
}

const motion =
  (kind: MotionKind, { relative = false, spline = false } = {}): Reader =>
  cursor => {
    let via: Expression | undefined;
    let inTool = false;
    let target = readExpression(cursor);
    if (kind === "CIRC") {
      via = target;
      cursor.expect(",");
      target = readExpression(cursor);
      if (cursor.next === ",") {
        throw new TextError(
          cursor.here,
          "an arc that ends at its end point",
          "An arc with CA goes on beyond its end point or stops before it: that end is not written in the text.",
        );
      }
    }
    const before = approximations(cursor);
    const settings = readSettings(cursor);
    // What a relative motion counts from.
    if (relative && (cursor.next === "#TOOL" || cursor.next === "#BASE")) {
      inTool = cursor.take().toUpperCase() === "#TOOL";
    }
    return {
      kind: "motion",
      motion: kind,
      relative,
      inTool,
      spline,
      target,
      via,
      approximation: [...before, ...approximations(cursor)],
      settings,
    };
  };

const call = (name: string, cursor: Cursor): Body<Statement> => {
  cursor.expect("(");
  return { kind: "call", name, args: readArguments(cursor) };
};

function waiting(cursor: Cursor): Body<Statement> {
  if (cursor.accept("SEC")) return { kind: "wait", time: readExpression(cursor) };
  cursor.expect("FOR");
  return { kind: "wait-for", condition: readExpression(cursor) };
}

function pulse(cursor: Cursor): Body<Statement> {
  cursor.expect("(");
  const output = readVariable(cursor);
  cursor.expect(",");
  const to = readExpression(cursor);
  cursor.expect(",");
  const time = readExpression(cursor);
  cursor.expect(")");
  return { kind: "pulse", output, to, time };
}

/**
 * `TRIGGER WHEN DISTANCE=0 DELAY=20 DO $OUT[1]=TRUE`, `TRIGGER WHEN PATH=-5 ONSTART DELAY=0 DO GLUE( ) PRIO=-1`: what
 * is done at a point of the next motion.
 */
function trigger(cursor: Cursor): Body<Statement> {
  cursor.expect("WHEN");
  const where = cursor.name("DISTANCE or PATH");
  if (where !== "DISTANCE" && where !== "PATH")
    throw cursor.unexpected("DISTANCE or PATH, since nothing else is understood here");
  cursor.expect("=");
  const value = readExpression(cursor);
  const onStart = cursor.accept("ONSTART");
  let delay: Expression | undefined;
  if (cursor.accept("DELAY")) {
    cursor.expect("=");
    delay = readExpression(cursor);
  }
  cursor.expect("DO");
  const action = readStatement(cursor, true);
  if (action.kind !== "assign" && action.kind !== "call" && action.kind !== "pulse")
    throw new TextError(action, "an assignment, a pulse or a call", "TRIGGER does something else than this.");
  if (cursor.accept("PRIO")) {
    cursor.expect("=");
    readExpression(cursor);
  }
  const isPath = where === "PATH";
  return {
    kind: "trigger",
    distance: isPath ? undefined : value,
    onStart,
    path: isPath ? value : undefined,
    delay,
    action,
  };
}

/** `INTERRUPT DECL n WHEN condition DO routine( )`, `INTERRUPT ON n`, `INTERRUPT OFF n`. */
function interrupt(cursor: Cursor): Body<Statement> {
  if (cursor.accept("DECL")) {
    const number = readExpression(cursor);
    cursor.expect("WHEN");
    const condition = readExpression(cursor);
    cursor.expect("DO");
    const routine = cursor.name("the name of a routine");
    cursor.skip();
    return { kind: "interrupt", number, condition, routine };
  }
  const word = cursor.name("ON or OFF");
  return {
    kind: "interrupt-switch",
    on: word === "ON" || word === "ENABLE",
    number: cursor.done ? undefined : readExpression(cursor),
  };
}

const READERS: Readonly<Record<string, Reader>> = {
  PTP: motion("PTP"),
  LIN: motion("LIN"),
  CIRC: motion("CIRC"),
  SPL: motion("SPL"),
  SPTP: motion("PTP", { spline: true }),
  SLIN: motion("LIN", { spline: true }),
  SCIRC: motion("CIRC", { spline: true }),
  PTP_REL: motion("PTP", { relative: true }),
  LIN_REL: motion("LIN", { relative: true }),
  SPTP_REL: motion("PTP", { relative: true, spline: true }),
  SLIN_REL: motion("LIN", { relative: true, spline: true }),
  SPLINE: cursor => ({ kind: "spline", settings: readSettings(cursor) }),
  ENDSPLINE: cursor => ({ kind: "end-spline", approximation: approximations(cursor) }),
  WAIT: waiting,
  PULSE: pulse,
  TRIGGER: trigger,
  INTERRUPT: interrupt,
  BRAKE: cursor => {
    cursor.accept("F");
    return { kind: "brake" };
  },
  RESUME: () => ({ kind: "resume" }),
  HALT: () => ({ kind: "halt" }),
  RETURN: cursor => ({ kind: "return", value: cursor.done ? undefined : readExpression(cursor) }),
  CONTINUE: () => ({ kind: "nothing" }),
  ON_ERROR_PROCEED: () => ({ kind: "nothing" }),
  ANOUT: nothing,
  ANIN: nothing,
  IMPORT: nothing,
};

/** Why a word that KRL knows is refused here. */
const REFUSED: Readonly<Record<string, string>> = {
  CIRC_REL: "A relative arc is not understood here: write its points as positions.",
  SCIRC_REL: "A relative arc is not understood here: write its points as positions.",
  PTP_SPLINE: "A block of joint splines is not understood here.",
  TIME_BLOCK: "TIME_BLOCK gives parts of a spline their duration, which is not understood here.",
};

/**
 * One statement that moves, sets or waits; control words (IF, FOR, …) are read by `blocks.ts`.
 *
 * @param isInside  it is part of a longer line.
 */
export function readStatement(cursor: Cursor, isInside = false): Statement {
  const { line, column } = cursor.here;
  if (cursor.nextKind !== "word") throw cursor.unexpected("a statement");
  const word = cursor.next;
  const after = cursor.second;
  // A name followed by = is assigned to, even where it is also a word of the language.
  if (after === "=" || after === "[" || after === ".") return { ...assignment(cursor, isInside), line, column };
  if (word === "GLOBAL" && after === "INTERRUPT") cursor.take();
  const reader = READERS[cursor.next];
  if (reader === undefined && after !== "(") {
    throw new TextError(
      { line, column },
      "a statement of KRL",
      REFUSED[word] ?? `"${cursor.take()}" is no statement of KRL that is understood here.`,
    );
  }
  const name = cursor.name();
  const body = reader === undefined ? call(name, cursor) : reader(cursor);
  if (!isInside) cursor.expectEnd();
  return { ...body, line, column };
}

function assignment(cursor: Cursor, isInside: boolean): Body<Statement> {
  const to = readVariable(cursor);
  cursor.expect("=");
  const value = readExpression(cursor);
  if (cursor.next === "=") throw cursor.unexpected('"==" for a comparison');
  if (!isInside) cursor.expectEnd();
  return { kind: "assign", to, value };
}
