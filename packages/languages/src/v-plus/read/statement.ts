import { TextError } from "../../parser/index.ts";
import type { Cursor } from "./cursor.ts";
import { checkName, readExpression, readVariable } from "./expression.ts";
import type { ConfigWord, Expression, Statement, Variable } from "./syntax.ts";

type Body<S> = S extends unknown ? Omit<S, "line" | "column"> : never;
type Reader = (cursor: Cursor, word: string) => Body<Statement>;

const expressions = (cursor: Cursor): Expression[] => {
  const list = [readExpression(cursor)];
  while (cursor.accept(",")) list.push(readExpression(cursor));
  return list;
};
const optional = (cursor: Cursor): Expression | undefined =>
  cursor.done || cursor.next === "," ? undefined : readExpression(cursor);

const config: Reader = (cursor, word) => ({
  kind: "config",
  word: word as ConfigWord,
  always: cursor.accept("ALWAYS"),
});
const gripper: Reader = (_, word) => ({
  kind: "gripper",
  closed: word.startsWith("CLOSE"),
  immediate: word.endsWith("I"),
});
const without: Reader = cursor => {
  while (!cursor.done) cursor.take();
  return { kind: "nothing" };
};
/** `FINE 50 ALWAYS` and its like: a tolerance that does not move the target. */
const accuracy: Reader = cursor => {
  if (!cursor.done && cursor.next !== "ALWAYS") readExpression(cursor);
  cursor.accept("ALWAYS");
  return { kind: "nothing" };
};

/** One text is a message; anything else is put together on the terminal as the program runs. */
const message: Reader = (cursor, word) => {
  if (cursor.nextKind !== "text" || cursor.second !== "") return without(cursor, word);
  return { kind: "type", text: cursor.take().slice(1, -1) };
};

function speed(cursor: Cursor): Body<Statement> {
  const value = readExpression(cursor);
  if (cursor.accept(",")) readExpression(cursor);
  const unit = cursor.accept("MMPS") ? "mmps" : cursor.accept("IPS") ? "ips" : "percent";
  // The monitor speed is the operator's hand on the whole robot, like the override here: no property of the program.
  if (cursor.accept("MONITOR")) return { kind: "nothing" };
  return { kind: "speed", value, unit, always: cursor.accept("ALWAYS") };
}

/** `AUTO REAL i, p[]`, `LOCAL LOC place`. */
function own(cursor: Cursor, word: string): Body<Statement> {
  if (["REAL", "DOUBLE", "LOC", "STRING"].includes(cursor.next) && cursor.second !== "," && cursor.second !== "")
    cursor.take();
  const names: string[] = [];
  while (!cursor.done) {
    if (cursor.nextKind === "word") names.push(cursor.take().toLowerCase());
    else cursor.take();
  }
  return { kind: "own", names, keeps: word === "LOCAL" };
}

function switches(cursor: Cursor, word: string): Body<Statement> {
  const name = cursor.next;
  without(cursor, word);
  return name === "CP" ? { kind: "path", continuous: word === "ENABLE" } : { kind: "nothing" };
}

function call(cursor: Cursor): Body<Statement> {
  const at = cursor.here;
  if (cursor.nextKind !== "word") throw cursor.unexpected("the name of a program");
  const program = cursor.take().toLowerCase();
  checkName(program, at);
  const args: Expression[] = [];
  if (cursor.accept("(")) {
    if (cursor.next !== ")")
      do {
        const { line, column } = cursor.here;
        const isValue = cursor.next === "(";
        const arg = readExpression(cursor);
        // In brackets of its own a variable stays what it is.
        args.push(isValue && arg.kind === "variable" ? { kind: "compound", parts: [arg], line, column } : arg);
      } while (cursor.accept(","));
    cursor.expect(")");
  }
  return { kind: "call", program, args };
}

function waiting(cursor: Cursor, word: string): Body<Statement> {
  if (word === "WAIT") {
    const condition = optional(cursor);
    return condition === undefined ? { kind: "wait" } : { kind: "wait", condition };
  }
  if (!cursor.done && cursor.next !== ",") readExpression(cursor);
  if (!cursor.accept(",")) throw cursor.unexpected('"," and a time, since an event alone comes from another task');
  return { kind: "delay", time: readExpression(cursor) };
}

