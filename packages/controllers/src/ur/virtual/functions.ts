import {
  compose,
  flangePose,
  identity,
  inverse,
  nearestSolution,
  type MoveStep,
  type Pose,
  type Robot,
  type Target,
  type SerialArm,
} from "@twincell/core";
import { leadingJoint } from "../codec/models.ts";
import { slotOf } from "../codec/rtde-fields.ts";
import {
  asNumbers,
  asPose,
  asText,
  isPose,
  placedOf,
  poseOf,
  ScriptError,
  matrixOf,
  sixOf,
  type Arguments,
  type ScriptFunction,
  type Value,
} from "./script/index.ts";
import type { Memory } from "./memory.ts";
import type { Mover } from "./mover.ts";

/** What a running script has of its controller. */
export interface ScriptHost {
  readonly robot: Robot;
  readonly memory: Memory;
  readonly mover: Mover;
  readonly cycle_s: number;
  now_s(): number;
  say(text: string): void;
  protectiveStop(because: string): void;
  /** Ends or holds the program when an input is not written often enough. */
  watch(input: string, least_Hz: number, action: string): void;
  /** The thread whose motion is under way. */
  owner: number;
}

const DEFAULT = {
  jointSpeed_rad_s: 1.05,
  jointAcceleration_rad_s2: 1.4,
  toolSpeed_mps: 0.25,
  toolAcceleration_mps2: 1.2,
  step_s: 0.002,
  lookahead_s: 0.1,
} as const;
const pose = (six: readonly number[]): Value => ({ pose: six });
const zeros = (): Value => [0, 0, 0, 0, 0, 0];

/**
 * Functions of the controller for one script: motion, registers, lines, poses. There is no force here: what commands it
 * is taken and has no effect.
 */
export function robotFunctions(host: ScriptHost, mayMove: boolean): Readonly<Record<string, ScriptFunction>> {
  return robotFunctionsOf(new Functions(host, mayMove));
}

class Functions {
  readonly host: ScriptHost;
  readonly mayMove: boolean;
  readonly robot: Robot;
  readonly memory: Memory;
  readonly mover: Mover;
  readonly arm: SerialArm;
  readonly slowest: { readonly speed_rad_s: number; readonly acceleration_rad_s2: number };
  flangeFromTcp: Pose<"flange", "tcp"> = identity();
  payload_kg = 0;
  cog: readonly number[] = [0, 0, 0];
  readonly worldInBase: Pose<"vendor-world", "base">;
  readonly at = slotOf("actual_q");

  constructor(host: ScriptHost, mayMove: boolean) {
    this.host = host;
    this.mayMove = mayMove;
    this.robot = this.host.robot;
    this.memory = this.host.memory;
    this.mover = this.host.mover;
    this.arm = this.robot.arm;
    this.slowest = leadingJoint(this.robot);
    this.worldInBase = inverse(this.robot.baseFromVendorWorld);
    this.setTool([0, 0, 0, 0, 0, 0]);
  }

  setTool(six: readonly number[]): void {
    this.flangeFromTcp = poseOf<"flange", "tcp">(matrixOf(six));
    this.mover.stream.tool = this.flangeFromTcp;
    this.memory.setAll("tcp_offset", six);
  }

  q(): Float64Array {
    return this.memory.slots.slice(this.at, this.at + this.arm.joints.length);
  }

  tcpOf(joints: ArrayLike<number>, tool: Pose<"flange", "tcp">): number[] {
    return sixOf(placedOf(compose(this.worldInBase, compose(flangePose(this.arm, joints), tool))));
  }

  flangeFor(six: readonly number[]): Pose<"base", "flange"> {
    return compose(
      compose(this.robot.baseFromVendorWorld, poseOf<"vendor-world", "tcp">(matrixOf(six))),
      inverse(this.flangeFromTcp),
    );
  }

  solved(six: readonly number[], near: ArrayLike<number>): Float64Array | null {
    const out = new Float64Array(this.arm.joints.length);
    return nearestSolution(this.robot, this.flangeFor(six), near, out) ? out : null;
  }

  six(args: Arguments, value: Value): readonly number[] {
    return asPose(value, args.at);
  }

  /** A whole motion: the arm comes to rest first, then goes, and the program with it. */
  *travel(step: MoveStep, thread: number): Generator<void, Value> {
    if (!this.mayMove) return null;
    if (!this.mover.isAtRest) this.mover.stop();
    while (!this.mover.isAtRest) yield;
    this.host.owner = thread;
    const moving = this.mover.run([step], { tools: { tcp: this.flangeFromTcp }, frames: {} });
    while (!moving.over) yield;
    if (moving.sentence !== "" && this.host.owner === thread) this.host.protectiveStop(moving.sentence);
    return null;
  }

