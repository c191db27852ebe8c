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
  type Rigid,
  type Six,
  type RunContext,
  type Value,
} from "../../parser/basic/index.ts";
import type { Do, Expression } from "../../parser/structured/index.ts";

/** Joint 2 leans forwards as it grows, as the maker counts. */
const LEANS_FORWARD = 1;

interface Said {
  readonly speed: Speed;
  readonly pathSpeed: Speed;
  /** The share that Ovrd leaves of every speed. */
  readonly override: number;
  readonly acceleration: number;
  readonly passes_mm: number | undefined;
  readonly base: Rigid;
}
const FIRST: Said = {
  speed: { ratio: 1 },
  pathSpeed: { ratio: 1 },
  override: 1,
  acceleration: 1,
  passes_mm: undefined,
  base: NOWHERE,
};
const JOINTS = 6;
/** How near a point is passed when Cnt says no distance [mm]. */
const UNSAID_MM = 10;
/** Places that are closer are one [mm]. */
const SAME_MM = 0.01;
const RIGHT = 4;
const ABOVE = 2;
const NONFLIP = 1;

/** Executes MELFA-BASIC statement by statement. */
export class MelfaMachine extends BasicMachine<Said> {
  protected readonly truth = 1;
  private readonly pallets = new Map<
    number,
    { readonly corners: readonly PlaceValue[]; readonly along: number; readonly across: number; readonly order: number }
  >();

  constructor(stage: RunContext) {
    super(stage, { language: "melfa-basic", leansForward: LEANS_FORWARD }, FIRST);
  }

  protected known(name: string): Value | undefined {
    switch (name) {
      case "p_curr":
        if (this.arm.isLost) return { kind: "unknown", name: "P_Curr" };
        return this.placed(this.arm.here());
      case "p_zero":
      case "p_nbase":
      case "p_ntool":
        return this.placed(NOWHERE);
      case "m_pi":
        return Math.PI;
      case "m_nspd":
      case "m_novrd":
      case "m_njovrd":
        return 100;
      default:
        return undefined;
    }
  }

  protected lineIn(expression: Expression): string | undefined {
    if (expression.kind !== "call" || expression.args[0]?.value === undefined) return undefined;
    return expression.name === "m_in"
      ? this.line(expression.args[0].value, "digital-in")
      : expression.name === "m_out"
        ? this.line(expression.args[0].value, "digital-out")
        : undefined;
  }

  protected applied(call: Extract<Expression, { kind: "call" }>): Value {
    const { name, args } = call;
    const numbers =
      name === "inv" || name === "jtop" ? [] : this.numbers(args.filter(({ name: mark }) => mark === undefined));
    const [x = 0, y = 0, z = 0, a = 0, b = 0, c = 0] = numbers;
    switch (name) {
      case "position": {
        const flag = args.find(({ name: mark }) => mark === "flag")?.value;
        const turned = { kind: "place", at: rigid([x, y, z, a, b, c]), frame: "" } as const;
        return flag === undefined ? turned : { ...turned, posture: postureOf(this.numberOf(flag)) };
      }
      case "joints":
        return { kind: "joints", deg: Array.from({ length: JOINTS }, (_, i) => numbers[i] ?? 0) };
      // Angles that are computed are in radians.
      case "setpos":
        return this.placed(rigid([x, y, z, a / DEG, b / DEG, c / DEG]));
      case "plt":
        return this.onPallet(call, x, y);
      case "setjnt":
        return { kind: "joints", deg: Array.from({ length: JOINTS }, (_, i) => (numbers[i] ?? 0) / DEG) };
      default:
        return this.converted(call, y, x);
    }
  }

