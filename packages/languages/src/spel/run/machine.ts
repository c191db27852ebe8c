import type { Speed, Step, TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import {
  BasicMachine,
  NOWHERE,
  back,
  between,
  moved,
  numberIn,
  on,
  placeIn,
  rigid,
  sixNumbers,
  type PlaceValue,
  type Posture,
  type Six,
  type RunContext,
  type Value,
} from "../../parser/basic/index.ts";
import type { Do, Expression } from "../../parser/structured/index.ts";

/** Joint 2 leans back as it grows, as the maker counts. */
const LEANS_FORWARD = -1;

interface Said {
  readonly speed: Speed;
  readonly pathSpeed: Speed;
}
const FIRST: Said = { speed: { ratio: 0.03 }, pathSpeed: { mps: 0.05 } };
/** The output that is taken for the gripper. */
const GRIPPER = "dogripper";
const JOINTS = 6;
/** How near a point is passed nobody says: as near as the speed needs. */
const PASSED = 1;
const POSTURES: Readonly<Record<string, Posture>> = {
  r: { front: true },
  l: { front: false },
  a: { up: true },
  b: { up: false },
  nf: { wrist: false },
  f: { wrist: true },
};
const AXES = ["x", "y", "z", "w", "v", "u"];

/** Executes SPEL+ statement by statement. */
export class SpelMachine extends BasicMachine<Said> {
  protected readonly truth = -1;
  /** Tools and locals by their numbers. */
  private readonly tools = new Map<number, { readonly name: string; readonly at: PlaceValue["at"] }>();
  private readonly locals = new Map<number, string>();

  constructor(stage: RunContext) {
    super(stage, { language: "spel", leansForward: LEANS_FORWARD }, FIRST);
  }

  protected known(name: string): Value | undefined {
    if (name === "here" || name === "curpos") return this.placed(this.arm.here());
    return name === "pi" ? Math.PI : undefined;
  }

  protected override keyOf(expression: Expression): string {
    if (expression.kind === "call" && expression.name === "p" && expression.args.length === 1)
      return `p${this.numbers(expression.args)[0]}`;
    return super.keyOf(expression);
  }

  protected lineIn(expression: Expression): string | undefined {
    if (expression.kind !== "call" || expression.args[0]?.value === undefined) return undefined;
    return expression.name === "sw"
      ? this.line(expression.args[0].value, "digital-in")
      : expression.name === "oport"
        ? this.line(expression.args[0].value, "digital-out")
        : undefined;
  }

  protected applied(call: Extract<Expression, { kind: "call" }>): Value {
    const { name } = call;
    const numbers = this.numbers(call.args);
    const axis = AXES.indexOf(name.replace(/^tl/, ""));
    if (name === "p") {
      const key = this.keyOf(call);
      const point = this.variable(key);
      if (point === undefined) throw new TextError(call, "a point that has a value", `"${key}" has no value yet.`);
      return point;
    }
    if (name === "xy") {
      const [x = 0, y = 0, z = 0, u = 0, v = 0, w = 0] = numbers;
      return this.placed(rigid([x, y, z, w, v, u]));
    }
    if (name === "ja" || name === "agltopls") {
      if (numbers.length !== JOINTS)
        throw new TextError(
          call,
          `${JOINTS} joint angles`,
          `${name.toUpperCase()} takes ${JOINTS} joint angles; ${numbers.length} are given.`,
        );
      return { kind: "joints", deg: numbers };
    }
    if (axis >= 0) {
      const by: Six = [0, 0, 0, 0, 0, 0];
      return { kind: "shift", by: by.with(axis, numbers[0] ?? 0) as unknown as Six, isOwn: name.startsWith("tl") };
    }
    const run = FUNCTIONS[name];
    if (run === undefined)
      throw new TextError(call, "a function of SPEL+", `"${name}" is no function that is understood here.`);
    return run(
      call.args.map(({ value }) => (value === undefined ? 0 : this.evaluate(value))),
      call,
    );
  }

  protected override joined(
    sign: string,
    left: Value,
    right: Value,
    of: Extract<Expression, { kind: "binary" }>,
  ): Value | undefined {
    if (typeof left !== "object" || left.kind !== "place") return undefined;
    if (sign === "/" && typeof right === "string") return this.asked(left, right, of.right);
    if ((sign !== "+" && sign !== "-") || typeof right !== "object" || right.kind !== "shift") return undefined;
    const { by, isOwn } = right;
    const factor = sign === "+" ? 1 : -1;
    if (!isOwn) {
      const six = sixNumbers(left.at).map((value, i) => value + factor * by[i]!) as unknown as Six;
      return this.placed(
        by.some((value, i) => i > 2 && value !== 0)
          ? rigid(six)
          : moved(left.at, factor * by[0], factor * by[1], factor * by[2]),
        left.frame,
      );
    }
    const step = sign === "+" ? rigid(by) : back(rigid(by));
    const variable = of.left.kind === "variable" && this.places.has(of.left.name) ? of.left.name : undefined;
    const within =
      variable !== undefined
        ? { variable, of: this.inBase(left), at: step }
        : left.within === undefined
          ? undefined
          : { ...left.within, at: on(left.within.at, step) };
    return { ...left, at: on(left.at, step), ...(within === undefined ? {} : { within }) };
  }

  /** `/1` counts in a local, `/L` and its like ask for a posture. */
  private asked(place: PlaceValue, what: string, at: TextPlace): PlaceValue {
    if (Object.hasOwn(POSTURES, what)) return { ...place, posture: { ...place.posture, ...POSTURES[what]! } };
    if (what === "0") return { ...place, frame: "" };
    const frame = this.locals.get(Number(what));
    if (frame === undefined)
      throw new TextError(
        at,
        "a local that was defined, or L, R, A, B, F or NF",
        `"/${what}" is neither a local that was defined nor a posture.`,
      );
    return { ...place, frame };
  }

  protected steps(statement: Do): readonly Step[] {
    const { name, args } = statement;
    const id = (): string => this.stepId(statement);
    const given = (i: number, what: string): Expression => this.given(statement, i, what);
    switch (name) {
      case "speed":
        this.state = {
          ...this.state,
          speed: { ratio: between(this.numberOf(given(0, "a percentage")), 1, 100, "a percentage", statement) / 100 },
        };
        return [];
      case "speeds":
        this.state = {
          ...this.state,
          pathSpeed: { mps: between(this.numberOf(given(0, "a speed")), 0.1, 2000, "a speed", statement) / 1000 },
        };
        return [];
      case "tlset":
      case "local":
        this.define(name, given(0, "a number"), placeIn(this.evaluate(given(1, "a place")), statement));
        return [];
      case "tool":
        this.choose(given(0, "the number of a tool"));
        return [];
      case "on":
      case "off":
        return [this.switched(name === "on", given(0, "an output"), args[1]?.value, id())];
      case "wait":
        return [
          {
            id: id(),
            type: "wait",
            s: between(this.numberOf(given(0, "a time")), 0, Number.MAX_VALUE, "a time", statement),
          },
        ];
      case "print":
        return [
          {
            id: id(),
            type: "message",
            text: args
              .map(({ value }) => {
                const said = value === undefined ? "" : this.evaluate(value);
                return typeof said === "object" ? "" : String(said);
              })
              .join(" "),
          },
        ];
      case "go":
      case "tgo":
        return [this.moveTo(statement, "ptp")];
      case "move":
      case "tmove":
        return [this.moveTo(statement, "lin")];
      case "arc3":
        return [this.moveTo(statement, "circ")];
      default:
        throw new TextError(statement, "a statement of SPEL+", `"${name}" is not understood here.`);
    }
  }

  private define(what: "tlset" | "local", number: Expression, place: PlaceValue): void {
    const n = between(this.numberOf(number), 1, 15, "a number", number);
    const name = number.kind === "variable" ? number.name : `${what === "local" ? "local" : "tool"}${n}`;
    if (what === "tlset") {
      this.tools.set(n, { name, at: place.at });
      return;
    }
    this.locals.set(n, name);
    this.frameAt(name, this.inBase(place));
  }

  private choose(number: Expression): void {
    const n = this.numberOf(number);
    const tool = n === 0 ? undefined : this.tools.get(n);
    if (n !== 0 && tool === undefined)
      throw new TextError(number, "a tool that was defined by TLSet", `The tool ${n} is not defined in the text.`);
    this.useTool(tool?.at ?? NOWHERE, tool?.name);
  }

  private switched(to: boolean, output: Expression, time: Expression | undefined, id: string): Step {
    if (output.kind === "variable" && output.name === GRIPPER) return { id, type: "gripper", closed: to };
    return this.set(this.line(output, "digital-out"), to, id, time === undefined ? undefined : this.numberOf(time));
  }

  private moveTo(statement: Do, path: "ptp" | "lin" | "circ"): Step {
    const { name, args } = statement;
    const isJoint = path === "ptp";
    const passes = args.some(({ name: mark }) => mark === "cp");
    const goals = args.flatMap(({ value }) => (value === undefined ? [] : [this.evaluate(value)]));
    const last = goals.at(-1)!;
    const goal =
      name === "tgo" || name === "tmove" ? this.placed(on(this.arm.here(), placeIn(last, statement).at)) : last;
    const via = path === "circ" ? this.passing(goals[0]!, statement) : undefined;
    return this.move(statement, path, this.go(goal, isJoint, isJoint, statement), {
      ...(via === undefined ? {} : { via }),
      speed: isJoint ? this.state.speed : this.state.pathSpeed,
      blend_m: 0,
      ...(passes ? { blend_ratio: PASSED } : {}),
    });
  }
}

const DEG = Math.PI / 180;
const coordinate =
  (i: number) =>
  (values: readonly Value[], at: TextPlace): number =>
    sixNumbers(placeIn(values[0] ?? 0, at).at)[i]!;
const ofNumber =
  (f: (x: number) => number) =>
  (values: readonly Value[], at: TextPlace): number =>
    f(numberIn(values[0] ?? 0, at));
/** Functions of numbers and places; angles in radians, but for DegToRad and its like. */
const FUNCTIONS: Readonly<Record<string, (values: readonly Value[], at: TextPlace) => Value>> = {
  cx: coordinate(0),
  cy: coordinate(1),
  cz: coordinate(2),
  cw: coordinate(3),
  cv: coordinate(4),
  cu: coordinate(5),
  sin: ofNumber(Math.sin),
  cos: ofNumber(Math.cos),
  tan: ofNumber(Math.tan),
  sqr: ofNumber(Math.sqrt),
  abs: ofNumber(Math.abs),
  int: ofNumber(Math.floor),
  fix: ofNumber(Math.trunc),
  degtorad: ofNumber(x => x * DEG),
  radtodeg: ofNumber(x => x / DEG),
};
