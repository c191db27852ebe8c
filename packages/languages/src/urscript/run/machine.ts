import {
  type Executed,
  type MoveStep,
  type Pose,
  type Robot,
  type Speed,
  type Step,
  type Target,
  type TextPlace,
} from "@twincell/core";
import { TextError, missingProgram, nameIn, rememberMap } from "../../parser/index.ts";
import { type Block, type Do, type Flow, type Statement, type WaitUntil } from "../../parser/structured/index.ts";
import { SILENT } from "../read/silent.ts";
import { matrixOf, toPose } from "./frame.ts";
import { Arguments } from "./arguments.ts";
import { routeOf, holds, lineAt } from "./lines.ts";
import { asNumber, asNumbers, asPose, asTruth, kindOf, type PoseValue, type Value } from "./values.ts";
import { Evaluation, OutsideValue } from "./evaluation.ts";

/** The controller counts joints as the robot's own file does: no sign, zero or coupling is ever set there. */
export function speaksUrScript({ vendorSection }: Robot): boolean {
  if (vendorSection?.languages.includes("urscript") !== true) return false;
  const { axes, couplings = [] } = vendorSection;
  return axes.every(({ sign, zero_deg }) => sign > 0 && zero_deg === 0) && couplings.length === 0;
}

/** What the controller takes where a move says nothing [rad/s, m/s]. */
const DEFAULT_RAD_S = 1.05;

const DEFAULT_MPS = 0.25;

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

/** Executes URScript statement by statement. */
export class Machine extends Evaluation {
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
      default:
        return yield* this.toldOrWritten(statement, args);
    }
    yield { line: statement.line };
    return undefined;
  }

  /** What is set, said and written. */
  private *toldOrWritten(statement: Do, args: Arguments): Generator<Executed, Flow | undefined> {
    const { name } = statement;
    const id = (): string => this.stepId(statement);
    const say = (step: Step): Executed => this.done(statement, step);
    switch (name) {
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
