import {
  angleBetween,
  branchOf,
  compose,
  distance,
  flangePose,
  fromMatrix,
  identity,
  inverse,
  toYaskawaRxyz,
  type MoveStep,
  type Pose,
  type Robot,
  type Speed,
  type Target,
  type TextPlace,
} from "@twincell/core";
import { TextError, type Notices, type DeclaredCell } from "../../parser/index.ts";
import type { Frame, Move, Position, Source } from "../read/syntax.ts";
import { BORDERS, poseOf, type Arm } from "./arm.ts";

/** Where corners begin by default, PL 0 … 4 [m]; further levels are set on the controller. */
const LEVELS_M = [0, 0.0125, 0.025, 0.05, 0.1];
const LAST_LEVEL = 8;
/** Closer than this a point is where the robot already is. */
const SAME = { position_m: 5e-5, angle_rad: 2e-4 } as const;
const PATHS = { MOVJ: "ptp", MOVL: "lin", MOVC: "circ", MOVS: "spline" } as const;

/** A shift in force: positions are moved by it along the axes of a frame. */
export interface Shift {
  readonly baseFromFrame: Pose<"base", "frame">;
  readonly by: Pose;
}

/** Where the arm is sent, and the steps this amounts to. */
export class ControllerState {
  shift: Shift | undefined;
  speed: { vj: number; v_mps: number } = { vj: 100, v_mps: 0.1 };
  /** Numbers of tools and frames that the text does not hold, with the line that asked for them. */
  readonly assumed = new Map<string, TextPlace>();
  private readonly robot: Robot;
  private readonly arm: Arm;
  private readonly source: Source;
  private readonly context: DeclaredCell;
  private readonly pulses: readonly number[] | undefined;
  private readonly worldFromVendor: Pose<"world", "vendor-world">;
  private readonly baseFromVendor: Pose<"base", "vendor-world">;
  private readonly notices: Notices | undefined;
  /** The robot went where nobody here knows. */
  isLost = false;
  private axes_deg: readonly number[];
  private baseFromFlange: Pose<"base", "flange">;

  constructor(
    robot: Robot,
    arm: Arm,
    source: Source,
    worldFromBase: Pose<"world", "base">,
    context: DeclaredCell,
    pulses: readonly number[] | undefined,
    notices?: Notices,
  ) {
    this.notices = notices;
    this.robot = robot;
    this.arm = arm;
    this.source = source;
    this.context = context;
    this.pulses = pulses;
    this.baseFromVendor = robot.baseFromVendorWorld;
    this.worldFromVendor = compose(worldFromBase, robot.baseFromVendorWorld);
    this.axes_deg = arm.degrees(robot.home_rad);
    this.baseFromFlange = flangePose(robot.arm, robot.home_rad);
  }

  /** Where the robot is sent, to be compared with later. */
  get here(): Pose<"base", "flange"> {
    return this.baseFromFlange;
  }

  /** Where the tool stands now, as a position of a frame: X, Y, Z [mm], Rx, Ry, Rz [deg]. */
  standing(type: "BASE" | "ROBOT" | "USER", user: number, tool: number, at: TextPlace): Position {
    const { baseFromFrame } = this.frameOf(type, user, at);
    const { flangeFromTcp } = this.toolOf({ ...at, type, user, tool, values: [], rconf: [] }, at);
    const { position, quaternion } = compose(
      inverse(baseFromFrame),
      compose(this.baseFromFlange, flangeFromTcp),
    ) as Pose;
    const values = [...position.map(value => value * 1000), ...toYaskawaRxyz(quaternion)];
    return { ...at, type, user, tool, values, rconf: [] };
  }

