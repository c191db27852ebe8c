import {
  compose,
  flangePose,
  identity,
  inverse,
  type Branch,
  type MoveStep,
  type Pose,
  type Robot,
  type SignalLine,
  type Signals,
  type Speed,
  type Target,
  type TextPlace,
} from "@twincell/core";
import { NotGiven, TextError, type Notices, type ShownAxes } from "../../parser/index.ts";
import type { ConfigWord, Variable } from "../read/syntax.ts";
import {
  NULL_TRANSFORM,
  components,
  fromPose,
  fromTrans,
  inverted,
  times,
  toPose,
  type Transform,
} from "./transform.ts";
import type { Memory, Precision, Value } from "./values.ts";

const INCH_MM = 25.4;

/** What the words of the controller mean in the words of a person, one for each part of the branch. */
const CONFIG: Readonly<Record<Exclude<ConfigWord, "FLIP" | "NOFLIP">, Partial<Branch>>> = {
  RIGHTY: { shoulder: "front" },
  LEFTY: { shoulder: "back" },
  ABOVE: { elbow: "up" },
  BELOW: { elbow: "down" },
};

/** Tools by the name under which the steps know them. */
export type Tools = Record<string, Pose<"flange", "tcp">>;
export type Lines = Record<string, SignalLine>;
/** What the text was found to refer to; grows while it runs. */
export interface DeclaredContext {
  readonly tools: Tools;
  readonly lines: Lines;
}

/** Outputs count from 1, inputs from 1001, soft signals, which are both, from 2001. */
const FIRST_INPUT = 1001;
const FIRST_SOFT = 2001;

/** The controller while a program runs: variables, signals, tool, speed, and where the arm has been sent. */
export class ControllerState implements Memory {
  readonly joints: number;
  continuous = true;
  private readonly robot: Robot;
  private readonly axes: ShownAxes;
  private readonly worldFromVendor: Pose<"frame", "vendor-world">;
  private readonly vendorFromBase: Pose<"vendor-world", "base">;
  private readonly variables = new Map<string, Value>();
  private readonly signals: Signals;
  private readonly written = new Map<string, boolean>();
  /** The lines that were met, by the names of the steps; shared with whoever executes the text. */
  private readonly lines: Lines;
  /** Called when a line is read: what it says may change from outside. */
  onRead: () => void = () => undefined;
  private acceleration: MoveStep["acceleration"];
  private readonly tools: Tools;
  private tool: { readonly name: string; readonly flangeFromTcp: Transform } = {
    name: "flange",
    flangeFromTcp: NULL_TRANSFORM,
  };
  private base: Transform = NULL_TRANSFORM;
  private speed: Speed = { ratio: 1 };
  private onceSpeed: Speed | undefined;
  private duration: Speed | undefined;
  private onceDuration: Speed | undefined;
  private branch: Partial<Branch> = {};
  /** Where the flange is sent, in the vendor's world. */
  private flange: Transform;
  /** The joints there; unknown after a move to a transformation, whose joints the controller chooses. */
  private joints_deg: readonly number[] | undefined;
  /** Where the arm is hangs on what only the controller knows. */
  isLost = false;
  /** Takes what only the controller knows; without, such a thing is refused. */
  private readonly notices: Notices | undefined;

  constructor(
    robot: Robot,
    axes: ShownAxes,
    worldFromBase: Pose<"world", "base">,
    { tools, lines }: DeclaredContext,
    signals: Signals,
    notices?: Notices,
  ) {
    this.notices = notices;
    this.robot = robot;
    this.lines = lines;
    this.signals = signals;
    this.joints = robot.arm.joints.length;
    this.axes = axes;
    this.tools = tools;
    // The world is a frame like any other to a program.
    this.worldFromVendor = compose(compose(identity<"frame", "world">(), worldFromBase), robot.baseFromVendorWorld);
    this.vendorFromBase = inverse(robot.baseFromVendorWorld);
    this.joints_deg = axes.degrees(robot.home_rad);
    this.flange = this.flangeAt(this.joints_deg);
  }

