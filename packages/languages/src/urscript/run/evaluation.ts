import { type Pose, type Robot, type Signals, type TextPlace } from "@twincell/core";
import { TextError, type DeclaredCell, times } from "../../parser/index.ts";
import { BlockMachine, changedNames, type Expression } from "../../parser/structured/index.ts";
import type { Source } from "../read/grammar.ts";
import { ControllerArm } from "./arm.ts";
import { matrixOf } from "./frame.ts";
import { FUNCTIONS, itemOf, withItem } from "./functions.ts";
import { Arguments } from "./arguments.ts";
import { conditionOf, routeOf, lineAt } from "./lines.ts";
import { asNumber, asNumbers, asPose, asTruth, binary, poseOf, type Value } from "./values.ts";

/** Functions whose answer comes from another machine or a sensor: what they say is in no text. */
const OUTSIDE =
  /^(?:socket_|rpc_factory$|read_(?:input|output|port)_|modbus_get_|get_tcp_force$|force$|get_joint_torques$|get_tool_accelerometer|get_tool_current$|get_controller_temp$|get_robot_mode$|get_actual_tcp_speed$|get_target_tcp_speed$)|\./;

/** A value that another machine gives. Never leaves an assignment; anything else that needs it is refused. */
export class OutsideValue extends TextError {}

/** What expressions of URScript are worth, and lines that are read in them. */
export abstract class Evaluation extends BlockMachine<Value> {
  readonly arm: ControllerArm;
  readonly declared: DeclaredCell;

  /** Speed at which the slowest joint turns, so that all can [rad/s]. */
  protected readonly full_rad_s: number;
  protected readonly constants: ReadonlySet<string>;

  /** Names that some statement of the text gives a value. */
  private readonly assigned: ReadonlySet<string>;
  protected readonly outputs = new Map<string, boolean | number>();

  private readonly signals: Signals | undefined;
  /** Variables whose value another machine gave, and how. */
  protected readonly outside = new Map<string, string>();

  protected tool = "flange";
  /** What the program that is started wants to be given, if anything. */
  protected readonly isAsking: string | undefined;

  /** Why nobody knows where the robot is: a sentence. */
  protected lost: string | undefined;
  /** Whether the tool was set where the program is now; joint angles alone do not ask for one. */
  protected hasTool = false;

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

  /** A name that the text gives no value: the program around this file does. */
  protected isOfAnother(name: string): boolean {
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
      default:
        return this.composed(expression);
    }
  }

  /** What is part of something, or made of parts. */
  private composed(
    expression: Exclude<Expression, { kind: "number" | "truth" | "text" | "variable" | "list" }>,
  ): Value {
    switch (expression.kind) {
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
    return this.computed(expression, args);
  }

  /** What a line is, and what is computed of values. */
  private computed(expression: Extract<Expression, { kind: "call" }>, args: Arguments): Value {
    const { name, args: given } = expression;
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

  protected read(line: string): boolean | number {
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
}
