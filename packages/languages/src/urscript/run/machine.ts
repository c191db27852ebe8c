import {
  type Executed,
  type MoveStep,
  type Pose,
  type Robot,
  type Signals,
  type Speed,
  type Step,
  type Target,
  type TextPlace,
} from "@twincell/core";
import { TextError, missingProgram, nameIn, rememberMap, type DeclaredCell, times } from "../../parser/index.ts";
import {
  BlockMachine,
  changedNames,
  type Block,
  type Do,
  type Expression,
  type Flow,
  type Statement,
  type WaitUntil,
} from "../../parser/structured/index.ts";
import type { Source } from "../read/grammar.ts";
import { SILENT } from "../read/silent.ts";
import { ControllerArm } from "./arm.ts";
import { matrixOf, toPose } from "./frame.ts";
import { FUNCTIONS, itemOf, withItem } from "./functions.ts";
import { Arguments } from "./arguments.ts";
import { conditionOf, routeOf, holds, lineAt } from "./lines.ts";
import { asNumber, asNumbers, asPose, asTruth, binary, kindOf, poseOf, type PoseValue, type Value } from "./values.ts";

/** The controller counts joints as the robot's own file does: no sign, zero or coupling is ever set there. */
export function speaksUrScript({ vendorSection }: Robot): boolean {
  if (vendorSection?.languages.includes("urscript") !== true) return false;
  const { axes, couplings = [] } = vendorSection;
  return axes.every(({ sign, zero_deg }) => sign > 0 && zero_deg === 0) && couplings.length === 0;
}
/** What the controller takes where a move says nothing [rad/s, m/s]. */
const DEFAULT_RAD_S = 1.05;
const DEFAULT_MPS = 0.25;
/** Functions whose answer comes from another machine or a sensor: what they say is in no text. */
const OUTSIDE =
  /^(?:socket_|rpc_factory$|read_(?:input|output|port)_|modbus_get_|get_tcp_force$|force$|get_joint_torques$|get_tool_accelerometer|get_tool_current$|get_controller_temp$|get_robot_mode$|get_actual_tcp_speed$|get_target_tcp_speed$)|\./;
const THREADED = "is followed in real time by the controller's other tasks and cannot be written as steps.";
const REFUSED: Readonly<Record<string, string>> = Object.fromEntries(
  [
    "servoj",
    "servoc",
    "servol",
    "speedj",
    "speedl",
    "force_mode",
    "freedrive_mode",
    "conveyor_pulse_decode",
    "track_conveyor_linear",
    "track_conveyor_circular",
  ].map(name => [name, `${name} ${THREADED}`]),
);

/** A value that another machine gives. Never leaves an assignment; anything else that needs it is refused. */
class OutsideValue extends TextError {}

/** Executes URScript statement by statement. */
export class Machine extends BlockMachine<Value> {
  readonly arm: ControllerArm;
  readonly declared: DeclaredCell;
  /** Speed at which the slowest joint turns, so that all can [rad/s]. */
  private readonly full_rad_s: number;
  private readonly constants: ReadonlySet<string>;
  /** Names that some statement of the text gives a value. */
  private readonly assigned: ReadonlySet<string>;
  private readonly outputs = new Map<string, boolean | number>();
  private readonly signals: Signals | undefined;
  /** Variables whose value another machine gave, and how. */
  private readonly outside = new Map<string, string>();
  private tool = "flange";
  /** What the program that is started wants to be given, if anything. */
  private readonly isAsking: string | undefined;
  /** Why nobody knows where the robot is: a sentence. */
  private lost: string | undefined;
  /** Whether the tool was set where the program is now; joint angles alone do not ask for one. */
  private hasTool = false;
  /** Variables whose pose is a frame although it changes: the places of a pallet that is being read. */
  readonly places = new Set<string>();

