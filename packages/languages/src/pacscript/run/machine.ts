import type { MoveStep, Speed, Step, TextPlace } from "@twincell/core";
import { TextError, missingProgram } from "../../parser/index.ts";
import {
  BasicMachine,
  NOWHERE,
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
  type RunContext,
  type Value,
} from "../../parser/basic/index.ts";
import type { Do, Expression } from "../../parser/structured/index.ts";

/** Joint 2 leans forwards as it grows, as the maker counts. */
const LEANS_FORWARD = 1;

interface Said {
  readonly speed: Speed;
  readonly acceleration: number;
  readonly work: string;
}
const FIRST: Said = { speed: { ratio: 1 }, acceleration: 1, work: "" };
/** The output that is taken for the gripper. */
const GRIPPER = "dogripper";
const JOINTS = 6;
/** How near @P passes nobody says: as near as the speed needs. */
const PASSED = 1;
const LEFTY = 1;
const BELOW = 2;
const NONFLIP = 4;
const PATHS: Readonly<Record<string, MoveStep["path"]>> = { p: "ptp", l: "lin", c: "circ" };

/** Executes PacScript statement by statement. */
export class PacMachine extends BasicMachine<Said> {
  protected readonly truth = -1;
  private readonly tools = new Map<number, { readonly name: string; readonly at: Rigid }>();
  private readonly works = new Map<number, string>();

  constructor(stage: RunContext) {
    super(stage, { language: "pacscript", leansForward: LEANS_FORWARD }, FIRST);
  }

  protected known(name: string): Value | undefined {
    if (name === "curpos") return this.arm.isLost ? { kind: "unknown", name: "CurPos" } : this.placed(this.arm.here());
    return name === "pi" ? Math.PI : undefined;
  }

  /** Inputs and outputs are counted in one row: a line that was written to is an output. */
  protected lineIn(expression: Expression): string | undefined {
    if (
      expression.kind !== "index" ||
      expression.of.kind !== "variable" ||
      expression.of.name !== "io" ||
      expression.indices.length !== 1
    )
      return undefined;
    const number = expression.indices[0]!;
    const address = this.numberOf(number);
    const written = Object.values(this.declared.signals).some(
      line => line.address === address && line.kind === "digital-out",
    );
    return this.line(number, written ? "digital-out" : "digital-in");
  }

  protected applied(call: Extract<Expression, { kind: "call" }>): Value {
    const { name, args } = call;
    if (name === "devh" || name === "dev") return this.beside(name, call);
    const values = args.map(({ value }) => (value === undefined ? 0 : this.evaluate(value)));
    return this.made(call, values) ?? this.computed(call, values);
  }

  /** Places, joint angles and vectors made of numbers. */
  private made({ name, args }: Extract<Expression, { kind: "call" }>, values: readonly Value[]): Value | undefined {
    const numbers = (): number[] =>
      values.map((value, i) => (isUnknown(value) ? this.numberOf(args[i]!.value!) : numberIn(value, args[i]!)));
    switch (name) {
      case "p": {
        const [x = 0, y = 0, z = 0, a = 0, b = 0, c = 0, fig = -1] = numbers();
        return {
          kind: "place",
          at: rigid([x, y, z, a, b, c]),
          frame: this.state.work,
          ...(fig < 0 ? {} : { posture: postureOf(fig) }),
        };
      }
      case "j":
        return { kind: "joints", deg: Array.from({ length: JOINTS }, (_, i) => numbers()[i] ?? 0) };
      case "v": {
        const [x = 0, y = 0, z = 0] = numbers();
        return { kind: "shift", by: [x, y, z, 0, 0, 0], isOwn: false };
      }
      default:
        return undefined;
    }
  }

  private computed(call: Extract<Expression, { kind: "call" }>, values: readonly Value[]): Value {
    const { name } = call;
    const run = FUNCTIONS[name];
    if (run === undefined && this.notices !== undefined) return { kind: "unknown", name: `${name}()` };
    if (run === undefined)
      throw new TextError(call, "a function of PacScript", `"${name}" is no function that is understood here.`);
    return values.find(isUnknown) ?? run(values, call);
  }

  /** Dev goes along the axes of the work, DevH along those of the place itself. The posture is that of the place. */
  private beside(name: "dev" | "devh", { args, line, column }: Extract<Expression, { kind: "call" }>): Value {
    const at = { line, column };
    const [of, by] = args.map(({ value }) => value);
    if (of === undefined || by === undefined)
      throw new TextError(at, "a place and a step", `${name} takes a place and a step.`);
    const place = placeIn(this.evaluate(of), of);
    const step = placeIn(this.evaluate(by), by).at;
    if (name === "dev") return { ...this.unbound(place), at: moved(place.at, step[3]!, step[7]!, step[11]!) };
    const variable = of.kind === "variable" && this.places.has(of.name) ? of.name : undefined;
    return {
      ...this.unbound(place),
      at: on(place.at, step),
      ...(variable === undefined ? {} : { within: { variable, of: this.inBase(place), at: step } }),
    };
  }