const READERS: Readonly<Record<string, Reader>> = {
  SET: cursor => {
    const to = readVariable(cursor);
    cursor.expect("=");
    return { kind: "set", to, value: readExpression(cursor) };
  },
  HERE: cursor => ({ kind: "here", to: readVariable(cursor) }),
  DECOMPOSE: cursor => {
    const to = readVariable(cursor);
    if (to.indices.length === 0)
      throw new TextError(to, "an array element such as a[0]", `DECOMPOSE fills an array; "${to.name}" has no index.`);
    cursor.expect("=");
    return { kind: "decompose", to, location: readExpression(cursor) };
  },
  MOVE: cursor => ({ kind: "move", straight: false, location: readExpression(cursor) }),
  MOVES: cursor => ({ kind: "move", straight: true, location: readExpression(cursor) }),
  MOVET: cursor => handMove(cursor, false),
  MOVEST: cursor => handMove(cursor, true),
  APPRO: cursor => approach(cursor, false),
  APPROS: cursor => approach(cursor, true),
  DEPART: cursor => ({ kind: "depart", straight: false, distance: readExpression(cursor) }),
  DEPARTS: cursor => ({ kind: "depart", straight: true, distance: readExpression(cursor) }),
  DRIVE: cursor => {
    const joint = readExpression(cursor);
    cursor.expect(",");
    const change = readExpression(cursor);
    cursor.expect(",");
    return { kind: "drive", joint, change, speed: readExpression(cursor) };
  },
  SPEED: speed,
  DURATION: cursor => {
    const value = readExpression(cursor);
    return { kind: "duration", value, always: cursor.accept("ALWAYS") };
  },
  TOOL: cursor => {
    const location = optional(cursor);
    return location === undefined ? { kind: "tool" } : { kind: "tool", location };
  },
  BASE: cursor => {
    const values: (Expression | undefined)[] = [];
    if (!cursor.done)
      do values.push(optional(cursor));
      while (cursor.accept(","));
    return { kind: "base", values };
  },
  LEFTY: config,
  RIGHTY: config,
  ABOVE: config,
  BELOW: config,
  FLIP: config,
  NOFLIP: config,
  BREAK: () => ({ kind: "break" }),
  CPON: cursor => {
    cursor.accept("ALWAYS");
    return { kind: "path", continuous: true };
  },
  CPOFF: cursor => {
    cursor.accept("ALWAYS");
    return { kind: "path", continuous: false };
  },
  ENABLE: switches,
  DISABLE: switches,
  DELAY: cursor => ({ kind: "delay", time: readExpression(cursor) }),
  WAIT: waiting,
  "WAIT.EVENT": waiting,
  OPEN: gripper,
  OPENI: gripper,
  CLOSE: gripper,
  CLOSEI: gripper,
  RELAX: gripper,
  RELAXI: gripper,
  SIGNAL: cursor => ({ kind: "signal", signals: expressions(cursor) }),
  CALL: call,
  RETURN: () => ({ kind: "return" }),
  STOP: () => ({ kind: "stop" }),
  HALT: () => ({ kind: "stop" }),
  FINE: accuracy,
  COARSE: accuracy,
  NULL: accuracy,
  NONULL: accuracy,
  OVERLAP: accuracy,
  NOOVERLAP: accuracy,
  SINGLE: accuracy,
  MULTIPLE: accuracy,
  ACCEL: cursor => ({ kind: "accel", percent: expressions(cursor)[0]! }),
  PAUSE: () => ({ kind: "nothing" }),
  TYPE: message,
  PARAMETER: without,
  ATTACH: without,
  DETACH: without,
  GLOBAL: without,
  LOCAL: own,
  AUTO: own,
  TIMER: without,
};

function handMove(cursor: Cursor, straight: boolean): Body<Statement> {
  const location = readExpression(cursor);
  cursor.expect(",");
  return { kind: "move", straight, location, hand: readExpression(cursor) };
}

function approach(cursor: Cursor, straight: boolean): Body<Statement> {
  const location = readExpression(cursor);
  cursor.expect(",");
  return { kind: "approach", straight, location, distance: readExpression(cursor) };
}

/** Statements that speak with people, files, other tasks and reactions, and do not move the arm by themselves. */
const KEPT: ReadonlySet<string> = new Set(
  "READ WRITE PROMPT REACT REACTI REACTE IGNORE EXECUTE ABORT IOPUT DEFIO FOPEN FOPENR FOPENW FOPENA FOPEND FCLOSE FSET FCMND MC MCS SETEVENT CLEAR.EVENT RELEASE LOCK RESET BITS GETEVENT SELECT PRIME PROCEED CYCLE.END KILL STATUS PANEL VSTATE".split(
    " ",
  ),
);

/** The variables of a statement that is left out lose their values where it would have read them from outside. */
function kept(cursor: Cursor, word: string): Body<Statement> {
  const forgets: Variable[] = [];
  const gives = /^(?:READ|PROMPT|GETEVENT)$/.test(word);
  while (!cursor.done) {
    if (gives && cursor.nextKind === "word") forgets.push(readVariable(cursor));
    else cursor.take();
  }
  return { kind: "kept", word, forgets };
}

/** Why a word that V+ or a neighbouring language knows is refused here. */
const REFUSED: Readonly<Record<string, string>> = {
  ELSEIF: "V+ has no ELSEIF: nest IF inside ELSE.",
  POINT: "POINT belongs to Kawasaki AS; V+ uses SET.",
  REACTI: "Reactions to signals come from outside and cannot be executed here.",
  REACT: "Reactions to signals come from outside and cannot be executed here.",
};

/** One statement that moves, sets or waits; control words (IF, FOR, …) are read by `blocks.ts`. */
export function readStatement(cursor: Cursor, asText = false): Statement {
  const { line, column } = cursor.here;
  const word = cursor.next;
  if (cursor.nextKind !== "word") throw cursor.unexpected("a statement");
  const reader = asText && KEPT.has(word) ? kept : READERS[word];
  // A name followed by = is assigned to, even where it is also a word of the language.
  if (cursor.second === "=" || cursor.second === "[") {
    if (reader === undefined || cursor.second === "=") return { ...assignment(cursor), line, column };
  }
  if (reader === undefined) {
    throw new TextError(
      { line, column },
      "a statement of V+",
      REFUSED[word] ?? `"${cursor.take()}" is no statement of V+ that is understood here.`,
    );
  }
  cursor.take();
  const body = reader(cursor, word);
  cursor.expectEnd();
  return { ...body, line, column };
}

function assignment(cursor: Cursor): Body<Statement> {
  const to = readVariable(cursor);
  cursor.expect("=");
  const value = readExpression(cursor);
  if (cursor.next === "=") throw cursor.unexpected('"==" for a comparison');
  cursor.expectEnd();
  return { kind: "assign", to, value };
}