  /** @param constants  variables that get their value once: a pose in one of them is a frame of the program. */
  constructor(
    source: Source,
    constants: ReadonlySet<string>,
    robot: Robot,
    worldFromBase: Pose<"world", "base">,
    declared: DeclaredCell,
    signals?: Signals,
  ) {
    super(source.routines);
    this.arm = new ControllerArm(robot, worldFromBase);
    this.full_rad_s = robot.arm.joints.reduce((least, { limits }) => Math.min(least, limits.speed_rad_s), Infinity);
    this.declared = declared;
    this.constants = constants;
    this.assigned = changedNames([source.main, ...[...source.routines.values()].map(({ body }) => body)]);
    const asked = source.parameters.filter(({ value }) => value === undefined);
    this.isAsking = asked.length > 0 ? asked.map(({ name }) => name).join(", ") : undefined;
    for (const { name, value } of source.parameters)
      if (value !== undefined) this.globals.set(name, this.evaluate(value));
    this.signals = signals;
  }

  /** The program; one that wants arguments is not started by itself. */
  *start(main: Block): Generator<Executed, Flow> {
    if (this.isAsking === undefined) return yield* this.block(main);
    this.remark(
      "arguments",
      main[0] ?? { line: 1, column: 1 },
      "the program that calls this one",
      `The program wants to be given ${this.isAsking}: it is not run by itself. Open it with the program that calls it.`,
    );
    return "next";
  }

  /** A name that the text gives no value: the program around this file does. */
  private isOfAnother(name: string): boolean {
    return this.variable(name) === undefined && !this.assigned.has(name) && !this.outside.has(name);
  }

  /** Such a name where a condition stands is an input that somebody sets by hand. */
  private asInput(expression: Expression): boolean | undefined {
    if (expression.kind !== "variable" || !this.isOfAnother(expression.name)) return undefined;
    const { name } = expression;
    this.declared.signals[name] ??= { kind: "digital-in" };
    this.remark(
      `input ${name}`,
      expression,
      "the program around this file",
      `"${name}" gets its value in no file that is open: it counts as an input, off until it is given by hand.`,
    );
    return this.signals?.read(name) === true;
  }

  /** A point that no open file gives: nobody can go there. */
  private leaveOut(statement: Do): boolean {
    const goal =
      statement.args.find(({ name }) => name === "q" || name === "pose") ??
      statement.args[statement.name === "movec" ? 1 : 0];
    const value = goal?.value;
    if (value?.kind !== "variable" || !this.isOfAnother(value.name)) return false;
    this.remark(
      `point ${value.name}`,
      statement,
      "the program around this file",
      `The motion to ${value.name} is left out: no file that is open gives the point. The robot goes on to the next point from where it is.`,
    );
    this.lost = "The robot was to be at a point that no open file gives.";
    return true;
  }

  // --- values -----------------------------------------------------------------------------------------------------

  variable(name: string): Value | undefined {
    const own = this.scopes.at(-1)?.names.get(name) ?? this.globals.get(name);
    return own ?? this.scopes.findLast(({ names }) => names.has(name))?.names.get(name);
  }

  evaluate(expression: Expression): Value {
    switch (expression.kind) {
      case "number":
      case "truth":
      case "text":
        return expression.value;
      case "variable": {
        const value = this.variable(expression.name);
        if (value === undefined) {
          const how = this.outside.get(expression.name);
          if (how !== undefined) throw new OutsideValue(expression, "a value that stands in the text", how);
          throw new TextError(expression, "a variable that has a value", `"${expression.name}" has no value yet.`);
        }
        return value;
      }
      case "list": {
        const items = expression.items.map(item => this.evaluate(item));
        return expression.tag === "p"
          ? poseOf(
              items.map(item => asNumber(item, expression)),
              expression,
            )
          : { kind: "list", items };
      }
      case "index":
        return expression.indices.reduce<Value>(
          (value, index) => itemOf(value, this.numberOf(index), index),
          this.evaluate(expression.of),
        );
      case "component":
        throw new TextError(expression, "an index", "URScript has no components of that name.");
      case "unary":
        return expression.sign === "not" ? !this.isTrue(expression.of) : -this.numberOf(expression.of);
      case "binary": {
        const { sign } = expression;
        const isTruth = expression.right.kind === "truth" || sign === "and" || sign === "or";
        const left = (isTruth ? this.asInput(expression.left) : undefined) ?? this.evaluate(expression.left);
        if (sign === "and" && left === false) return false;
        return sign === "or" && left === true ? true : binary(sign, left, this.evaluate(expression.right), expression);
      }
      case "call":
        return this.function(expression);
    }
  }

