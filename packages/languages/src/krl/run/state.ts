import {
  branchOf,
  compose,
  flangePose,
  inverse,
  type MoveStep,
  type Pose,
  type Robot,
  type Speed,
  type Target,
  type TextPlace,
  type Vector3,
} from "@twincell/core";
import { TextError, type DeclaredCell } from "../../parser/index.ts";
import type { Motion } from "../read/syntax.ts";
import { STATUS_SLACK, travel, type Axes } from "./axes.ts";
import { componentsOf, frameOf, fromPose, inverted, times, toPose, type Frame } from "./frames.ts";
import { System, type Named } from "./system.ts";
import { component, toFrame, type Structure } from "./values.ts";

const AXIS_NAMES = ["A1", "A2", "A3", "A4", "A5", "A6"] as const;

/** Where the arm is sent, and the steps this amounts to. */
export class ControllerState {
  readonly system = new System();
  private readonly robot: Robot;
  private readonly axes: Axes;
  private readonly context: DeclaredCell;
  private readonly worldFromRoot: Pose<"world", "root">;
  private readonly rootFromBase: Pose<"root", "base">;
  /** Where the flange is sent, in the controller's $WORLD, and the axis values there. */
  private flange: Frame;
  private axes_deg: readonly number[];
  /** Names given last: most motions keep their tool and their base. */
  private toolMet: { readonly of: Named | undefined; readonly name: string } = { of: undefined, name: "" };
  private baseMet: { readonly of: Named | undefined; readonly name: string } = { of: undefined, name: "" };

  constructor(robot: Robot, axes: Axes, worldFromBase: Pose<"world", "base">, context: DeclaredCell) {
    this.robot = robot;
    this.axes = axes;
    this.context = context;
    this.worldFromRoot = compose(worldFromBase, robot.baseFromVendorWorld as Pose as Pose<"base", "root">);
    this.rootFromBase = inverse(robot.baseFromVendorWorld as Pose as Pose<"base", "root">);
    this.axes_deg = axes.degrees(robot.home_rad);
    this.flange = this.flangeAt(this.axes_deg);
  }

  /** $POS_ACT: the tool in the base. */
  here(): Frame {
    const { tool, base } = this.system;
    return times(times(inverted(base.frame), this.flange), tool.frame);
  }

  get presentAxes_deg(): readonly number[] {
    return this.axes_deg;
  }

  /** The neutral step of a motion; from now on the arm is at its end. */
  move(id: string, motion: Motion, target: Structure, via: Structure | undefined, at: TextPlace): MoveStep {
    const isAxes = AXIS_NAMES.some(name => target.fields.has(name));
    if (isAxes && motion.motion !== "PTP")
      throw new TextError(at, "a position with X, Y, Z, A, B, C", `${motion.motion} does not take axis values.`);
    const passing = via === undefined ? undefined : this.viaPose(via, at);
    const path =
      motion.motion === "PTP" ? "ptp" : motion.motion === "LIN" ? "lin" : motion.motion === "CIRC" ? "circ" : "spline";
    const reached = isAxes ? this.toAxes(target, motion.relative) : this.toPosition(target, motion, at);
    const ratio = path === "ptp" ? this.system.accelerationRatio : this.system.pathAccelerationRatio;
    return {
      id,
      type: "move",
      path,
      target: reached,
      speed: this.speed(path),
      blend_m: 0,
      ...(passing === undefined ? {} : { via: passing }),
      ...(Math.abs(ratio - 1) < 1e-6 ? {} : { acceleration: { ratio: Math.min(1, ratio) } }),
    };
  }

  private speed(path: MoveStep["path"]): Speed {
    return path === "ptp" ? { ratio: this.system.velocityRatio } : { mps: this.system.pathSpeed_mps };
  }

  private toAxes(target: Structure, relative: boolean): Target {
    this.axes_deg = AXIS_NAMES.slice(0, this.axes.count).map((name, i) => {
      const value = component(target, name);
      return relative ? this.axes_deg[i]! + (value ?? 0) : (value ?? this.axes_deg[i]!);
    });
    this.flange = this.flangeAt(this.axes_deg);
    return { q: this.axes.radians(this.axes_deg), tool: this.nameTool() };
  }

  private toPosition(target: Structure, motion: Motion, at: TextPlace): Target {
    const { tool, base } = this.system;
    const baseFromTcp = motion.relative
      ? motion.inTool
        ? this.shiftedInTool(target)
        : this.shifted(target)
      : toFrame(target, this.here(), at);
    this.flange = times(times(base.frame, baseFromTcp), inverted(tool.frame));
    const status = component(target, "S");
    const turn = motion.motion === "PTP" ? component(target, "T") : undefined;
    const before = this.axes_deg;
    const all = this.axes.reaching(compose(inverse(this.rootFromBase), toPose<"root", "flange">(this.flange)), before);
    const exact = status === undefined ? all : all.filter(axes => this.axes.hasStatus(axes, status));
    const candidates =
      exact.length > 0 || status === undefined
        ? exact
        : all.filter(axes => this.axes.hasStatus(axes, status, STATUS_SLACK.written));
    if (candidates.length === 0) {
      if (all.length > 0)
        throw new TextError(
          at,
          "a Status that the point can be reached with",
          `The point cannot be reached within the axis limits with Status ${status}.`,
        );
      return this.poseTarget(baseFromTcp, undefined);
    }
    candidates.sort((a, b) => travel(a, before) - travel(b, before));
    const turned = turn === undefined ? candidates[0] : candidates.find(axes => this.axes.hasTurn(axes, turn));
    if (turned === undefined)
      throw new TextError(
        at,
        "a Turn that the point can be reached with",
        `The point cannot be reached within the axis limits with Turn ${turn}.`,
      );
    this.axes_deg = turned;
    const q = this.axes.radians(turned);
    // The nearest turn is what a pose means; another one can only be said by the axes themselves.
    return turned === candidates[0] ? this.poseTarget(baseFromTcp, q) : { q, tool: this.nameTool() };
  }

