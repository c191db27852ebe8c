import type { Pose, Robot, Signals, TextPlace } from "@twincell/core";
import { TextError, type DeclaredCell } from "../../parser/index.ts";
import { BlockMachine, type Argument, type Expression, type Routine } from "../../parser/structured/index.ts";
import type { Application } from "../read/application.ts";
import { ControllerArm } from "./arm.ts";
import { NOTHING, fromSix, times, type Trsf } from "./trsf.ts";
import {
  beginning,
  componentOf,
  withComponent,
  isList,
  kindOf,
  valuesOf,
  type Frame,
  type Kind,
  type Value,
} from "./values.ts";

/** A limit of the tool's speed that is none [mm/s]. */
export const NO_LIMIT = 10_000;

/** Data of a VAL 3 application: found by their names, or taken for granted where no file has them. */
export abstract class KeptData extends BlockMachine<Value> {
  readonly arm: ControllerArm;
  readonly declared: DeclaredCell;
  /** Frames that are places of a pallet that is being read. */
  readonly places = new Set<string>();
  protected readonly application: Application;
  protected readonly changing: ReadonlySet<string>;
  protected readonly signals: Signals | undefined;
  protected readonly outputs = new Map<string, boolean | number>();
  /** Motions are on their way while the program goes on. */
  protected moving = false;
  /** Programs that are to run beside the one that is carried out. */
  protected readonly tasks: {
    readonly routine: Routine;
    readonly args: readonly Argument[];
    readonly at: TextPlace;
  }[] = [];
  /** Why nobody knows where the robot is: a sentence. */
  protected lost: string | undefined;
  /** Data that something outside the program gave a value. */
  protected readonly foreign = new Set<string>();
  /** What kind of datum is asked for. */
  private wanted: Kind | undefined;

  /** @param changing  names that are given a value while the program runs. */
  constructor(
    application: Application,
    changing: ReadonlySet<string>,
    robot: Robot,
    worldFromBase: Pose<"world", "base">,
    declared: DeclaredCell,
    signals?: Signals,
  ) {
    super(application.routines);
    this.application = application;
    this.changing = changing;
    this.arm = new ControllerArm(robot, worldFromBase);
    this.declared = declared;
    this.signals = signals;
    for (const datum of application.data)
      for (const [place, value] of valuesOf(datum))
        this.globals.set(/^0(?:,0)*$/.test(place) ? datum.name : `${datum.name}[${place}]`, value);
  }

  protected override prepare(routine: Routine, names: Map<string, Value>): void {
    for (const [name, type] of this.application.locals.get(routine.name) ?? []) {
      const value = beginning(type);
      if (value !== undefined) names.set(name, value);
    }
  }

  /** Programs stand in the text under their own names, those of a library too. */
  override routine(name: string): Routine | undefined {
    const found = super.routine(name);
    if (found !== undefined || !name.includes(":")) return found;
    return super.routine(`call ${name.slice(name.indexOf(":") + 1)}`);
  }

  spelt(name: string): string {
    return name.replace(/^call /, "");
  }

  protected nameOf(expression: Expression): string | undefined {
    if (expression.kind === "variable") return expression.name;
    if (expression.kind !== "index" || expression.of.kind !== "variable") return undefined;
    const places = expression.indices.map(index => this.numberOf(index));
    return places.every(i => i === 0) ? expression.of.name : `${expression.of.name}[${places.join(",")}]`;
  }

  protected variable(name: string): Value | undefined {
    if (this.foreign.size > 0 && this.foreign.has(name)) return undefined;
    const value = this.scopes.at(-1)?.names.get(name) ?? this.globals.get(name);
    if (value !== undefined || !name.includes(":")) return value;
    return this.globals.get(name.slice(name.indexOf(":") + 1));
  }

  /** A component of a datum: `pPick.trsf.x`, `mFast.vel`, `jHome.j1`. */
  protected component(of: Expression, name: string, at: TextPlace): Value {
    const value = this.evaluate(of);
    const found = componentOf(value, name);
    if (found === undefined)
      throw new TextError(at, "a component of the datum", `There is no component "${name}" here.`);
    return found;
  }