  isTrue(expression: Expression): boolean {
    return this.asInput(expression) ?? asTruth(this.evaluate(expression), expression);
  }
  numberOf(expression: Expression): number {
    return asNumber(this.evaluate(expression), expression);
  }
  fromNumber(value: number): Value {
    return value;
  }

  /** A variable that another machine fills has no value here; whoever needs it is refused. */
  override *statement(statement: Statement): Generator<Executed, Flow> {
    try {
      return yield* super.statement(statement);
    } catch (cause) {
      if (!(cause instanceof OutsideValue) || statement.kind !== "assign") throw cause;
      const { to } = statement;
      const name =
        to.kind === "variable" ? to.name : to.kind === "index" && to.of.kind === "variable" ? to.of.name : "";
      if (name === "") throw cause;
      this.globals.delete(name);
      for (const { names } of this.scopes) names.delete(name);
      this.outside.set(name, cause.fault.sentence);
      yield { line: statement.line };
      return "next";
    }
  }

  protected store(to: Expression, value: Value, global: boolean): void {
    if (to.kind === "index") {
      const path = to.indices.map(index => this.numberOf(index));
      if (to.of.kind !== "variable" || path.length !== 1)
        throw new TextError(to, "a variable with one index", "Only an item of a variable can be given a value.");
      return this.store(to.of, withItem(this.evaluate(to.of), path[0]!, value, to), global);
    }
    if (to.kind !== "variable") throw new TextError(to, "a variable", "Only a variable can be given a value.");
    const own = this.scopes.at(-1)?.names;
    // A parameter is the routine's own, whatever else has its name.
    if (!global && own?.has(to.name) === true) own.set(to.name, value);
    else if (global || this.globals.has(to.name) || own === undefined) this.globals.set(to.name, value);
    else (this.scopes.findLast(({ names }) => names.has(to.name))?.names ?? own).set(to.name, value);
  }

  private function(expression: Extract<Expression, { kind: "call" }>): Value {
    const { name, args: given } = expression;
    const routine = this.routine(name);
    if (routine !== undefined) return this.answer(routine, given, expression);
    const args = new Arguments(name, given, expression, each => this.evaluate(each));
    switch (name) {
      case "get_inverse_kin":
        return this.inverseKinematics(args);
      case "get_forward_kin": {
        const joints = args.optional(0, "q");
        const tcp = args.optional(1, "tcp");
        const q = joints === undefined ? this.jointsNow(expression) : asNumbers(joints, 6, expression);
        return this.arm.six(
          tcp === undefined ? this.arm.tipAt(q) : times(this.arm.flangeAt(q), matrixOf(asPose(tcp, expression).six)),
        );
      }
      case "get_actual_tcp_pose":
      case "get_target_tcp_pose":
        if (this.lost !== undefined)
          throw new TextError(expression, "a position that is known", `${this.lost} Where it is now is not known.`);
        return this.arm.six(this.arm.tip());
      case "get_tcp_offset":
      case "get_target_tcp_offset":
        return this.arm.six(this.arm.tcp);
      case "get_actual_joint_positions":
      case "get_target_joint_positions":
        return { kind: "list", items: [...this.jointsNow(expression)] };
      case "is_steady":
        return true;
      default:
        break;
    }
    const line = this.lineOf(expression);
    if (line !== undefined) return this.read(line);
    if (OUTSIDE.test(name))
      throw new OutsideValue(
        expression,
        "a value that stands in the text",
        `What ${name} answers in line ${expression.line} is not in the text.`,
      );
    const known = Object.hasOwn(FUNCTIONS, name) ? FUNCTIONS[name] : undefined;
    if (known === undefined)
      throw new TextError(expression, "a function of URScript", `"${name}" is no function that is understood here.`);
    const [least, most, run] = known;
    args.count(least, most);
    const values = args.all();
    const value = run(values, expression);
    const frame = name === "pose_trans" ? given[0]?.value : undefined;
    const inner = values[1];
    if (
      frame?.kind === "variable" &&
      typeof value === "object" &&
      value.kind === "pose" &&
      typeof inner === "object" &&
      inner.kind === "pose"
    ) {
      return { ...value, inFrame: { frame: frame.name, of: asPose(values[0]!, expression).six, six: inner.six } };
    }
    return value;
  }