  /** A position that is moved along the axes of its frame, or of its tool. */
  movedBy(from: Position, by: readonly number[], inTool: boolean, at: TextPlace): Position {
    const frameFromTcp = poseOf(from.values);
    const step = poseOf([by[0]!, by[1]!, by[2]!, 0, 0, 0]);
    if (by.slice(3, 6).some(angle => angle !== 0))
      throw new TextError(at, "an amount that does not turn", "IMOV with a turn of the tool is not executed here.");
    const { position, quaternion } = inTool ? compose(frameFromTcp, step) : compose(step, frameFromTcp);
    return { ...from, values: [...position.map(value => value * 1000), ...toYaskawaRxyz(quaternion)] };
  }

  /** Whether the robot is there already: arcs and curves begin with the point before them once more. */
  isAt(position: Position | Pose<"base", "flange">, at: TextPlace): boolean {
    const there = "quaternion" in position ? position : this.flangeOf(position, at);
    const here = this.baseFromFlange;
    return (
      distance(there.position, here.position) < SAME.position_m &&
      angleBetween(there.quaternion, here.quaternion) < SAME.angle_rad
    );
  }

  /** The neutral step of a motion; from now on the arm is at its end. */
  move(id: string, move: Move, position: Position, via: Position | undefined, at: TextPlace): MoveStep {
    const path = PATHS[move.motion];
    const passing = via === undefined ? undefined : this.place(via, at);
    const acceleration = Math.min(move.acc ?? 100, move.dec ?? 100) / 100;
    if (move.vj !== undefined) this.speed.vj = percent(move.vj, at);
    if (move.v !== undefined) this.speed.v_mps = positive(move.v, at) / 1000;
    const speed: Speed = path === "ptp" ? { ratio: this.speed.vj / 100 } : { mps: this.speed.v_mps };
    this.isLost = false;
    const target = isAxes(position) ? this.toPulses(position, at) : this.toPlace(position, at);
    return {
      id,
      type: "move",
      path,
      target,
      speed,
      blend_m: 0,
      ...(passing === undefined ? {} : { via: passing }),
      ...(acceleration < 1 ? { acceleration: { ratio: acceleration } } : {}),
    };
  }

  /** How far from the point a corner begins. */
  corner({ pl, cr }: Move, at: TextPlace): number {
    if (cr !== undefined) return positive(cr, at) / 1000;
    if (pl === undefined) return 0;
    if (!(Number.isInteger(pl) && pl >= 0 && pl <= LAST_LEVEL))
      throw new TextError(at, `PL=0 to PL=${LAST_LEVEL}`, `There is no position level ${pl}.`);
    return LEVELS_M[Math.min(pl, LEVELS_M.length - 1)]!;
  }

  /** User frames that the job worked out itself. */
  private readonly made = new Map<number, Frame>();

  /** MFRAME: the origin, a point on the x axis and one on the side of y [mm], from the base. */
  makeFrame(number: number, [origin, onX, onXy]: readonly (readonly [number, number, number])[], at: TextPlace): void {
    const minus = (a: readonly number[], b: readonly number[]): number[] => a.map((value, i) => value - b[i]!);
    const cross = ([a, b, c]: readonly number[], [d, e, f]: readonly number[]): number[] => [
      b! * f! - c! * e!,
      c! * d! - a! * f!,
      a! * e! - b! * d!,
    ];
    const unit = (v: readonly number[]): number[] => {
      const length = Math.hypot(...v);
      if (!(length > 1e-6))
        throw new TextError(at, "three positions apart", `The positions of user frame ${number} are on one line.`);
      return v.map(value => value / length);
    };
    const x = unit(minus(onX!, origin!));
    const z = unit(cross(x, minus(onXy!, origin!)));
    const y = cross(z, x);
    const turn = fromMatrix([x[0]!, y[0]!, z[0]!, x[1]!, y[1]!, z[1]!, x[2]!, y[2]!, z[2]!]);
    this.made.set(number, { number, name: "", values: [...origin!, ...toYaskawaRxyz(turn)] });
  }

