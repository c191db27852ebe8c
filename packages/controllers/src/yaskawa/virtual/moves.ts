import { compose, flangePose, inverse, solveAll, type Pose, type Robot, type Step } from "@twincell/core";
import type { VirtualController } from "../../virtual/index.ts";
import {
  ADDED,
  CARTESIAN_PATH,
  MOVE_FRAME,
  PULSE_PATH,
  SPEED_CLASS,
  formOf,
  poseAt,
  radiansOf,
  readCartesianMove,
  readPulseMove,
  type PulseScale,
} from "../codec/index.ts";
import type { Machine } from "./machine.ts";

export interface MoveOptions {
  readonly robot: Robot;
  readonly neutral: VirtualController;
  readonly machine: Machine;
  readonly scale: PulseScale;
  readonly tools: ReadonlyMap<number, Pose<"flange", "tcp">>;
  readonly users: ReadonlyMap<number, Pose<"base", "frame">>;
  /** Called with the end of every motion that was accepted. */
  readonly onMotion?: (q_rad: ArrayLike<number>) => void;
}
export interface MoveOrders {
  /** 0x8B and 0x8A: 0 when the motion has begun, or the added status of the refusal. */
  pulse(path: number, data: Uint8Array): number;
  cartesian(path: number, data: Uint8Array): number;
}

type MoveTarget = Extract<Step, { type: "move" }>["target"];
/** A motion by its share of the greatest speed: 0.01 % up to 100 %. */
const MOST_RATIO = 10_000;

/** Orders to move: data looked at, the posture found, the motion handed to the machine. */
export function moveOrders(options: MoveOptions): MoveOrders {
  return moveOrdersOf(new Moves(options));
}

class Moves {
  readonly options: MoveOptions;
  readonly robot: Robot;
  readonly neutral: VirtualController;
  readonly machine: Machine;
  readonly scale: PulseScale;
  readonly n: number;
  readonly baseFromVendor: Pose<"base", "frame">;

  constructor(options: MoveOptions) {
    this.options = options;
    this.robot = this.options.robot;
    this.neutral = this.options.neutral;
    this.machine = this.options.machine;
    this.scale = this.options.scale;
    this.n = this.robot.arm.joints.length;
    this.baseFromVendor = this.robot.baseFromVendorWorld as Pose as Pose<"base", "frame">;
  }

  readonly movePulse = (path: number, data: Uint8Array): number => {
    const move = readPulseMove(data);
    if (path !== PULSE_PATH.joint && path !== PULSE_PATH.straight) return ADDED.noInstance;
    if (!move) return ADDED.size;
    if (move.robot !== 1) return ADDED.noGroup;
    if (!this.options.tools.has(move.tool)) return ADDED.tool;
    const q_rad = radiansOf(move.axes, this.scale, this.robot, new Float64Array(this.n));
    if (!this.inside(q_rad)) return ADDED.outOfRange;
    return this.go(path === PULSE_PATH.joint, q_rad, { q: [...q_rad] }, move, move.tool);
  };

  readonly moveCartesian = (path: number, data: Uint8Array): number => {
    const move = readCartesianMove(data);
    if (path < CARTESIAN_PATH.joint || path > CARTESIAN_PATH.straightBy) return ADDED.noInstance;
    if (!move) return ADDED.size;
    if (move.robot !== 1) return ADDED.noGroup;
    const flangeFromTcp = this.options.tools.get(move.tool);
    const now_rad = this.neutral.jointAngles();
    if (!flangeFromTcp) return ADDED.tool;
    const baseFromTcp = compose(flangePose(this.robot.arm, now_rad), flangeFromTcp);
    const frame =
      move.frame === MOVE_FRAME.base || move.frame === MOVE_FRAME.robot
        ? this.baseFromVendor
        : move.frame === MOVE_FRAME.user
          ? this.options.users.get(move.user)
          : move.frame === MOVE_FRAME.tool && path === CARTESIAN_PATH.straightBy
            ? (baseFromTcp as Pose as Pose<"base", "frame">)
            : null;
    if (frame === null) return ADDED.frame;
    if (frame === undefined) return ADDED.userFrame;
    const said = poseAt<"frame", "tcp">(move.place);
    const target = path === CARTESIAN_PATH.straightBy ? this.shifted(frame, baseFromTcp, said) : compose(frame, said);
    const reach = solveAll(this.robot, compose(target, inverse(flangeFromTcp)), { near: now_rad });
    if (reach.kind !== "reached") return ADDED.outOfRange;
    const q_rad =
      path === CARTESIAN_PATH.joint
        ? reach.solutions.find(solution => formOf(this.robot, solution.q_rad) === (move.form & 0x3f))?.q_rad
        : reach.solutions[0]!.q_rad;
    if (!q_rad) return ADDED.outOfRange;
    return this.go(
      path === CARTESIAN_PATH.joint,
      q_rad,
      path === CARTESIAN_PATH.joint
        ? { q: [...q_rad] }
        : { pose: target as Pose as Pose<"frame", "tcp">, frame: "world", tool: `${move.tool}` },
      move,
      move.tool,
    );
  };

  /** By so much along the axes of a frame, turned about where the tool is. */
  shifted(
    baseFromFrame: Pose<"base", "frame">,
    baseFromTcp: Pose<"base", "tcp">,
    by: Pose<"frame", "tcp">,
  ): Pose<"base", "tcp"> {
    const frameFromTcp = compose(inverse(baseFromFrame), baseFromTcp);
    const [x, y, z] = frameFromTcp.position;
    const turned = compose(
      { position: [0, 0, 0], quaternion: by.quaternion } as Pose,
      { position: [0, 0, 0], quaternion: frameFromTcp.quaternion } as Pose,
    );
    return compose(baseFromFrame, {
      position: [x + by.position[0], y + by.position[1], z + by.position[2]],
      quaternion: turned.quaternion,
    } as Pose<"frame", "tcp">);
  }

  inside(q_rad: ArrayLike<number>): boolean {
    return this.robot.arm.joints.every(
      ({ limits }, i) => q_rad[i]! >= limits.lower_rad && q_rad[i]! <= limits.upper_rad,
    );
  }

  go(
    isJoint: boolean,
    q_rad: ArrayLike<number>,
    target: MoveTarget,
    { speedClass, speed }: { readonly speedClass: number; readonly speed: number },
    tool: number,
  ): number {
    if (speed < 1) return ADDED.speed;
    if (speedClass === SPEED_CLASS.ratio && speed > MOST_RATIO) return ADDED.speed;
    if (
      isJoint ? speedClass !== SPEED_CLASS.ratio : speedClass !== SPEED_CLASS.ratio && speedClass !== SPEED_CLASS.linear
    )
      return ADDED.speed;
    const ratio = speed / MOST_RATIO;
    const step: Step = {
      id: "",
      type: "move",
      path: isJoint ? "ptp" : "lin",
      target: "q" in target ? { ...target, tool: `${tool}` } : target,
      blend_m: 0,
      speed: isJoint
        ? { ratio }
        : { mps: speedClass === SPEED_CLASS.ratio ? ratio * this.robot.maxTcpSpeed_mps : speed / 10_000 },
    };
    const why = this.machine.move(step, {
      tools: Object.fromEntries([...this.options.tools].map(([number, pose]) => [`${number}`, pose])),
      frames: {},
    });
    if (why === 0) this.options.onMotion?.(q_rad);
    return why;
  }
}

function moveOrdersOf(own: Moves): MoveOrders {
  return { pulse: own.movePulse, cartesian: own.moveCartesian };
}