  private inverseKinematics(args: Arguments): Value {
    const pose = asPose(args.required(0, "x"), args.at);
    const near = args.optional(1, "qnear");
    const from = near === undefined ? this.jointsNow(args.at) : asNumbers(near, 6, args.at);
    const joints = this.arm.solve(pose, from);
    // Angles that cannot be worked out here can still be moved to: the robot reaches the pose from that posture.
    return { kind: "list", items: joints === undefined ? [] : [...joints], solves: { pose, near: from } };
  }

  private jointsNow(at: TextPlace): readonly number[] {
    const { joints } = this.arm;
    if (this.lost !== undefined)
      throw new TextError(at, "a position that is known", `${this.lost} Where it is now is not known.`);
    if (joints === undefined)
      throw new TextError(
        at,
        "a joint move before it",
        "The joint angles are the controller's choice here, and are not known.",
      );
    return joints;
  }

  // --- lines ------------------------------------------------------------------------------------------------------

  private lineOf({ name, args }: Extract<Expression, { kind: "call" }>): string | undefined {
    const route = name.startsWith("get_") ? routeOf(name) : undefined;
    const number = args[0]?.value;
    if (route === undefined || number === undefined) return undefined;
    return lineAt(
      route,
      this.numberOf(number),
      number.kind === "variable" ? number.name : undefined,
      this.declared.signals,
      number,
    );
  }

  private read(line: string): boolean | number {
    const isDigital = this.declared.signals[line]!.kind.startsWith("digital");
    const value = this.outputs.get(line) ?? this.signals?.read(line);
    return isDigital ? value === true || (typeof value === "number" && value !== 0) : Number(value ?? 0);
  }

  condition(expression: Expression): ReturnType<typeof conditionOf> {
    return conditionOf(
      expression,
      call => this.lineOf(call),
      of =>
        of.kind === "number"
          ? of.value
          : of.kind === "variable" && this.constants.has(of.name)
            ? this.numberOf(of)
            : undefined,
    );
  }

  protected *waitUntil(statement: WaitUntil): Generator<Executed, void> {
    const when = this.condition(statement.when);
    if (when === undefined)
      throw new TextError(
        statement.when,
        "one input that is waited for",
        "Only a wait for one line can be carried out.",
      );
    // An output that the program itself has set is there already, or never comes.
    const own = this.outputs.has(when.signal) && !holds(when, { read: line => this.read(line), write: () => {} });
    if (own)
      throw new TextError(
        statement.when,
        "a condition that comes true",
        "The program waits for an output that nothing here changes.",
      );
    yield this.done(statement, { id: this.stepId(statement), type: "wait-for", when });
  }

  placeIn(variable: string): { readonly frame: string; readonly pose: Pose<"frame", "place"> } | undefined {
    const value = this.variable(variable);
    if (typeof value !== "object" || value.kind !== "pose") return undefined;
    return this.poseTarget<"place">(value);
  }

  edge(): void {
    this.hasTool = false;
  }

  override remember(): () => void {
    const values = super.remember();
    const arm = this.arm.remember();
    const { tool, hasTool } = this;
    const outputs = rememberMap(this.outputs);
    return () => {
      values();
      arm();
      this.tool = tool;
      this.hasTool = hasTool;
      outputs();
    };
  }

  // --- instructions -----------------------------------------------------------------------------------------------