  target(args: Arguments, value: Value, path: MoveStep["path"]): Target {
    if (!isPose(value)) return { q: [...asNumbers(value, this.arm.joints.length, args.at)] };
    const numbers = this.six(args, value);
    if (path === "ptp") {
      const joints = this.solved(numbers, this.q());
      if (joints) return { q: [...joints] };
    }
    // The base is the world here.
    return {
      pose: compose(this.robot.baseFromVendorWorld, poseOf<"vendor-world", "tcp">(matrixOf(numbers))) as Pose as Pose<
        "frame",
        "tcp"
      >,
      frame: "world",
      tool: "tcp",
    };
  }

  share(value: number, of: number): number {
    return Math.max(1e-3, Math.min(1, value / of));
  }

  joint(args: Arguments, goal: Value): MoveStep {
    const v = args.number(2, "v", DEFAULT.jointSpeed_rad_s);
    const a = args.number(1, "a", DEFAULT.jointAcceleration_rad_s2);
    const t = args.number(3, "t", 0);
    return {
      id: `line ${args.at.line}`,
      type: "move",
      path: "ptp",
      target: this.target(args, goal, "ptp"),
      blend_m: 0,
      acceleration: { ratio: this.share(a, this.slowest.acceleration_rad_s2) },
      speed: t > 0 ? { time_s: t } : { ratio: this.share(v, this.slowest.speed_rad_s) },
    };
  }

  tool(args: Arguments, path: "lin" | "circ", goal: Value, from: number, via?: Value): MoveStep {
    const v = args.number(from + 1, "v", DEFAULT.toolSpeed_mps);
    const t = path === "lin" ? args.number(from + 2, "t", 0) : 0;
    return {
      id: `line ${args.at.line}`,
      type: "move",
      path,
      target: this.target(args, goal, path),
      blend_m: 0,
      speed: t > 0 ? { time_s: t } : { mps: Math.max(1e-4, v) },
      ...(via === undefined ? {} : { via: this.target(args, via, path) }),
    };
  }

  *rest(seconds: number): Generator<void, Value> {
    const end_s = this.host.now_s() + seconds - this.host.cycle_s / 2;
    do yield;
    while (this.host.now_s() < end_s);
    return null;
  }

  /** Streams begin from where the arm is; a whole motion under way is ended first. */
  *streaming(thread: number, begin: () => void, seconds: number | undefined): Generator<void, Value> {
    if (!this.mayMove) return null;
    this.host.owner = thread;
    if (this.mover.isTravelling) this.mover.stop();
    while (this.mover.isTravelling) yield;
    begin();
    if (seconds !== undefined) return yield* this.rest(seconds);
    do yield;
    while (!this.mover.stream.hasReached);
    return null;
  }

  *stop(deceleration: number, thread: number): Generator<void, Value> {
    this.host.owner = thread;
    this.mover.stop(deceleration);
    do yield;
    while (!this.mover.isAtRest);
    return null;
  }

  turned(twist: readonly number[]): number[] {
    return [0, 3].flatMap(i => {
      const { r } = placedOf(this.robot.baseFromVendorWorld);
      const rotated = compose(
        poseOf<"a", "b">({ r, p: [0, 0, 0] }),
        poseOf<"b", "c">({ r: [0, 0, 0, 1], p: twist.slice(i, i + 3) }),
      );
      return [...rotated.position];
    });
  }

  register(side: "input" | "output", kind: "int" | "double" | "bit") {
    return (args: Arguments): string => {
      const i = args.number(0, "address");
      const [least, most] = kind === "bit" ? [64, 127] : [0, 47];
      if (!Number.isInteger(i) || i < least || i > most)
        throw new ScriptError(args.at, `Registers of this kind count from ${least} to ${most}; ${i} was asked for.`);
      return `${side}_${kind}_register_${i}`;
    };
  }

  reads(side: "input" | "output", kind: "int" | "double" | "bit"): ScriptFunction {
    const at = this.register(side, kind);
    return args => (kind === "bit" ? this.memory.get(at(args)) !== 0 : this.memory.get(at(args)));
  }

  writes(kind: "int" | "double" | "bit"): ScriptFunction {
    const at = this.register("output", kind);
    return args => {
      const value = args.value(1, "value");
      this.memory.set(at(args), kind === "int" ? Math.trunc(args.number(1, "value")) : Number(value));
      return null;
    };
  }