  frameOf(
    type: Position["type"],
    user: number,
    at: TextPlace,
  ): { readonly name: string; readonly baseFromFrame: Pose<"base", "frame"> } {
    if (type === "TOOL")
      throw new TextError(
        at,
        "a position of BASE, ROBOT or USER",
        "A position that counts from the tool is not executed here.",
      );
    if (type !== "USER") return { name: "world", baseFromFrame: this.baseFromVendor as Pose as Pose<"base", "frame"> };
    const frame = this.listed(this.source.users, user, "User frame", at);
    const vendorFromFrame = poseOf<"vendor-world", "frame">(frame.values);
    return {
      name: named(this.context.frames, compose(this.worldFromVendor, vendorFromFrame), frame.name, "world"),
      baseFromFrame: compose(this.baseFromVendor, vendorFromFrame),
    };
  }

  private toPulses(position: Position, at: TextPlace): Target {
    this.axes_deg = this.axesOf(position, at);
    const q = this.arm.radians(this.axes_deg);
    this.baseFromFlange = flangePose(this.robot.arm, q);
    if (this.shift !== undefined)
      throw new TextError(at, "a position in X, Y, Z", "A shift of a position in pulses is not understood here.");
    return { q, tool: this.toolOf(position, at).name };
  }

  private axesOf(position: Position, at: TextPlace): number[] {
    if (position.type === "ANGLE") return this.arm.degrees(this.robot.home_rad).map((_, i) => position.values[i] ?? 0);
    if (this.pulses === undefined)
      throw new TextError(
        position,
        "X, Y, Z positions, or the pulses per degree of this robot",
        "Positions in pulses are only understood with the pulses per degree from the controller's parameters.",
      );
    const { pulses } = this;
    const count = this.robot.arm.joints.length;
    if (position.values.length < count || position.values.slice(count).some(value => value !== 0))
      throw new TextError(
        at,
        `${count} axes`,
        `The position has ${position.values.length} axes; the robot has ${count}.`,
      );
    return pulses.map((perDegree, i) => position.values[i]! / perDegree);
  }

  private toPlace(position: Position, at: TextPlace): Target {
    const flange = this.flangeOf(position, at);
    const place = this.place(position, at);
    const all = this.arm.reaching(flange, this.axes_deg);
    this.baseFromFlange = flange;
    if (all.length === 0) return place;
    const ofType = (border: typeof BORDERS.exact | typeof BORDERS.written): number[] | undefined =>
      all.find(axes => this.arm.isOfType(axes, position.rconf, border));
    const taken = ofType(BORDERS.exact) ?? ofType(BORDERS.written);
    if (taken === undefined) {
      if (this.shift === undefined && this.notices !== undefined)
        this.notices.add(
          at,
          "a manipulator type that the point can be reached with",
          `Line ${at.line}: this robot does not reach the point as RCONF ${position.rconf.slice(0, 6).join(",")}; the nearest posture is taken.`,
        );
      else if (this.shift === undefined)
        throw new TextError(
          at,
          "a manipulator type that the point can be reached with",
          `The point cannot be reached within the axis limits as RCONF ${position.rconf.slice(0, 6).join(",")}.`,
        );
      this.axes_deg = all[0]!;
      return place;
    }
    this.axes_deg = taken;
    const q = this.arm.radians(taken);
    const branch = branchOf(this.robot, q);
    // The nearest turn of that posture is what a pose means; another one can only be said by the axes themselves.
    const nearest = all.find(axes => sameBranch(branchOf(this.robot, this.arm.radians(axes)), branch));
    return nearest === taken || isAxes(position)
      ? { ...place, ...(branch === undefined ? {} : { branch }) }
      : { q, tool: place.tool };
  }

  private flangeOf(position: Position, at: TextPlace): Pose<"base", "flange"> {
    if (isAxes(position)) return flangePose(this.robot.arm, this.arm.radians(this.axesOf(position, at)));
    return compose(this.baseFromTcp(position, at), inverse(this.toolOf(position, at).flangeFromTcp));
  }