  /**
   * Place n of a pallet: along its first side first; 1 goes there and back in turns, 2 always in one direction. The
   * posture is that of the first corner.
   */
  private onPallet(at: TextPlace, number: number, n: number): Value {
    const pallet = this.pallets.get(number);
    if (pallet === undefined && this.notices !== undefined) return { kind: "unknown", name: `Plt ${number}` };
    if (pallet === undefined) throw new TextError(at, "a pallet", `Pallet ${number} is not defined.`);
    const { corners, along, across, order } = pallet;
    if (!Number.isInteger(n) || n < 1 || n > along * across)
      throw new TextError(at, `a place from 1 to ${along * across}`, `Pallet ${number} has no place ${n}.`);
    const row = Math.floor((n - 1) / along);
    const i = (n - 1) % along;
    const column = order === 1 && row % 2 === 1 ? along - 1 - i : i;
    const u = along === 1 ? 0 : column / (along - 1);
    const v = across === 1 ? 0 : row / (across - 1);
    const [a, b, c, d] = corners.map(each => sixNumbers(this.inBase(each)));
    const p = [0, 1, 2].map(
      k => (1 - u) * (1 - v) * a![k]! + u * (1 - v) * b![k]! + (1 - u) * v * c![k]! + u * v * d![k]!,
    );
    const first = corners[0]!;
    return { ...this.unbound(first), at: first.at.with(3, p[0]!).with(7, p[1]!).with(11, p[2]!) };
  }

  /** `Def Plt 1, P1, P2, P3[, P4], along, across, order`. */
  private definePallet(statement: Do): void {
    const values = statement.args.map(({ value }) => (value === undefined ? undefined : this.evaluate(value)));
    const [number, along, across, order] = [values[0], ...values.slice(-3)].map(value =>
      numberIn(value ?? 0, statement),
    );
    const given = values.slice(1, -3).flatMap(value => (value === undefined ? [] : [placeIn(value, statement)]));
    const [a, b, c, d = undefined] = given;
    if (a === undefined || b === undefined || c === undefined || given.length > 4 || !(along! >= 1) || !(across! >= 1))
      throw new TextError(statement, "three or four corners and two counts", "The pallet is not understood.");
    // Without a fourth corner the pallet is a parallelogram. Order 3 goes round on an arc.
    if (order !== 1 && order !== 2)
      throw new TextError(statement, "1 or 2", `The order ${order} of a pallet is not executed here.`);
    const other = d ?? { ...c, at: moved(c.at, ...across3(a, b)) };
    this.pallets.set(number!, { corners: [a, b, c, other], along: along!, across: across!, order });
  }

  /** Places of joint angles, the other way back, and what is computed of numbers. */
  private converted(call: Extract<Expression, { kind: "call" }>, y: number, x: number): Value {
    const { name, args } = call;
    switch (name) {
      case "jtop": {
        const of = args[0]?.value;
        const joints = of === undefined ? undefined : this.evaluate(of);
        if (typeof joints !== "object" || joints.kind !== "joints")
          throw new TextError(call, "joint angles", "JtoP takes joint angles.");
        return this.placed(this.arm.atAngles(joints.deg));
      }
      case "inv": {
        const of = placeIn(args[0]?.value === undefined ? 0 : this.evaluate(args[0].value), call);
        return { ...of, at: back(of.at) };
      }
      default:
        break;
    }
    const kept = this.variable(this.keyOf(call));
    const run = FUNCTIONS[name];
    if (kept !== undefined) return kept;
    if (run === undefined && this.notices !== undefined) return { kind: "unknown", name: this.keyOf(call) };
    if (run === undefined)
      throw new TextError(call, "a function of MELFA-BASIC", `"${name}" is no function that is understood here.`);
    return run(x, y);
  }

  /**
   * `*` goes on from the left position, `/` goes back by the right one, `+` and `-` add the numbers. The posture is the
   * left one's.
   */
  protected override joined(
    sign: string,
    left: Value,
    right: Value,
    of: Extract<Expression, { kind: "binary" }>,
  ): Value | undefined {
    if (typeof left !== "object" || left.kind !== "place") return undefined;
    const other = placeIn(right, of.right);
    if (sign === "+" || sign === "-") {
      const factor = sign === "+" ? 1 : -1;
      const a = sixNumbers(left.at);
      const b = sixNumbers(other.at);
      const isTurned = b.slice(3).some(angle => Math.abs(angle) > 1e-9);
      return {
        ...this.unbound(left),
        at: isTurned
          ? rigid(a.map((value, i) => value + factor * b[i]!) as unknown as Six)
          : moved(left.at, factor * b[0], factor * b[1], factor * b[2]),
      };
    }
    if (sign !== "*" && sign !== "/") return undefined;
    const step = sign === "*" ? other.at : back(other.at);
    const variable =
      of.left.kind === "variable" && (this.places.has(of.left.name) || this.constants.has(of.left.name))
        ? of.left.name
        : undefined;
    const within =
      variable !== undefined
        ? { variable, of: left.at, at: step }
        : left.within === undefined
          ? undefined
          : { ...left.within, at: on(left.within.at, step) };
    return { ...left, at: on(left.at, step), ...(within === undefined ? {} : { within }) };
  }