  protected steps(statement: Do): readonly Step[] {
    const { name, args } = statement;
    const id = (): string => this.stepId(statement);
    const given = (i: number, what: string): Expression => this.given(statement, i, what);
    switch (name) {
      case "speed":
        this.state = {
          ...this.state,
          speed: { ratio: between(this.numberOf(given(0, "a percentage")), 0.1, 100, "a percentage", statement) / 100 },
        };
        return [];
      case "accel":
        this.state = {
          ...this.state,
          acceleration: between(this.numberOf(given(0, "a percentage")), 0.0001, 100, "a percentage", statement) / 100,
        };
        return [];
      case "tool":
      case "work":
        this.define(name, given(0, "a number"), placeIn(this.evaluate(given(1, "a place")), statement));
        return [];
      case "changetool":
      case "changework":
        this.choose(name, given(0, "a number"));
        return [];
      case "delay":
        return [
          {
            id: id(),
            type: "wait",
            s: between(this.numberOf(given(0, "a time")), 0, Number.MAX_VALUE, "a time", statement) / 1000,
          },
        ];
      case "set":
      case "reset":
        return [this.switched(name === "set", given(0, "an output"), args[1]?.value, id())];
      case "io":
        return [this.switched(this.numberOf(given(1, "On or Off")) !== 0, given(0, "an output"), undefined, id())];
      case "payload":
        return [this.load(statement, id())];
      default:
        return this.said(statement);
    }
  }

  /** Messages, motions, and what is in none of the files. */
  private said(statement: Do): readonly Step[] {
    const { name, args } = statement;
    switch (name) {
      case "print":
      case "printdbg":
      case "printmsg":
        return [
          {
            id: this.stepId(statement),
            type: "message",
            text: args
              .map(({ value }) => {
                const said = value === undefined ? "" : this.evaluate(value);
                return typeof said === "object" ? "" : String(said);
              })
              .join(""),
          },
        ];
      case "move":
      case "approach":
      case "depart":
      case "draw":
        return [this.motion(statement)];
      case "away":
        this.away(statement, String(this.evaluate(this.given(statement, 0, "a statement"))));
        return [];
      default:
        if (this.notices !== undefined) throw missingProgram(statement, name);
        throw new TextError(statement, "a statement of PacScript", `"${name}" is not understood here.`);
    }
  }

  private define(what: "tool" | "work", number: Expression, place: PlaceValue): void {
    const n = between(this.numberOf(number), 1, 63, "a number", number);
    const name = number.kind === "variable" ? number.name : `${what}${n}`;
    if (what === "tool") {
      this.tools.set(n, { name, at: place.at });
      return;
    }
    this.works.set(n, name);
    // A work counts from the base, whatever work is in use.
    this.frameAt(name, place.at);
  }

  private choose(what: "changetool" | "changework", number: Expression): void {
    const n = this.numberOf(number);
    const tool = this.tools.get(n);
    const work = this.works.get(n);
    const isHeld = n !== 0 && (what === "changetool" ? tool : work) === undefined;
    if (isHeld && this.notices !== undefined) {
      const taken = what === "changetool" ? "the flange" : "the base of the robot";
      const called = what === "changetool" ? "tool" : "work";
      this.notices.notGiven(number, `The ${called} ${n} is in none of the files: it is taken to be ${taken}.`);
      if (what === "changetool") this.useTool(NOWHERE, undefined);
      else this.state = { ...this.state, work: "" };
      return;
    }
    if (isHeld) throw new TextError(number, "a number that was defined", `Number ${n} is not defined in the text.`);
    if (what === "changework") this.state = { ...this.state, work: n === 0 ? "" : work! };
    else this.useTool(tool?.at ?? NOWHERE, n === 0 ? undefined : tool!.name);
  }

  private switched(to: boolean, output: Expression, time_ms: Expression | undefined, id: string): Step {
    const number =
      output.kind === "index" && output.of.kind === "variable" && output.of.name === "io"
        ? output.indices[0]!
        : undefined;
    if (number === undefined) throw new TextError(output, "IO[n]", "Only a line has a state that can be set.");
    if (number.kind === "variable" && number.name === GRIPPER) return { id, type: "gripper", closed: to };
    return this.set(
      this.line(number, "digital-out"),
      to,
      id,
      time_ms === undefined ? undefined : this.numberOf(time_ms) / 1000,
    );
  }