  private poseTarget(baseFromTcp: Frame, q: readonly number[] | undefined): Target {
    const branch = q === undefined ? undefined : branchOf(this.robot, q);
    return { ...this.place(baseFromTcp), ...(branch === undefined ? {} : { branch }) };
  }

  private viaPose(via: Structure, at: TextPlace): Target {
    if (AXIS_NAMES.some(name => via.fields.has(name)))
      throw new TextError(at, "a position with X, Y, Z, A, B, C", "CIRC does not take axis values.");
    return this.place(toFrame(via, this.here(), at));
  }

  private place(baseFromTcp: Frame): { pose: Pose<"frame", "tcp">; frame: string; tool: string } {
    const { base } = this.system;
    const frame = this.nameFrame(base);
    const tool = this.nameTool();
    if (frame !== "world") return { pose: toPose(baseFromTcp), frame, tool };
    return {
      pose: compose(
        this.worldFromRoot as Pose as Pose<"frame", "root">,
        toPose<"root", "tcp">(times(base.frame, baseFromTcp)),
      ),
      frame,
      tool,
    };
  }

  /** LIN_REL and PTP_REL: what is given is added to the present position, in the base. */
  private shifted(by: Structure): Frame {
    const now = componentsOf(this.here());
    const [x, y, z, a, b, c] = (["X", "Y", "Z", "A", "B", "C"] as const).map(
      (name, i) => now[i]! + (component(by, name) ?? 0),
    );
    return frameOf(x!, y!, z!, a!, b!, c!);
  }

  /** `LIN_REL {Z -50} #TOOL`: what is given is a pose seen from the tool as it stands. */
  private shiftedInTool(by: Structure): Frame {
    const [x, y, z, a, b, c] = (["X", "Y", "Z", "A", "B", "C"] as const).map(name => component(by, name) ?? 0);
    return times(this.here(), frameOf(x!, y!, z!, a!, b!, c!));
  }

  private flangeAt(axes_deg: readonly number[]): Frame {
    return fromPose(compose(this.rootFromBase, flangePose(this.robot.arm, this.axes.radians(axes_deg))));
  }

  private nameTool(): string {
    const { tool } = this.system;
    if (this.toolMet.of !== tool) {
      this.toolMet = {
        of: tool,
        name: isNull(tool.frame)
          ? "flange"
          : named(this.context.tools, toPose<"flange", "tcp">(tool.frame), plainName(tool, "TOOL"), "flange"),
      };
    }
    return this.toolMet.name;
  }

  /** The base of the robot is no frame of a program: what is given in it is given in the world. */
  private nameFrame(base: Named): string {
    if (this.baseMet.of !== base) {
      const isWorld = isNull(base.frame);
      this.baseMet = {
        of: base,
        name: isWorld
          ? "world"
          : named(
              this.context.frames,
              compose(this.worldFromRoot, toPose<"root", "frame">(base.frame)),
              plainName(base, "BASE"),
              "world",
            ),
      };
    }
    return this.baseMet.name;
  }

  /** What the flange carries, centre of mass in metres. */
  payload(
    load: Structure,
    at: TextPlace,
  ): { mass_kg: number; center_m: Vector3; inertia_kgm2?: [number, number, number, number, number, number] } {
    const cm = load.fields.get("CM");
    const j = load.fields.get("J");
    const mass_kg = component(load, "M");
    if (mass_kg === undefined || cm?.kind !== "structure")
      throw new TextError(at, "a load with M and CM", "$LOAD takes a mass and the place of its centre.");
    const {
      r,
      p_mm: [x, y, z],
    } = toFrame(cm, undefined, at);
    const center_m: Vector3 = [x / 1000, y / 1000, z / 1000];
    const main =
      j?.kind === "structure" ? [component(j, "X") ?? 0, component(j, "Y") ?? 0, component(j, "Z") ?? 0] : [0, 0, 0];
    if (main.every(value => value === 0)) return { mass_kg, center_m };
    const of = (i: number, k: number): number =>
      [0, 1, 2].reduce((sum, n) => sum + r[3 * i + n]! * main[n]! * r[3 * k + n]!, 0);
    return { mass_kg, center_m, inertia_kgm2: [of(0, 0), of(1, 1), of(2, 2), of(0, 1), of(0, 2), of(1, 2)] };
  }
}

const isNull = ({ r, p_mm }: Frame): boolean =>
  p_mm.every(value => value === 0) && r[0] === 1 && r[4] === 1 && r[8] === 1;

/** TOOL_TORCH is the tool "torch"; TOOL_DATA_1 stays what it is. */
const plainName = ({ name }: Named, word: "TOOL" | "BASE"): string => {
  const stem = name.startsWith(`${word}_`) && !name.startsWith(`${word}_DATA`) ? name.slice(word.length + 1) : name;
  return (stem === "" ? word : stem).toLowerCase();
};

/** What was met before keeps its name; two things never share one. */
function named<P extends Pose>(known: Record<string, P>, pose: P, wanted: string, never: string): string {
  const text = JSON.stringify(pose);
  const stem = wanted === never ? `${wanted}_1` : wanted;
  for (let i = 1; ; i++) {
    const name = i === 1 ? stem : `${stem}_${i}`;
    const there = Object.hasOwn(known, name) ? known[name] : undefined;
    if (there === undefined) known[name] = pose;
    if (there === undefined || JSON.stringify(there) === text) return name;
  }
}