  protected override component(of: Value, name: string, at: TextPlace): Value {
    if (typeof of === "object" && of.kind === "joints" && /^j[1-6]$/.test(name))
      return of.deg[Number(name[1]) - 1]! * DEG;
    const i = AXES.indexOf(name);
    if (i < 0) throw new TextError(at, AXES.join(", ").toUpperCase(), `A position has no component ${name}.`);
    const value = sixNumbers(placeIn(of, at).at)[i]!;
    return i < 3 ? value : value * DEG;
  }

  /** `P1.X = 5` changes one number of a position. */
  protected override store(to: Expression, value: Value): void {
    if (to.kind !== "component") return super.store(to, value);
    const i = AXES.indexOf(to.name);
    const of = this.unbound(placeIn(this.evaluate(to.of), to));
    const number = numberIn(value, to);
    if (i < 0)
      throw new TextError(
        to,
        AXES.join(", ").toUpperCase(),
        `The component ${to.name} of a position is not changed here.`,
      );
    super.store(to.of, {
      ...of,
      at: i < 3 ? of.at.with(4 * i + 3, number) : rigid(sixNumbers(of.at).with(i, number / DEG) as unknown as Six),
    });
  }

  protected steps(statement: Do): readonly Step[] {
    const { name, args } = statement;
    const id = (): string => this.stepId(statement);
    const [first = 0, second] =
      name === "tool" ||
      name === "base" ||
      name === "plt" ||
      name === "away" ||
      name === "m_out" ||
      name.startsWith("mv") ||
      name === "mov"
        ? []
        : this.numbers(args);
    switch (name) {
      // All motions are slowed by it.
      case "ovrd":
        this.state = { ...this.state, override: between(first, 0.01, 100, "a percentage", statement) / 100 };
        return [];
      case "jovrd":
        this.state = { ...this.state, speed: { ratio: between(first, 0.01, 100, "a percentage", statement) / 100 } };
        return [];
      case "spd":
        this.state = { ...this.state, pathSpeed: { mps: between(first, 0.01, 100_000, "a speed", statement) / 1000 } };
        return [];
      case "accel":
        this.state = {
          ...this.state,
          acceleration: Math.min(1, between(first, 0, 1000, "a percentage", statement) / 100),
        };
        return [];
      case "cnt":
        this.state = { ...this.state, passes_mm: first === 0 ? undefined : (second ?? UNSAID_MM) };
        return [];
      case "dly":
        return [{ id: id(), type: "wait", s: between(first, 0, Number.MAX_VALUE, "a time", statement) }];
      default:
        return this.action(statement);
    }
  }

  /** Grippers, lines, tools and motions. */
  private action(statement: Do): readonly Step[] {
    const { name, args } = statement;
    const id = (): string => this.stepId(statement);
    switch (name) {
      case "plt":
        this.definePallet(statement);
        return [];
      case "away":
        this.away(statement, String(this.evaluate(args[0]!.value!)));
        return [];
      case "hopen":
      case "hclose":
        return [{ id: id(), type: "gripper", closed: name === "hclose" }];
      case "m_out":
        return [this.output(statement, id())];
      case "tool": {
        const of = args[0]!.value!;
        const place = placeIn(this.evaluate(of), of);
        const isNone = of.kind === "variable" && (of.name === "p_ntool" || of.name === "p_zero");
        this.useTool(place.at, isNone ? undefined : of.kind === "variable" ? of.name : "tool");
        return [];
      }
      // Where the robot stands in the world that positions count in.
      case "base":
        this.state = { ...this.state, base: placeIn(this.evaluate(args[0]!.value!), statement).at };
        return [];
      case "mov":
        return [this.moveTo(statement, "ptp")];
      case "mvs":
        return [this.moveTo(statement, "lin")];
      case "mvr":
        return this.arc(statement);
      default:
        throw new TextError(statement, "a statement of MELFA-BASIC", `"${name}" is not understood here.`);
    }
  }

  private output({ args, line, column }: Do, id: string): Step {
    const [of, to, time] = args.map(({ value }) => value);
    const number = of?.kind === "call" ? of.args[0]?.value : undefined;
    if (number === undefined || to === undefined)
      throw new TextError({ line, column }, "M_Out(n)", "The number of the output is missing.");
    return this.set(
      this.line(number, "digital-out"),
      this.numberOf(to) !== 0,
      id,
      time === undefined ? undefined : this.numberOf(time),
    );
  }