  protected *instruction(statement: Do): Generator<Executed, Flow | undefined> {
    const { name } = statement;
    const args = new Arguments(name, statement.args, statement, each => this.evaluate(each));
    const id = (): string => this.stepId(statement);
    const say = (step: Step): Executed => this.done(statement, step);
    switch (name) {
      case "movej":
      case "movel":
      case "movep":
      case "movec":
        if (this.leaveOut(statement)) break;
        yield say(this.move(name, args, id()));
        this.lost = undefined;
        return undefined;
      case "sleep": {
        const s = asNumber(args.required(0, "t"), statement);
        if (!(s >= 0)) throw new TextError(statement, "a time of 0 s or more", `The time is ${s} s.`);
        yield say({ id: id(), type: "wait", s });
        return undefined;
      }
      case "set_tcp":
        this.setTcp(args, statement);
        break;
      case "set_payload":
      case "set_target_payload":
        yield say(this.payload(args, id()));
        return undefined;
      case "textmsg": {
        const parts = statement.args.map(({ value }) => (value === undefined ? "" : this.evaluate(value)));
        yield say({
          id: id(),
          type: "message",
          text: parts.map(part => (typeof part === "object" ? "" : String(part))).join(""),
        });
        return undefined;
      }
      default: {
        const route = name.startsWith("set_") ? routeOf(name) : undefined;
        if (route !== undefined) {
          yield say(this.write(route, name, args, id()));
          return undefined;
        }
        if (name.includes(".")) {
          // Another machine is asked to do something; that it exists must stand in the text.
          if (this.outside.get(name.split(".", 1)[0]!)?.includes("rpc_factory") === true) break;
          throw new TextError(
            statement,
            "a handle that rpc_factory has given",
            `What "${name.split(".", 1)[0]}" is stands nowhere in the text.`,
          );
        }
        if (!SILENT.has(name) && name !== "run" && name !== "kill" && name !== "join")
          throw REFUSED[name] === undefined
            ? missingProgram(statement, name)
            : new TextError(statement, "a statement of URScript", REFUSED[name]);
      }
    }
    yield { line: statement.line };
    return undefined;
  }

  private write(route: NonNullable<ReturnType<typeof routeOf>>, name: string, args: Arguments, id: string): Step {
    const number = args.given(0, "n");
    const value = args.required(1, route.kind === "digital-out" ? "b" : "f");
    // The first line of the tool is the gripper's.
    if (name === "set_tool_digital_out" && number.kind === "number" && number.value === 0)
      return { id, type: "gripper", closed: asTruth(value, args.at) };
    const signal = lineAt(
      route,
      this.numberOf(number),
      number.kind === "variable" ? number.name : undefined,
      this.declared.signals,
      number,
    );
    const to = route.kind === "digital-out" ? asTruth(value, args.at) : asNumber(value, args.at);
    this.outputs.set(signal, to);
    return { id, type: "set", signal, to };
  }

  private setTcp(args: Arguments, at: TextPlace): void {
    const pose = asPose(args.required(0, "pose"), at);
    const given = args.given(0, "pose");
    this.arm.tcp = matrixOf(pose.six);
    this.hasTool = true;
    this.tool = pose.six.every(x => x === 0)
      ? "flange"
      : nameIn(
          this.declared.tools,
          toPose(this.arm.tcp),
          given.kind === "variable" && given.name !== "flange" ? given.name : "tool",
          "_",
        );
  }

  private payload(args: Arguments, id: string): Step {
    const mass_kg = asNumber(args.required(0, "m"), args.at);
    const center = args.optional(1, "cog");
    const inertia = args.optional(2, "inertia");
    const [x, y, z] = center === undefined ? [0, 0, 0] : asNumbers(center, 3, args.at);
    if (inertia === undefined) return { id, type: "payload", mass_kg, center_m: [x!, y!, z!] };
    const [a, b, c, d, e, f] = asNumbers(inertia, 6, args.at);
    return { id, type: "payload", mass_kg, center_m: [x!, y!, z!], inertia_kgm2: [a!, b!, c!, d!, e!, f!] };
  }