  digital(side: "input" | "output", from: number, count: number): ScriptFunction {
    return args => {
      const i = args.number(0, "n");
      if (!Number.isInteger(i) || i < 0 || i >= count)
        throw new ScriptError(args.at, `Lines of this kind count from 0 to ${count - 1}; ${i} was asked for.`);
      if (args.count === 1) return this.memory.digital(side, from + i);
      this.memory.setDigital("output", from + i, args.value(1, "b") === true);
      return null;
    };
  }

  readonly nothing: ScriptFunction = () => null;
}

type Group = Readonly<Record<string, ScriptFunction>>;

function robotFunctionsOf(own: Functions): Group {
  return {
    ...motionsOf(own),
    ...measuredOf(own),
    ...settingsOf(own),
    ...registersOf(own),
    ...withoutEffectOf(own),
  };
}

/** Motions, and what takes time. */
function motionsOf(own: Functions): Group {
  return {
    movej: (args, thread) => own.travel(own.joint(args, args.value(0, "q")), thread),
    movel: (args, thread) => own.travel(own.tool(args, "lin", args.value(0, "pose"), 1), thread),
    movep: (args, thread) => own.travel(own.tool(args, "lin", args.value(0, "pose"), 1), thread),
    movec: (args, thread) =>
      own.travel(own.tool(args, "circ", args.value(1, "pose_to"), 2, args.value(0, "pose_via")), thread),
    servoj: (args, thread) => {
      const goal = args.numbers(0, "q", own.arm.joints.length);
      const t = args.number(3, "t", DEFAULT.step_s);
      const lookahead = args.number(4, "lookahead_time", DEFAULT.lookahead_s);
      return own.streaming(
        thread,
        () => {
          own.mover.stream.servo(goal, Math.max(0.03, Math.min(0.2, lookahead)));
        },
        t,
      );
    },
    servoc: (args, thread) => {
      const joints = own.solved(own.six(args, args.value(0, "pose")), own.q());
      if (!joints) throw new ScriptError(args.at, "No posture reaches that pose.");
      return own.streaming(
        thread,
        () => {
          own.mover.stream.servo(joints, DEFAULT.lookahead_s);
        },
        own.host.cycle_s,
      );
    },
    speedj: (args, thread) => {
      const speeds = args.numbers(0, "qd", own.arm.joints.length);
      const a = args.number(1, "a", DEFAULT.jointAcceleration_rad_s2);
      const t = args.maybe(2, "t");
      return own.streaming(
        thread,
        () => {
          own.mover.stream.speed(speeds, a);
        },
        t === undefined ? undefined : args.number(2, "t"),
      );
    },
    speedl: (args, thread) => {
      const twist = own.turned(args.numbers(0, "xd", 6));
      const a = args.number(1, "a", DEFAULT.toolAcceleration_mps2);
      const t = args.maybe(2, "t");
      return own.streaming(
        thread,
        () => {
          own.mover.stream.moveTool(twist, a);
        },
        t === undefined ? undefined : args.number(2, "t"),
      );
    },
    stopj: (args, thread) => own.stop(args.number(0, "a", 2), thread),
    stopl: (args, thread) => own.stop(args.number(0, "a", 10), thread),
    sync: function* () {
      yield;
      return null;
    },
    sleep: args => own.rest(args.number(0, "t")),
    get_steptime: () => own.host.cycle_s,
    textmsg: args => {
      own.host.say(args.all.map(asText).join(""));
      return null;
    },
    popup: args => {
      own.host.say(asText(args.value(0, "s")));
      return null;
    },
  };
}

/** Where the arm is, and where it would be. */
function measuredOf(own: Functions): Group {
  return {
    get_inverse_kin: args => {
      const near = args.maybe(1, "qnear");
      const joints = own.solved(
        own.six(args, args.value(0, "x")),
        near === undefined ? own.q() : asNumbers(near, own.arm.joints.length, args.at),
      );
      if (!joints) throw new ScriptError(args.at, "No posture reaches that pose.");
      return [...joints];
    },
    get_inverse_kin_has_solution: args => own.solved(own.six(args, args.value(0, "x")), own.q()) !== null,
    get_forward_kin: args => {
      const joints = args.maybe(0, "q");
      const tcp = args.maybe(1, "tcp");
      return pose(
        own.tcpOf(
          joints === undefined ? own.q() : asNumbers(joints, own.arm.joints.length, args.at),
          tcp === undefined ? own.flangeFromTcp : poseOf<"flange", "tcp">(matrixOf(own.six(args, tcp))),
        ),
      );
    },
    get_actual_joint_positions: () => [...own.q()],
    get_target_joint_positions: () => [...own.q()],
    get_actual_joint_positions_history: () => [...own.q()],
    get_actual_joint_speeds: () => [...own.mover.qd],
    get_target_joint_speeds: () => [...own.mover.qd],
    get_actual_tcp_pose: () => pose(own.tcpOf(own.q(), own.flangeFromTcp)),
    get_target_tcp_pose: () => pose(own.tcpOf(own.q(), own.flangeFromTcp)),
    get_target_waypoint: () => pose(own.tcpOf(own.q(), own.flangeFromTcp)),
    get_actual_tool_flange_pose: () => pose(own.tcpOf(own.q(), identity())),
    get_actual_tcp_speed: zeros,
    get_target_tcp_speed: zeros,
    get_joint_torques: zeros,
    get_tcp_force: zeros,
  };
}