  private where(of: Expression | undefined, at: TextPlace): Value {
    const value = of === undefined ? this.placed(this.hereFor(at)) : this.evaluate(of);
    if (
      typeof value === "object" &&
      value.kind === "place" &&
      this.state.base !== NOWHERE &&
      value.within === undefined
    )
      return { ...value, at: on(back(this.state.base), value.at) };
    if (typeof value !== "object") throw new TextError(at, "a position", "A number is no position to move to.");
    return value;
  }

  private moveTo(statement: Do, path: "ptp" | "lin"): Step {
    const [first, away] = statement.args;
    const goal = this.where(first?.value, statement);
    const isJoint = path === "ptp";
    const place = away?.value === undefined ? goal : this.beside(placeIn(goal, statement), this.numberOf(away.value));
    return this.move(statement, path, this.go(place, isJoint, true, statement), this.manner(isJoint));
  }

  /** Along the z of the hand from a position. */
  private beside(of: PlaceValue, away_mm: number): PlaceValue {
    const step = rigid([0, 0, away_mm, 0, 0, 0]);
    return {
      ...of,
      at: on(of.at, step),
      ...(of.within === undefined ? {} : { within: { ...of.within, at: on(of.within.at, step) } }),
    };
  }

  /**
   * From the first of three positions, to which the hand goes straight if it is not there, through the second to the
   * third.
   */
  private arc(statement: Do): readonly Step[] {
    const [from, via, to] = statement.args.map(({ value }) => value);
    if (from === undefined || via === undefined || to === undefined)
      throw new TextError(statement, "three positions", "Mvr takes three positions.");
    const start = placeIn(this.where(from, statement), statement);
    const here = this.hereFor(statement);
    const away = this.inBase(start);
    const steps: Step[] = [];
    if (Math.hypot(away[3]! - here[3]!, away[7]! - here[7]!, away[11]! - here[11]!) > SAME_MM)
      steps.push(
        this.move(statement, "lin", this.go(start, false, true, statement), { ...this.manner(false), blend_m: 0 }),
      );
    const middle = this.passing(this.where(via, statement), statement);
    steps.push(
      this.move(statement, "circ", this.go(this.where(to, statement), false, true, statement), {
        via: middle,
        ...this.manner(false),
      }),
    );
    return steps;
  }

  private manner(isJoint: boolean): { readonly speed: Speed; readonly blend_m: number } {
    const { speed, pathSpeed, override, acceleration, passes_mm } = this.state;
    const full = isJoint ? speed : pathSpeed;
    return {
      speed: slowed(full, override),
      ...(acceleration < 1 ? { acceleration: { ratio: acceleration } } : {}),
      blend_m: (passes_mm ?? 0) / 1000,
    };
  }
}

/** From the first corner to the second. */
const across3 = (a: PlaceValue, b: PlaceValue): [number, number, number] => [
  b.at[3]! - a.at[3]!,
  b.at[7]! - a.at[7]!,
  b.at[11]! - a.at[11]!,
];

const slowed = (speed: Speed, share: number): Speed =>
  share === 1
    ? speed
    : "mps" in speed
      ? { mps: speed.mps * share }
      : "ratio" in speed
        ? { ratio: speed.ratio * share }
        : speed;

const AXES = ["x", "y", "z", "a", "b", "c"];
const DEG = Math.PI / 180;
/** 7 is right, above, not flipped. */
const postureOf = (flag: number): Posture => ({
  front: (flag & RIGHT) !== 0,
  bent: (flag & ABOVE) !== 0,
  wrist: (flag & NONFLIP) !== 0,
});
/** Angles in radians. */
const FUNCTIONS: Readonly<Record<string, (x: number, y: number) => number>> = {
  sin: Math.sin,
  cos: Math.cos,
  tan: Math.tan,
  atn: Math.atan,
  atn2: Math.atan2,
  sqr: Math.sqrt,
  abs: Math.abs,
  int: Math.floor,
  fix: Math.trunc,
  sgn: Math.sign,
  rad: x => x * DEG,
  deg: x => x / DEG,
  min: Math.min,
  max: Math.max,
};