  /** Grams, millimetres, kg·cm². */
  private load({ args }: Do, id: string): Step {
    const [mass = 0, centre, inertia] = args.map(({ value }) => (value === undefined ? 0 : this.evaluate(value)));
    const triple = (of: Value | undefined): readonly [number, number, number] =>
      typeof of === "object" && of.kind === "shift" ? [of.by[0], of.by[1], of.by[2]] : [0, 0, 0];
    const [x, y, z] = triple(centre);
    const [ixx, iyy, izz] = triple(inertia);
    return {
      id,
      type: "payload",
      mass_kg: numberIn(mass, args[0]!) / 1000,
      center_m: [x / 1000, y / 1000, z / 1000],
      ...(inertia === undefined ? {} : { inertia_kgm2: [ixx / KG_CM2, iyy / KG_CM2, izz / KG_CM2, 0, 0, 0] }),
    };
  }

  private motion(statement: Do): Step {
    const { name, args } = statement;
    const [way, ...goals] = args.filter(({ name: mark }) => mark === undefined).map(({ value }) => value!);
    const path = way?.kind === "text" ? PATHS[way.value] : undefined;
    if (path === undefined) throw new TextError(statement, "P, L or C", "Motions of this sort are not executed here.");
    const option = (mark: string): number | undefined => {
      const value = args.find(each => each.name === mark)?.value;
      return value === undefined ? undefined : this.numberOf(value);
    };
    const pass = option("pass") ?? 0;
    const percent = option("speed");
    const mps = option("mps");
    const acceleration = option("accel");
    const isJoint = path === "ptp";
    const target = this.go(this.goal(name, goals, statement), isJoint, isJoint, statement);
    const via = path === "circ" ? this.passing(this.here(goals[0]!), statement) : undefined;
    const ratio = acceleration === undefined ? this.state.acceleration : acceleration / 100;
    return this.move(statement, path, target, {
      ...(via === undefined ? {} : { via }),
      speed: mps !== undefined ? { mps } : percent !== undefined ? { ratio: percent / 100 } : this.state.speed,
      ...(ratio < 1 ? { acceleration: { ratio } } : {}),
      blend_m: pass > 0 ? pass / 1000 : 0,
      ...(pass < 0 ? { blend_ratio: PASSED } : {}),
    });
  }

  /** What an expression holds, in the work that is in use. */
  private here(of: Expression): Value {
    const value = this.evaluate(of);
    return typeof value === "object" && value.kind === "place" && value.within === undefined
      ? { ...value, frame: this.state.work }
      : value;
  }

  private goal(name: string, goals: readonly Expression[], at: TextPlace): Value {
    if (name === "move") return this.here(goals.at(-1)!);
    if (name === "approach") {
      const place = placeIn(this.here(goals[0]!), at);
      return { ...this.unbound(place), at: on(place.at, rigid([0, 0, -this.numberOf(goals[1]!), 0, 0, 0])) };
    }
    const from = this.hereFor(at);
    if (name === "depart") return this.placed(on(from, rigid([0, 0, -this.numberOf(goals[0]!), 0, 0, 0])));
    const by = this.evaluate(goals[0]!);
    if (typeof by !== "object" || by.kind !== "shift")
      throw new TextError(goals[0]!, "V(x, y, z)", "Draw goes along a vector.");
    // Along the axes of the work.
    const frame = this.frames.get(this.state.work) ?? NOWHERE;
    const turned = on(frame.with(3, 0).with(7, 0).with(11, 0), rigid(by.by));
    return this.placed(moved(from, turned[3]!, turned[7]!, turned[11]!));
  }
}

const KG_CM2 = 10_000;
const DEG = Math.PI / 180;
/** 1 lefty, 2 below, 4 not flipped. */
const postureOf = (fig: number): Posture => ({
  front: (fig & LEFTY) !== 0,
  up: (fig & BELOW) === 0,
  wrist: (fig & NONFLIP) !== 0,
});
const coordinate =
  (i: number) =>
  (values: readonly Value[], at: TextPlace): number =>
    sixNumbers(placeIn(values[0] ?? 0, at).at)[i]!;
const ofNumber =
  (f: (x: number) => number) =>
  (values: readonly Value[], at: TextPlace): number =>
    f(numberIn(values[0] ?? 0, at));
/** Functions of numbers and places; angles in degrees. */
const FUNCTIONS: Readonly<Record<string, (values: readonly Value[], at: TextPlace) => Value>> = {
  posx: coordinate(0),
  posy: coordinate(1),
  posz: coordinate(2),
  posrx: coordinate(3),
  posry: coordinate(4),
  posrz: coordinate(5),
  sin: ofNumber(x => Math.sin(x * DEG)),
  cos: ofNumber(x => Math.cos(x * DEG)),
  tan: ofNumber(x => Math.tan(x * DEG)),
  sqr: ofNumber(Math.sqrt),
  abs: ofNumber(Math.abs),
  int: ofNumber(Math.floor),
  raddeg: ofNumber(x => x / DEG),
  degrad: ofNumber(x => x * DEG),
};