/** Tool, load and safety. */
function settingsOf(own: Functions): Group {
  return {
    set_tcp: args => {
      own.setTool(own.six(args, args.value(0, "pose")));
      return null;
    },
    get_tcp_offset: () => pose(sixOf(placedOf(own.flangeFromTcp))),
    set_payload: args => {
      own.payload_kg = args.number(0, "m");
      const centre = args.maybe(1, "cog");
      if (centre !== undefined) own.cog = asNumbers(centre, 3, args.at);
      own.memory.set("payload", own.payload_kg);
      own.memory.setAll("payload_cog", own.cog, 3);
      return null;
    },
    set_target_payload: args => {
      own.payload_kg = args.number(0, "m");
      own.cog = args.numbers(1, "cog", 3);
      own.memory.set("payload", own.payload_kg);
      own.memory.setAll("payload_cog", own.cog, 3);
      return null;
    },
    get_target_payload: () => own.payload_kg,
    get_target_payload_cog: () => [...own.cog],
    get_target_payload_inertia: zeros,
    is_steady: () => !own.mover.isMoving,
    is_within_safety_limits: args => {
      const value = args.value(0, "pose");
      const joints = isPose(value) ? own.solved(value.pose, own.q()) : asNumbers(value, own.arm.joints.length, args.at);
      return (
        joints !== null &&
        own.arm.joints.every(({ limits }, i) => joints[i]! >= limits.lower_rad && joints[i]! <= limits.upper_rad)
      );
    },
    protective_stop: () => {
      own.host.protectiveStop("The program asked for a protective stop.");
      return null;
    },
    rtde_set_watchdog: args => {
      own.host.watch(
        asText(args.value(0, "variable_name")),
        args.number(1, "min_frequency"),
        asText(args.maybe(2, "action") ?? "pause"),
      );
      return null;
    },
  };
}

/** Registers and lines. */
function registersOf(own: Functions): Group {
  return {
    read_input_integer_register: own.reads("input", "int"),
    read_input_float_register: own.reads("input", "double"),
    read_input_boolean_register: own.reads("input", "bit"),
    read_output_integer_register: own.reads("output", "int"),
    read_output_float_register: own.reads("output", "double"),
    read_output_boolean_register: own.reads("output", "bit"),
    write_output_integer_register: own.writes("int"),
    write_output_float_register: own.writes("double"),
    write_output_boolean_register: own.writes("bit"),
    get_digital_in: own.digital("input", 0, 18),
    get_standard_digital_in: own.digital("input", 0, 8),
    get_configurable_digital_in: own.digital("input", 8, 8),
    get_tool_digital_in: own.digital("input", 16, 2),
    get_digital_out: own.digital("output", 0, 18),
    get_standard_digital_out: own.digital("output", 0, 8),
    get_configurable_digital_out: own.digital("output", 8, 8),
    get_tool_digital_out: own.digital("output", 16, 2),
    set_digital_out: own.digital("output", 0, 18),
    set_standard_digital_out: own.digital("output", 0, 8),
    set_configurable_digital_out: own.digital("output", 8, 8),
    set_tool_digital_out: own.digital("output", 16, 2),
  };
}

function withoutEffectOf(own: Functions): Group {
  return {
    // Taken, and without effect here: there is no force, no friction and no hand on the arm.
    set_gravity: own.nothing,
    zero_ftsensor: own.nothing,
    force_mode: own.nothing,
    end_force_mode: own.nothing,
    force_mode_set_damping: own.nothing,
    force_mode_set_gain_scaling: own.nothing,
    freedrive_mode: own.nothing,
    end_freedrive_mode: own.nothing,
    teach_mode: own.nothing,
    end_teach_mode: own.nothing,
    ft_rtde_input_enable: own.nothing,
    enable_external_ft_sensor: own.nothing,
    set_tool_voltage: own.nothing,
    tool_contact: () => 0,
    get_freedrive_status: () => 0,
  };
}
