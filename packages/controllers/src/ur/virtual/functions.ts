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
  const { robot, memory, mover } = host;
  const { arm } = robot;
  const slowest = leadingJoint(robot);
  let flangeFromTcp: Pose<"flange", "tcp"> = identity();
  let payload_kg = 0;
  let cog: readonly number[] = [0, 0, 0];
  const worldInBase: Pose<"vendor-world", "base"> = inverse(robot.baseFromVendorWorld);
  const setTool = (six: readonly number[]): void => {
    flangeFromTcp = poseOf<"flange", "tcp">(matrixOf(six));
    mover.stream.tool = flangeFromTcp;
    memory.setAll("tcp_offset", six);
  };
  setTool([0, 0, 0, 0, 0, 0]);

  const at = slotOf("actual_q");
  const q = (): Float64Array => memory.slots.slice(at, at + arm.joints.length);
  const tcpOf = (joints: ArrayLike<number>, tool: Pose<"flange", "tcp">): number[] =>
    sixOf(placedOf(compose(worldInBase, compose(flangePose(arm, joints), tool))));
  const flangeFor = (six: readonly number[]): Pose<"base", "flange"> =>
    compose(compose(robot.baseFromVendorWorld, poseOf<"vendor-world", "tcp">(matrixOf(six))), inverse(flangeFromTcp));
  const solved = (six: readonly number[], near: ArrayLike<number>): Float64Array | null => {
    const out = new Float64Array(arm.joints.length);
    return nearestSolution(robot, flangeFor(six), near, out) ? out : null;
  };
  const six = (args: Arguments, value: Value): readonly number[] => asPose(value, args.at);

  /** A whole motion: the arm comes to rest first, then goes, and the program with it. */
  function* travel(step: MoveStep, thread: number): Generator<void, Value> {
    if (!mayMove) return null;
    if (!mover.isAtRest) mover.stop();
    while (!mover.isAtRest) yield;
    host.owner = thread;
    const moving = mover.run([step], { tools: { tcp: flangeFromTcp }, frames: {} });
    while (!moving.over) yield;
    if (moving.sentence !== "" && host.owner === thread) host.protectiveStop(moving.sentence);
    return null;
  }
  const target = (args: Arguments, value: Value, path: MoveStep["path"]): Target => {
    if (!isPose(value)) return { q: [...asNumbers(value, arm.joints.length, args.at)] };
    const numbers = six(args, value);
    if (path === "ptp") {
      const joints = solved(numbers, q());
      if (joints) return { q: [...joints] };
    }
    // The base is the world here.
    return {
      pose: compose(robot.baseFromVendorWorld, poseOf<"vendor-world", "tcp">(matrixOf(numbers))) as Pose as Pose<
        "frame",
        "tcp"
      >,
      frame: "world",
      tool: "tcp",
    };
  };
  const share = (value: number, of: number): number => Math.max(1e-3, Math.min(1, value / of));
  const joint = (args: Arguments, goal: Value): MoveStep => {
    const v = args.number(2, "v", DEFAULT.jointSpeed_rad_s);
    const a = args.number(1, "a", DEFAULT.jointAcceleration_rad_s2);
    const t = args.number(3, "t", 0);
    return {
      id: `line ${args.at.line}`,
      type: "move",
      path: "ptp",
      target: target(args, goal, "ptp"),
      blend_m: 0,
      acceleration: { ratio: share(a, slowest.acceleration_rad_s2) },
      speed: t > 0 ? { time_s: t } : { ratio: share(v, slowest.speed_rad_s) },
    };
  };
  const tool = (args: Arguments, path: "lin" | "circ", goal: Value, from: number, via?: Value): MoveStep => {
    const v = args.number(from + 1, "v", DEFAULT.toolSpeed_mps);
    const t = path === "lin" ? args.number(from + 2, "t", 0) : 0;
    return {
      id: `line ${args.at.line}`,
      type: "move",
      path,
      target: target(args, goal, path),
      blend_m: 0,
      speed: t > 0 ? { time_s: t } : { mps: Math.max(1e-4, v) },
      ...(via === undefined ? {} : { via: target(args, via, path) }),
    };
  };
  function* rest(seconds: number): Generator<void, Value> {
    const end_s = host.now_s() + seconds - host.cycle_s / 2;
    do yield;
    while (host.now_s() < end_s);
    return null;
  }
  /** Streams begin from where the arm is; a whole motion under way is ended first. */
  function* streaming(thread: number, begin: () => void, seconds: number | undefined): Generator<void, Value> {
    if (!mayMove) return null;
    host.owner = thread;
    if (mover.isTravelling) mover.stop();
    while (mover.isTravelling) yield;
    begin();
    if (seconds !== undefined) return yield* rest(seconds);
    do yield;
    while (!mover.stream.hasReached);
    return null;
  }
  function* stop(deceleration: number, thread: number): Generator<void, Value> {
    host.owner = thread;
    mover.stop(deceleration);
    do yield;
    while (!mover.isAtRest);
    return null;
  }
  const turned = (twist: readonly number[]): number[] =>
    [0, 3].flatMap(i => {
      const { r } = placedOf(robot.baseFromVendorWorld);
      const rotated = compose(
        poseOf<"a", "b">({ r, p: [0, 0, 0] }),
        poseOf<"b", "c">({ r: [0, 0, 0, 1], p: twist.slice(i, i + 3) }),
      );
      return [...rotated.position];
    });

  const register =
    (side: "input" | "output", kind: "int" | "double" | "bit") =>
    (args: Arguments): string => {
      const i = args.number(0, "address");
      const [least, most] = kind === "bit" ? [64, 127] : [0, 47];
      if (!Number.isInteger(i) || i < least || i > most)
        throw new ScriptError(args.at, `Registers of this kind count from ${least} to ${most}; ${i} was asked for.`);
      return `${side}_${kind}_register_${i}`;
    };
  const reads = (side: "input" | "output", kind: "int" | "double" | "bit"): ScriptFunction => {
    const at = register(side, kind);
    return args => (kind === "bit" ? memory.get(at(args)) !== 0 : memory.get(at(args)));
  };
  const writes = (kind: "int" | "double" | "bit"): ScriptFunction => {
    const at = register("output", kind);
    return args => {
      const value = args.value(1, "value");
      memory.set(at(args), kind === "int" ? Math.trunc(args.number(1, "value")) : Number(value));
      return null;
    };
  };
  const digital =
    (side: "input" | "output", from: number, count: number): ScriptFunction =>
    args => {
      const i = args.number(0, "n");
      if (!Number.isInteger(i) || i < 0 || i >= count)
        throw new ScriptError(args.at, `Lines of this kind count from 0 to ${count - 1}; ${i} was asked for.`);
      if (args.count === 1) return memory.digital(side, from + i);
      memory.setDigital("output", from + i, args.value(1, "b") === true);
      return null;
    };
  const nothing: ScriptFunction = () => null;

  return {
    movej: (args, thread) => travel(joint(args, args.value(0, "q")), thread),
    movel: (args, thread) => travel(tool(args, "lin", args.value(0, "pose"), 1), thread),
    movep: (args, thread) => travel(tool(args, "lin", args.value(0, "pose"), 1), thread),
    movec: (args, thread) => travel(tool(args, "circ", args.value(1, "pose_to"), 2, args.value(0, "pose_via")), thread),
    servoj: (args, thread) => {
      const goal = args.numbers(0, "q", arm.joints.length);
      const t = args.number(3, "t", DEFAULT.step_s);
      const lookahead = args.number(4, "lookahead_time", DEFAULT.lookahead_s);
      return streaming(
        thread,
        () => {
          mover.stream.servo(goal, Math.max(0.03, Math.min(0.2, lookahead)));
        },
        t,
      );
    },
    servoc: (args, thread) => {
      const joints = solved(six(args, args.value(0, "pose")), q());
      if (!joints) throw new ScriptError(args.at, "No posture reaches that pose.");
      return streaming(
        thread,
        () => {
          mover.stream.servo(joints, DEFAULT.lookahead_s);
        },
        host.cycle_s,
      );
    },
    speedj: (args, thread) => {
      const speeds = args.numbers(0, "qd", arm.joints.length);
      const a = args.number(1, "a", DEFAULT.jointAcceleration_rad_s2);
      const t = args.maybe(2, "t");
      return streaming(
        thread,
        () => {
          mover.stream.speed(speeds, a);
        },
        t === undefined ? undefined : args.number(2, "t"),
      );
    },
    speedl: (args, thread) => {
      const twist = turned(args.numbers(0, "xd", 6));
      const a = args.number(1, "a", DEFAULT.toolAcceleration_mps2);
      const t = args.maybe(2, "t");
      return streaming(
        thread,
        () => {
          mover.stream.moveTool(twist, a);
        },
        t === undefined ? undefined : args.number(2, "t"),
      );
    },
    stopj: (args, thread) => stop(args.number(0, "a", 2), thread),
    stopl: (args, thread) => stop(args.number(0, "a", 10), thread),
    sync: function* () {
      yield;
      return null;
    },
    sleep: args => rest(args.number(0, "t")),
    get_steptime: () => host.cycle_s,
    textmsg: args => {
      host.say(args.all.map(asText).join(""));
      return null;
    },
    popup: args => {
      host.say(asText(args.value(0, "s")));
      return null;
    },

    get_inverse_kin: args => {
      const near = args.maybe(1, "qnear");
      const joints = solved(
        six(args, args.value(0, "x")),
        near === undefined ? q() : asNumbers(near, arm.joints.length, args.at),
      );
      if (!joints) throw new ScriptError(args.at, "No posture reaches that pose.");
      return [...joints];
    },
    get_inverse_kin_has_solution: args => solved(six(args, args.value(0, "x")), q()) !== null,
    get_forward_kin: args => {
      const joints = args.maybe(0, "q");
      const tcp = args.maybe(1, "tcp");
      return pose(
        tcpOf(
          joints === undefined ? q() : asNumbers(joints, arm.joints.length, args.at),
          tcp === undefined ? flangeFromTcp : poseOf<"flange", "tcp">(matrixOf(six(args, tcp))),
        ),
      );
    },
    get_actual_joint_positions: () => [...q()],
    get_target_joint_positions: () => [...q()],
    get_actual_joint_positions_history: () => [...q()],
    get_actual_joint_speeds: () => [...mover.qd],
    get_target_joint_speeds: () => [...mover.qd],
    get_actual_tcp_pose: () => pose(tcpOf(q(), flangeFromTcp)),
    get_target_tcp_pose: () => pose(tcpOf(q(), flangeFromTcp)),
    get_target_waypoint: () => pose(tcpOf(q(), flangeFromTcp)),
    get_actual_tool_flange_pose: () => pose(tcpOf(q(), identity())),
    get_actual_tcp_speed: zeros,
    get_target_tcp_speed: zeros,
    get_joint_torques: zeros,
    get_tcp_force: zeros,
    set_tcp: args => {
      setTool(six(args, args.value(0, "pose")));
      return null;
    },
    get_tcp_offset: () => pose(sixOf(placedOf(flangeFromTcp))),
    set_payload: args => {
      payload_kg = args.number(0, "m");
      const centre = args.maybe(1, "cog");
      if (centre !== undefined) cog = asNumbers(centre, 3, args.at);
      memory.set("payload", payload_kg);
      memory.setAll("payload_cog", cog, 3);
      return null;
    },
    set_target_payload: args => {
      payload_kg = args.number(0, "m");
      cog = args.numbers(1, "cog", 3);
      memory.set("payload", payload_kg);
      memory.setAll("payload_cog", cog, 3);
      return null;
    },
    get_target_payload: () => payload_kg,
    get_target_payload_cog: () => [...cog],
    get_target_payload_inertia: zeros,
    is_steady: () => !mover.isMoving,
    is_within_safety_limits: args => {
      const value = args.value(0, "pose");
      const joints = isPose(value) ? solved(value.pose, q()) : asNumbers(value, arm.joints.length, args.at);
      return (
        joints !== null &&
        arm.joints.every(({ limits }, i) => joints[i]! >= limits.lower_rad && joints[i]! <= limits.upper_rad)
      );
    },
    protective_stop: () => {
      host.protectiveStop("The program asked for a protective stop.");
      return null;
    },
    rtde_set_watchdog: args => {
      host.watch(
        asText(args.value(0, "variable_name")),
        args.number(1, "min_frequency"),
        asText(args.maybe(2, "action") ?? "pause"),
      );
      return null;
    },

    read_input_integer_register: reads("input", "int"),
    read_input_float_register: reads("input", "double"),
    read_input_boolean_register: reads("input", "bit"),
    read_output_integer_register: reads("output", "int"),
    read_output_float_register: reads("output", "double"),
    read_output_boolean_register: reads("output", "bit"),
    write_output_integer_register: writes("int"),
    write_output_float_register: writes("double"),
    write_output_boolean_register: writes("bit"),
    get_digital_in: digital("input", 0, 18),
    get_standard_digital_in: digital("input", 0, 8),
    get_configurable_digital_in: digital("input", 8, 8),
    get_tool_digital_in: digital("input", 16, 2),
    get_digital_out: digital("output", 0, 18),
    get_standard_digital_out: digital("output", 0, 8),
    get_configurable_digital_out: digital("output", 8, 8),
    get_tool_digital_out: digital("output", 16, 2),
    set_digital_out: digital("output", 0, 18),
    set_standard_digital_out: digital("output", 0, 8),
    set_configurable_digital_out: digital("output", 8, 8),
    set_tool_digital_out: digital("output", 16, 2),

    // Taken, and without effect here: there is no force, no friction and no hand on the arm.
    set_gravity: nothing,
    zero_ftsensor: nothing,
    force_mode: nothing,
    end_force_mode: nothing,
    force_mode_set_damping: nothing,
    force_mode_set_gain_scaling: nothing,
    freedrive_mode: nothing,
    end_freedrive_mode: nothing,
    teach_mode: nothing,
    end_teach_mode: nothing,
    ft_rtde_input_enable: nothing,
    enable_external_ft_sensor: nothing,
    set_tool_voltage: nothing,
    tool_contact: () => 0,
    get_freedrive_status: () => 0,
  };
}