  // --- moves ------------------------------------------------------------------------------------------------------

  private move(name: "movej" | "movel" | "movep" | "movec", args: Arguments, id: string): MoveStep {
    const isArc = name === "movec";
    const shift = isArc ? 1 : 0;
    const goal = args.required(shift, isArc ? "pose_to" : name === "movej" ? "q" : "pose");
    const takesTime = name === "movej" || name === "movel";
    const v = args.optional(shift + 2, "v");
    const t = takesTime ? args.optional(shift + 3, "t") : undefined;
    const r = args.optional(shift + (takesTime ? 4 : 3), "r");
    const blend = r === undefined ? 0 : asNumber(r, args.at);
    const time = t === undefined ? 0 : asNumber(t, args.at);
    if (!(blend >= 0)) throw new TextError(args.at, "a radius of 0 m or more", `The blend radius is ${blend} m.`);
    const via = isArc ? { via: this.target(args.required(0, "pose_via"), args.at, false) } : {};
    const speed =
      time > 0
        ? { time_s: time }
        : this.speed(name === "movej", v === undefined ? undefined : asNumber(v, args.at), args.at);
    const target = this.target(goal, args.at, name === "movej");
    this.arrive(goal, name === "movej", args.at);
    return {
      id,
      type: "move",
      path: name === "movej" ? "ptp" : isArc ? "circ" : "lin",
      target,
      ...via,
      speed,
      blend_m: blend,
    };
  }

  private speed(isJoint: boolean, v: number | undefined, at: TextPlace): Speed {
    const value = v ?? (isJoint ? DEFAULT_RAD_S : DEFAULT_MPS);
    if (!(value > 0)) throw new TextError(at, "a speed above 0", `The speed is ${value} ${isJoint ? "rad/s" : "m/s"}.`);
    return isJoint ? { ratio: Math.min(1, value / this.full_rad_s) } : { mps: value };
  }

  private target(goal: Value, at: TextPlace, choosesPosture: boolean): Target {
    const { tool } = this;
    if (typeof goal === "object" && goal.kind === "list") {
      if (goal.solves === undefined)
        return { q: asNumbers(goal, 6, at), ...(choosesPosture && !this.hasTool ? {} : { tool }) };
      const joints = goal.items.length === 6 ? asNumbers(goal, 6, at) : undefined;
      const branch = joints === undefined || !choosesPosture ? undefined : this.arm.branch(joints);
      return { ...this.poseTarget(goal.solves.pose), tool, ...(branch === undefined ? {} : { branch }) };
    }
    return { ...this.poseTarget(asPose(goal, at)), tool };
  }

  private poseTarget<From extends string = "tcp">(
    value: PoseValue,
  ): { readonly pose: Pose<"frame", From>; readonly frame: string } {
    const frame = value.inFrame?.frame;
    if (frame !== undefined && this.places.has(frame)) return { pose: toPose(matrixOf(value.inFrame!.six)), frame };
    if (frame !== undefined && this.constants.has(frame)) {
      const { frames } = this.declared;
      frames[frame] ??= this.arm.world(matrixOf(value.inFrame!.of));
      return { pose: toPose(matrixOf(value.inFrame!.six)), frame };
    }
    return { pose: this.arm.world(matrixOf(value.six)), frame: "world" };
  }

  /** A joint move ends in the angles it is given; the others lead the tool to where those angles would put it. */
  private arrive(goal: Value, isJoint: boolean, at: TextPlace): void {
    if (typeof goal === "object" && goal.kind === "list") {
      if (goal.solves !== undefined) return this.arm.atPose(goal.solves.pose, isJoint ? goal.solves.near : undefined);
      const joints = asNumbers(goal, 6, at);
      return isJoint ? this.arm.atJoints(joints) : this.arm.atPose(this.arm.six(this.arm.tipAt(joints)));
    }
    if (typeof goal !== "object")
      throw new TextError(at, "a pose or joint angles", `${kindOf(goal)} is no place to move to.`);
    this.arm.atPose(asPose(goal, at));
  }
}