  private baseFromTcp(position: Position, at: TextPlace): Pose<"base", "tcp"> {
    const { baseFromFrame } = this.frameOf(position.type, position.user, at);
    const taught = compose(baseFromFrame, poseOf<"frame", "tcp">(position.values));
    const { shift } = this;
    if (shift === undefined) return taught;
    return compose(
      compose(shift.baseFromFrame, shift.by as Pose as Pose<"frame", "frame">),
      compose(inverse(shift.baseFromFrame), taught),
    );
  }

  private place(position: Position, at: TextPlace): Extract<Target, { readonly pose: unknown }> {
    const tool = this.toolOf(position, at);
    if (isAxes(position)) {
      const tip = compose(
        compose(this.worldFromVendor, inverse(this.baseFromVendor)),
        compose(this.flangeOf(position, at), tool.flangeFromTcp),
      );
      return { pose: tip as Pose as Pose<"frame", "tcp">, frame: "world", tool: tool.name };
    }
    const { name, baseFromFrame } = this.frameOf(position.type, position.user, at);
    const tip = this.baseFromTcp(position, at);
    if (name !== "world") return { pose: compose(inverse(baseFromFrame), tip), frame: name, tool: tool.name };
    const vendorFromTcp =
      this.shift === undefined
        ? poseOf<"vendor-world", "tcp">(position.values)
        : compose(inverse(this.baseFromVendor), tip);
    return {
      pose: compose(this.worldFromVendor, vendorFromTcp) as Pose as Pose<"frame", "tcp">,
      frame: "world",
      tool: tool.name,
    };
  }

  private toolOf(
    { tool }: Position,
    at: TextPlace,
  ): { readonly name: string; readonly flangeFromTcp: Pose<"flange", "tcp"> } {
    const frame = this.listed(this.source.tools, tool, "Tool", at);
    const flangeFromTcp = poseOf<"flange", "tcp">(frame.values);
    return frame.values.every(value => value === 0)
      ? { name: "flange", flangeFromTcp: identity() }
      : { name: named(this.context.tools, flangeFromTcp, frame.name, "flange"), flangeFromTcp };
  }

  private listed(list: ReadonlyMap<number, Frame>, number: number, what: string, at: TextPlace): Frame {
    const frame = (what === "Tool" ? undefined : this.made.get(number)) ?? list.get(number);
    if (frame === undefined && number !== 0) {
      this.assumed.set(`${what} ${number}`, at);
      this.notices?.notGiven(at, keptOnController(`${what} ${number}`));
    }
    const { name = "", values = [0, 0, 0, 0, 0, 0] } = frame ?? {};
    return { number, name: name === "" ? `${what === "Tool" ? "tool" : "user"} ${number}` : name, values };
  }
}

/** Whether a position says the axes themselves. */
const isAxes = ({ type }: Position): boolean => type === "PULSE" || type === "ANGLE";
/** What is taken of a tool or frame whose file is not there. */
export const keptOnController = (name: string): string => `${name} is kept on the controller: it is taken to be 0.`;

const sameBranch = (a: ReturnType<typeof branchOf>, b: ReturnType<typeof branchOf>): boolean =>
  a?.shoulder === b?.shoulder && a?.elbow === b?.elbow && a?.wrist === b?.wrist;

function positive(value: number, at: TextPlace): number {
  if (!(value > 0)) throw new TextError(at, "a number above 0", `The value is ${value}.`);
  return value;
}
function percent(value: number, at: TextPlace): number {
  if (!(value > 0 && value <= 100))
    throw new TextError(at, "a number above 0 and up to 100", `The share is ${value} %.`);
  return value;
}

/** What was met before keeps its name; two things never share one. */
function named<P extends Pose>(known: Record<string, P>, pose: P, wanted: string, never: string): string {
  const text = JSON.stringify(pose);
  const stem = wanted === never ? `${wanted} 1` : wanted;
  for (let i = 1; ; i++) {
    const name = i === 1 ? stem : `${stem} ${i}`;
    const there = Object.hasOwn(known, name) ? known[name] : undefined;
    if (there === undefined) known[name] = pose;
    if (there === undefined || JSON.stringify(there) === text) return name;
  }
}