  isMissing(key: string): boolean {
    return this.notices !== undefined && this.variables.get(key) === undefined;
  }

  inPlaceOf({ name, ...at }: Variable, key: string): Value | undefined {
    if (this.notices === undefined) return undefined;
    const isText = name.startsWith("$");
    this.notices.notGiven(at, `${key} is in none of the files: it is taken as ${isText ? "an empty text" : "0"}.`);
    return isText ? "" : 0;
  }

  named(variable: string): boolean {
    this.onRead();
    this.lines[variable] ??= { kind: "digital-in" };
    const value = this.written.get(variable) ?? this.signals.read(variable);
    return typeof value === "number" ? value !== 0 : value;
  }

  /** An output that goes by the name of the variable that holds its number in the controller. */
  namedOutput(variable: string): string {
    this.lines[variable] = { kind: "digital-out" };
    return variable;
  }

  /** Takes a variable, or an array of that name, away: the answer is what it held. */
  take(name: string): ReadonlyMap<string, Value> {
    const held = new Map<string, Value>();
    for (const [key, value] of this.variables) if (key === name || key.startsWith(`${name}[`)) held.set(key, value);
    for (const key of held.keys()) this.variables.delete(key);
    return held;
  }

  read(key: string): Value | undefined {
    return this.variables.get(key);
  }
  write(key: string, value: Value): void {
    this.variables.set(key, value);
  }
  signal(number: number, name: string | undefined): boolean {
    this.onRead();
    const line = this.line(number, name);
    const value = this.written.get(line) ?? this.signals.read(line);
    return typeof value === "number" ? value !== 0 : value;
  }

  /** The steps write the line when they are executed; the text, which is ahead of them, reads what it wrote. */
  wrote(line: string, value: boolean): void {
    this.written.set(line, value);
  }

  /** The name under which the steps know a line: that of its variable, or its number. */
  line(number: number, name: string | undefined): string {
    const isInput = number >= FIRST_INPUT && number < FIRST_SOFT;
    const called = name ?? `${isInput ? "in" : "out"}_${number}`;
    this.lines[called] ??= { kind: isInput ? "digital-in" : "digital-out", address: number };
    return called;
  }

  accelerate(percent: number): void {
    const ratio = Math.min(1, percent / 100);
    this.acceleration = ratio < 1 ? { ratio } : undefined;
  }

  here(at: TextPlace): Transform {
    if (this.isLost) throw new NotGiven(at, "a place", "Where the robot then is is in none of the files");
    return times(times(inverted(this.base), this.flange), this.tool.flangeFromTcp);
  }
  reached(precision: Precision): Transform {
    return times(times(inverted(this.base), this.flangeAt(precision.joints_deg)), this.tool.flangeFromTcp);
  }

  /** The six numbers of a location, as DECOMPOSE writes them. */
  decomposed(location: Transform | Precision): readonly number[] {
    return location.kind === "precision" ? location.joints_deg : components(location);
  }

  setTool(flangeFromTcp: Transform, wantedName: string | undefined): void {
    const isFlange = components(flangeFromTcp).every(x => x === 0);
    this.tool = { name: isFlange ? "flange" : this.toolName(toPose(flangeFromTcp), wantedName), flangeFromTcp };
  }

  setBase(x_mm: number, y_mm: number, z_mm: number, turn_deg: number): void {
    this.base = fromTrans(x_mm, y_mm, z_mm, turn_deg, 0, 0);
  }

  configure(word: ConfigWord): void {
    const part =
      word === "FLIP" || word === "NOFLIP" ? this.axes.wristAt(this.robot, word === "FLIP" ? -1 : 1) : CONFIG[word];
    this.branch = { ...this.branch, ...part };
  }

