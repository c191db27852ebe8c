import type { MoveStep, Speed, Step, TextPlace } from "@twincell/core";
import { NotGiven, TextError, missingProgram } from "../../parser/index.ts";
import {
  BasicMachine,
  NOWHERE,
  back,
  between,
  isUnknown,
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
  /** Bits of memory, and the condition of Till. */
  private readonly memory = new Map<number, boolean>();
  private till: Expression | undefined;
  private limZ: number | undefined;
  private readonly pallets = new Map<
    number,
    { readonly corners: readonly Six[]; readonly columns: number; readonly rows: number }
  >();

  constructor(stage: RunContext) {
    super(stage, { language: "spel", leansForward: LEANS_FORWARD }, FIRST);
  }

  protected known(name: string): Value | undefined {
    if ((name === "here" || name === "curpos") && this.arm.isLost) return { kind: "unknown", name: "Here" };
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

  /** Bits of memory and groups of lines, where a text is executed as it is. */
  private asText(name: string, first: Expression | undefined): Value | undefined {
    if (this.notices === undefined || first === undefined) return undefined;
    if (/^in(?:w|bcd|real)?$/.test(name)) return this.group(`${name.replace(/^in/, "In")} ${this.numberOf(first)}`);
    if (name === "memsw") return this.memory.get(this.numberOf(first)) === true ? this.truth : 0;
    return undefined;
  }

  /** An element of an array; one that was not given a value is what the array was declared with. */
  private element(call: Extract<Expression, { kind: "call" }>): Value | undefined {
    if (this.notices === undefined || call.name === "p" || call.args.length === 0) return undefined;
    if (Object.hasOwn(FUNCTIONS, call.name) || call.name === "xy" || call.name === "ja") return undefined;
    const whole = this.variable(call.name);
    return whole === undefined ? undefined : (this.variable(this.keyOf(call)) ?? whole);
  }

  /** Pallet(1, 5) or Pallet(1, 2, 3): a place between the corners, first along the first side. */
  private onPallet(call: Extract<Expression, { kind: "call" }>): Value | undefined {
    if (this.notices === undefined || call.name !== "pallet") return undefined;
    const [number = 0, first = 0, second] = this.numbers(call.args);
    const pallet = this.pallets.get(number);
    if (pallet === undefined) return { kind: "unknown", name: `Pallet ${number}` };
    const { corners, columns, rows } = pallet;
    const column = second === undefined ? (first - 1) % columns : first - 1;
    const row = second === undefined ? Math.floor((first - 1) / columns) : second - 1;
    if (!(column >= 0 && column < columns && row >= 0 && row < rows))
      throw new TextError(call, "a place of the pallet", `The pallet ${number} has no place ${first}.`);
    const [a, b, c, d = b!.map((value, i) => value + c![i]! - a![i]!)] = corners;
    const u = columns === 1 ? 0 : column / (columns - 1);
    const v = rows === 1 ? 0 : row / (rows - 1);
    const six = a!.map(
      (value, i) => (1 - u) * (1 - v) * value + u * (1 - v) * b![i]! + (1 - u) * v * c![i]! + u * v * d[i]!,
    );
    return this.placed(rigid(six as unknown as Six));
  }

  /** Pallet 1, P1, P2, P3[, P4], columns, rows. */
  private definePallet(statement: Do): void {
    const values = statement.args.map(({ value }) => (value === undefined ? 0 : this.evaluate(value)));
    const places = values.slice(1, -2);
    const numbers = [values[0], values.at(-2), values.at(-1)].map(value => numberIn(value ?? 0, statement));
    const [number, columns, rows] = numbers;
    if (places.length < 3 || places.length > 4 || !(columns! >= 1) || !(rows! >= 1))
      throw new TextError(statement, "a number, three or four points and two counts", "The pallet is not understood.");
    const corners = places.map(value => sixNumbers(this.inBase(placeIn(value, statement))));
    this.pallets.set(number!, { corners, columns: columns!, rows: rows! });
  }

  protected applied(call: Extract<Expression, { kind: "call" }>): Value {
    const { name } = call;
    const special = this.asText(name, call.args[0]?.value) ?? this.element(call) ?? this.onPallet(call);
    if (special !== undefined) return special;
    const numbers = this.numbers(call.args);
    const axis = AXES.indexOf(name.replace(/^tl/, ""));
    if (name === "p") {
      const key = this.keyOf(call);
      const point = this.variable(key);
      if (point === undefined && this.notices !== undefined) return { kind: "unknown", name: key };
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
    return this.shiftOrFunction(call, numbers, axis);
  }

  /** A shift along an axis, or a function. */
  private shiftOrFunction(
    call: Extract<Expression, { kind: "call" }>,
    numbers: readonly number[],
    axis: number,
  ): Value {
    const { name } = call;
    if (axis >= 0) {
      const by: Six = [0, 0, 0, 0, 0, 0];
      return { kind: "shift", by: by.with(axis, numbers[0] ?? 0) as unknown as Six, isOwn: name.startsWith("tl") };
    }
    const run = FUNCTIONS[name];
    if (run === undefined && this.notices !== undefined) return { kind: "unknown", name: `${name}()` };
    if (run === undefined)
      throw new TextError(call, "a function of SPEL+", `"${name}" is no function that is understood here.`);
    const values = call.args.map(({ value }) => (value === undefined ? 0 : this.evaluate(value)));
    return values.find(isUnknown) ?? run(values, call);
  }

  protected override joined(
    sign: string,
    left: Value,
    right: Value,
    of: Extract<Expression, { kind: "binary" }>,
  ): Value | undefined {
    if (typeof left !== "object" || left.kind !== "place") return undefined;
    if (sign === "/" && typeof right === "string") return this.asked(left, right, of.right);
    if (sign === "/" && typeof right === "number") return this.asked(left, String(right), of.right);
    // P1 :Z(-10): the point with another coordinate.
    if (sign === ":" && typeof right === "object" && right.kind === "shift" && !right.isOwn) {
      const axis = of.right.kind === "call" ? AXES.indexOf(of.right.name) : -1;
      if (axis < 0) return undefined;
      return this.placed(rigid(sixNumbers(left.at).with(axis, right.by[axis]!) as unknown as Six), left.frame);
    }
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
    return this.inOwnAxes(sign, left, of, by);
  }

  /** A place that is shifted along its own axes. */
  private inOwnAxes(
    sign: string,
    left: PlaceValue,
    of: Extract<Expression, { kind: "binary" }>,
    by: Six,
  ): Value | undefined {
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
    if (frame === undefined && this.notices !== undefined && /^[0-9]+$/.test(what)) {
      this.notices.notGiven(
        at,
        `The local ${what} is defined in none of the files: it is taken to be no different from the base.`,
      );
      return { ...place, frame: "" };
    }
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
      case "out":
        return [this.setGroup(given(0, "a port"), this.numberOf(given(1, "a number")), id())];
      case "pallet":
        this.definePallet(statement);
        return [];
      case "bgo":
      case "bmove":
        return [this.shifted(statement)];
      default:
        return this.motions(statement);
    }
  }

  /** Motions, and what is kept for them. */
  private motions(statement: Do): readonly Step[] {
    const { name, args } = statement;
    const given = (i: number, what: string): Expression => this.given(statement, i, what);
    switch (name) {
      case "memon":
      case "memoff":
        this.memory.set(this.numberOf(given(0, "the number of a bit")), name === "memon");
        return [];
      case "limz":
        this.limZ = this.numberOf(given(0, "a height"));
        return [];
      case "till":
        this.till = args[0]?.value;
        return [];
      case "xqt":
        this.away(statement, "the task that is started beside");
        return [];
      case "home":
      case "pulse":
        throw new NotGiven(
          statement,
          "a place",
          `${name === "home" ? "HomeSet" : "What a pulse is"} is in none of the files`,
        );
      case "jump":
        return this.jump(statement);
      case "jump3":
      case "jump3cp":
        return this.gate(statement);
      case "arc":
        return [this.level(statement)];
      case "go":
      case "tgo":
        return [this.moveTo(statement, "ptp")];
      case "move":
      case "tmove":
        return [this.moveTo(statement, "lin")];
      case "arc3":
        return [this.moveTo(statement, "circ")];
      default:
        // What is no statement is the name of a function.
        if (this.notices !== undefined) throw missingProgram(statement, name);
        throw new TextError(statement, "a statement of SPEL+", `"${name}" is not understood here.`);
    }
  }

  /** Out 2, 5: eight outputs as a number. */
  private setGroup(port: Expression, to: number, id: string): Step {
    const signal = `Out ${this.numberOf(port)}`;
    this.declared.signals[signal] ??= { kind: "analogue-out" };
    return { id, type: "set", signal, to };
  }

  /**
   * Jump: straight up to LimZ, across, and straight down. Its arch, where the three overlap, is the controller's; an
   * arm whose LimZ is not said goes straight to the goal, which is said.
   */
  private jump(statement: Do): readonly Step[] {
    const { args } = statement;
    const goal = this.evaluate(this.given(statement, 0, "a point"));
    const said = args.find(({ name }) => name === "limz")?.value;
    const top = said === undefined ? this.limZ : this.numberOf(said);
    const place = placeIn(goal, statement);
    const { speed } = this.state;
    const to = (at: PlaceValue, path: "ptp" | "lin", last: boolean): Step => {
      const target = this.go(at, path === "ptp", path === "ptp", statement);
      const more = {
        speed: path === "ptp" ? speed : this.state.pathSpeed,
        blend_m: 0,
        ...this.until(last ? args : []),
      };
      return this.move(statement, path, target, more);
    };
    if (top === undefined || this.arm.isLost) {
      this.notices!.add(
        statement,
        "a height of LimZ",
        `Line ${statement.line}: Jump lifts the hand to LimZ, which is not said: the motion goes straight to its goal.`,
      );
      return [to(place, "ptp", true)];
    }
    this.notices!.add(
      statement,
      "a motion without an arch",
      `Line ${statement.line}: Jump is executed as up, across and down; its arch is not.`,
    );
    const raised = (from: Rigid): PlaceValue => {
      const six = sixNumbers(from);
      return this.placed(moved(from, 0, 0, top - six[2]));
    };
    const start = this.arm.here();
    const end = this.inBase(place);
    const steps: Step[] = [];
    if (sixNumbers(start)[2] < top) steps.push(to(raised(start), "lin", false));
    if (sixNumbers(end)[2] < top) steps.push(to(raised(end), "lin", false));
    return [...steps, to(place, steps.length === 0 ? "ptp" : "lin", true)];
  }

  /** BMove XY(…): from where the robot stands, along the axes of the base. */
  private shifted(statement: Do): Step {
    if (this.arm.isLost) throw new NotGiven(statement, "a place", "Where the robot stands before it is not known");
    const by = sixNumbers(placeIn(this.evaluate(this.given(statement, 0, "a step")), statement).at);
    if (by.slice(3).some(angle => Math.abs(angle) > 1e-9))
      throw new TextError(
        statement,
        "a step that does not turn",
        "A step in the base that turns is not executed here.",
      );
    const isJoint = statement.name === "bgo";
    const goal = this.placed(moved(this.arm.here(), by[0], by[1], by[2]));
    return this.move(statement, isJoint ? "ptp" : "lin", this.go(goal, isJoint, isJoint, statement), {
      speed: isJoint ? this.state.speed : this.state.pathSpeed,
      blend_m: 0,
    });
  }

  /** Jump3 away, before, goal: three motions, the middle one free. */
  private gate(statement: Do): readonly Step[] {
    const goals = statement.args.flatMap(({ name, value }) =>
      value === undefined || name !== undefined ? [] : [this.evaluate(value)],
    );
    return goals.map((goal, i) => {
      const path = i === 1 && statement.name === "jump3" ? "ptp" : "lin";
      const target = this.go(goal, path === "ptp", path === "ptp", statement);
      return this.move(statement, path, target, {
        speed: path === "ptp" ? this.state.speed : this.state.pathSpeed,
        blend_m: 0,
        ...this.until(i === 2 ? statement.args : []),
      });
    });
  }

  /** Arc stays at its height: an arc whose three points are as high as each other is one. */
  private level(statement: Do): Step {
    const goals = statement.args.flatMap(({ name, value }) =>
      value === undefined || name !== undefined ? [] : [this.inBase(placeIn(this.evaluate(value), statement))],
    );
    if (this.arm.isLost) throw new NotGiven(statement, "a place", "Where the robot stands before it is not known");
    const heights = [this.arm.here(), ...goals].map(at => sixNumbers(at)[2]);
    if (Math.max(...heights) - Math.min(...heights) > 0.1)
      throw new TextError(
        statement,
        "three points of one height",
        "Arc stays level: its points are not as high as each other.",
      );
    return this.moveTo(statement, "circ");
  }

  /** Till: the motion ends when its line says so. */
  private until(args: Do["args"]): { readonly until?: MoveStep["until"] & {} } {
    const till = args.find(({ name }) => name === "till");
    if (till === undefined) return {};
    const of = till.value ?? this.till;
    const when = of === undefined ? undefined : this.condition(of);
    if (when !== undefined) return { until: { when, missing: "continue" } };
    this.notices?.add(
      till,
      "a condition of one line",
      `Line ${till.line}: the motion has no condition of one line: it goes to its end.`,
    );
    return {};
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
    if (n !== 0 && tool === undefined && this.notices !== undefined) {
      this.notices.notGiven(
        number,
        `The tool ${n} is defined in none of the files: it is taken to be no different from the flange.`,
      );
      return this.useTool(NOWHERE, undefined);
    }
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
    const goals = args.flatMap(({ name: mark, value }) =>
      value === undefined || mark !== undefined ? [] : [this.evaluate(value)],
    );
    if (this.arm.isLost && (path === "circ" || name === "tgo" || name === "tmove"))
      throw new NotGiven(statement, "a place", "Where the robot stands before it is not known");
    const last = goals.at(-1)!;
    const goal =
      name === "tgo" || name === "tmove" ? this.placed(on(this.arm.here(), placeIn(last, statement).at)) : last;
    const via = path === "circ" ? this.passing(goals[0]!, statement) : undefined;
    return this.move(statement, path, this.go(goal, isJoint, isJoint, statement), {
      ...(via === undefined ? {} : { via }),
      speed: isJoint ? this.state.speed : this.state.pathSpeed,
      blend_m: 0,
      ...(passes ? { blend_ratio: PASSED } : {}),
      ...this.until(args),
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