  /** A datum that no open file has: a speed and a tool have something to take for them, everything else has not. */
  protected missing(name: string | undefined, at: TextPlace): Value {
    const say = (what: string, taken: string): void => {
      this.remark(
        `datum ${name}`,
        at,
        "the data of the application",
        `The ${what} ${name} is in no file that is open: ${taken}.`,
      );
    };
    if (this.wanted === "mdesc") {
      say("motion descriptor", "full speed without blending is taken for it");
      return { kind: "mdesc", accel: 100, vel: 100, tmax: NO_LIMIT, blend: "off", leave: 0, reach: 0 };
    }
    if (this.wanted === "tool") {
      say("tool", "the flange is taken for it");
      return { kind: "tool", trsf: NOTHING };
    }
    throw new TextError(
      at,
      "a datum that has a value",
      this.foreign.has(name ?? "")
        ? `"${name}" is what another machine or a task answers: it is not known here.`
        : `"${name ?? "this"}" has no value here.`,
    );
  }

  /** Where a point is in the world, or a transformation from where it counts. */
  protected placeOf(expression: Expression, at: TextPlace): Trsf["mm"] {
    const value = this.evaluate(expression);
    if (isList(value)) return this.trsf(expression).mm;
    const point = this.of("point", expression);
    return times(this.father(point.father, at), point.trsf).mm;
  }

  protected sizeOf(of: Expression): number {
    const name = of.kind === "variable" ? of.name : "";
    let size = this.variable(name) === undefined ? 0 : 1;
    while (this.variable(`${name}[${size}]`) !== undefined) size++;
    return size;
  }

  protected given(args: readonly Argument[], i: number, name: string, at: TextPlace): Expression {
    const found = args[i]?.value;
    if (found === undefined) throw new TextError(at, `argument ${i + 1}`, `${name} has only ${args.length} arguments.`);
    return found;
  }

  protected of<K extends Kind>(kind: K, expression: Expression): Extract<Value, { readonly kind: K }> {
    const { wanted } = this;
    this.wanted = kind;
    const value = this.evaluate(expression);
    this.wanted = wanted;
    const isKind = (each: Value): each is Extract<Value, { readonly kind: K }> => kindOf(each) === kind;
    if (!isKind(value))
      throw new TextError(
        expression,
        `a ${kind}`,
        `Something else (${kindOf(value)}) stands where a ${kind} is expected.`,
      );
    return value;
  }

  protected trsf(expression: Expression): Trsf {
    const value = this.evaluate(expression);
    if (!isList(value) || value.length !== 6)
      throw new TextError(expression, "{x,y,z,rx,ry,rz}", "This is no transformation.");
    return fromSix(value);
  }

  protected store(to: Expression, value: Value): void {
    if (to.kind === "component") {
      const changed = withComponent(this.evaluate(to.of), to.name, value);
      if (changed === undefined)
        throw new TextError(to, "a component of the datum", `"${to.name}" is no component that is given a value here.`);
      this.store(to.of, changed);
      return;
    }
    const name = this.nameOf(to);
    if (name === undefined) throw new TextError(to, "a datum", "Only a whole datum can be given a value here.");
    const names = this.scopes.at(-1)?.names;
    const holder = names?.has(name) === true ? names : this.globals;
    const before = holder.get(name);
    if (before === undefined && typeof value !== "object")
      this.remark(
        `datum ${name}`,
        to,
        "the data of the application",
        `${name} is in no file that is open: whether it is a line is not known, and no line is set.`,
      );
    if (before !== undefined && kindOf(before) !== kindOf(value))
      throw new TextError(to, `a ${kindOf(before)}`, `"${name}" cannot hold this.`);
    holder.set(name, value);
  }

  /** Whether a name is that of a line: one of the data, or one that none of the open files has. */
  protected isLine(name: string, kind: "dio" | "aio"): boolean {
    const value = this.variable(name);
    if (value !== undefined) return kindOf(value) === kind;
    this.remark(
      `datum ${name}`,
      { line: 1, column: 1 },
      "the data of the application",
      `The line ${name} is in no file that is open: it counts as a ${kind === "dio" ? "digital" : "analogue"} line of that name.`,
    );
    this.globals.set(name, { kind });
    return true;
  }

  /** Where a frame is in the world of the controller. */
  protected father(name: string, at: TextPlace, depth = 0): Trsf {
    if (name === "world") return NOTHING;
    const frame = this.globals.get(name);
    if (depth > 20 || kindOf(frame) !== "frame")
      throw new TextError(
        at,
        "a frame among the data",
        `The frame ${name} that a point counts from is not among the data.`,
      );
    const { trsf, father } = this.of("frame", { kind: "variable", name, ...at });
    return times(this.father(father, at, depth + 1), trsf);
  }

  protected chain({ trsf, father }: Frame): Trsf {
    return father === "" ? NOTHING : times(this.father(father, { line: 1, column: 1 }), trsf);
  }
}