  setSpeed(value: number, unit: "percent" | "mmps" | "ips", always: boolean, at: TextPlace): void {
    if (!(value > 0)) throw new TextError(at, "a speed above 0", `The speed is ${value}.`);
    const speed: Speed =
      unit === "percent"
        ? { ratio: Math.min(1, value / 100) }
        : { mps: (value * (unit === "ips" ? INCH_MM : 1)) / 1000 };
    if (always) {
      this.speed = speed;
      this.onceSpeed = undefined;
    } else this.onceSpeed = speed;
  }

  /** The least time of a motion [s]; 0 takes the demand back. */
  setDuration(time_s: number, always: boolean): void {
    const duration = time_s > 0 ? { time_s } : undefined;
    if (always) {
      this.duration = duration;
      this.onceDuration = undefined;
    } else this.onceDuration = duration;
  }

  /** The neutral step of a motion to that location; from now on the arm is there. */
  moveTo(id: string, location: Transform | Precision, straight: boolean): MoveStep {
    this.isLost = false;
    const target = location.kind === "precision" ? this.toJoints(location) : this.toTransform(location);
    const speed = this.onceDuration ?? this.duration ?? this.onceSpeed ?? this.speed;
    this.onceDuration = this.onceSpeed = undefined;
    return {
      id,
      type: "move",
      path: straight ? "lin" : "ptp",
      target,
      speed,
      ...(this.acceleration === undefined ? {} : { acceleration: this.acceleration }),
      blend_m: 0,
    };
  }

  /** DRIVE: one joint, counted from 1, by an angle. */
  driven(joint: number, change_deg: number, at: TextPlace): Precision {
    if (!(joint >= 1 && joint <= this.joints))
      throw new TextError(at, `a joint from 1 to ${this.joints}`, `The robot has no joint ${joint}.`);
    if (this.joints_deg === undefined || this.isLost)
      throw new NotGiven(
        at,
        "a motion to a precision point before it",
        "DRIVE turns a joint from where it is, and after a motion to a transformation the joint values are the controller's choice.",
      );
    return {
      kind: "precision",
      joints_deg: this.joints_deg.map((value, i) => (i === joint - 1 ? value + change_deg : value)),
    };
  }

  private toJoints({ joints_deg }: Precision): Target {
    this.joints_deg = joints_deg;
    this.flange = this.flangeAt(joints_deg);
    // The joints say which posture it is; a later transformation is reached from there.
    this.branch = {};
    return { q: this.radiansOf(joints_deg), tool: this.tool.name };
  }

  private toTransform(location: Transform): Target {
    const vendorFromTcp = times(this.base, location);
    this.joints_deg = undefined;
    this.flange = times(vendorFromTcp, inverted(this.tool.flangeFromTcp));
    const pose = compose(this.worldFromVendor, toPose<"vendor-world", "tcp">(vendorFromTcp));
    const { shoulder, elbow, wrist } = this.branch;
    const branch =
      shoulder !== undefined && elbow !== undefined && wrist !== undefined
        ? { branch: { shoulder, elbow, wrist } }
        : {};
    return { pose, frame: "world", tool: this.tool.name, ...branch };
  }

  private flangeAt(joints_deg: readonly number[]): Transform {
    return fromPose(compose(this.vendorFromBase, flangePose(this.robot.arm, this.radiansOf(joints_deg))));
  }

  private radiansOf(joints_deg: readonly number[]): number[] {
    return this.axes.radians(joints_deg);
  }

  /** A tool met before keeps its name; two tools never share one. */
  private toolName(flangeFromTcp: Pose<"flange", "tcp">, wanted: string | undefined): string {
    const text = JSON.stringify(flangeFromTcp);
    const stem = wanted === undefined || wanted === "flange" ? "tool" : wanted;
    for (let i = 1; ; i++) {
      const name = i === 1 ? stem : `${stem}_${i}`;
      const known = this.tools[name];
      if (known === undefined) this.tools[name] = flangeFromTcp;
      if (known === undefined || JSON.stringify(known) === text) return name;
    }
  }
}
