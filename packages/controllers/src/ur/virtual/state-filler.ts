import {
  compose,
  flangePose,
  identity,
  inverse,
  jacobian,
  jacobianScratch,
  tipTwist,
  toUrVector,
  type Robot,
} from "@twincell/core";
import { JOINT_MODE, ROBOT_MODE, ROBOT_STATUS, RUNTIME, safetyBits } from "../codec/modes.ts";
import { slotOf } from "../codec/rtde-fields.ts";
import type { Memory } from "./memory.ts";
import type { Mover } from "./mover.ts";
import type { Programs } from "./programs.ts";
import type { States } from "./states.ts";

const AT = {
  timestamp: slotOf("timestamp"),
  q: slotOf("actual_q"),
  targetQ: slotOf("target_q"),
  qd: slotOf("actual_qd"),
  targetQd: slotOf("target_qd"),
  tcp: slotOf("actual_TCP_pose"),
  targetTcp: slotOf("target_TCP_pose"),
  tcpSpeed: slotOf("actual_TCP_speed"),
  targetTcpSpeed: slotOf("target_TCP_speed"),
  jointMode: slotOf("joint_mode"),
  robotMode: slotOf("robot_mode"),
  safetyMode: slotOf("safety_mode"),
  safetyStatus: slotOf("safety_status"),
  runtime: slotOf("runtime_state"),
  robotBits: slotOf("robot_status_bits"),
  safetyBits: slotOf("safety_status_bits"),
  scaling: slotOf("speed_scaling"),
  fraction: slotOf("target_speed_fraction"),
  line: slotOf("script_control_line"),
  temperatures: slotOf("joint_temperatures"),
  voltages: slotOf("actual_joint_voltage"),
  execution: slotOf("actual_execution_time"),
} as const;
const CELSIUS = 30;
const VOLT = 48;

/** Writes what the robot does into the controller's variables, once a cycle, without allocating. */
export function stateFiller(
  robot: Robot,
  memory: Memory,
  mover: Mover,
  states: States,
  programs: Programs,
): (time_s: number, q: Float64Array, fraction: number) => void {
  const { slots } = memory;
  const { arm } = robot;
  const n = arm.joints.length;
  const worldInBase = inverse(robot.baseFromVendorWorld);
  const scratch = jacobianScratch(n);
  const flange = identity<"base", "flange">();
  const tool = identity<"base", "tcp">();
  const seen = identity<"vendor-world", "tcp">();
  const vector: [number, number, number] = [0, 0, 0];
  const rows = new Float64Array(6 * n);
  const twist = new Float64Array(6);
  // A turn about z: directions turn with it.
  const [, , z, w] = worldInBase.quaternion;
  const cos = w * w - z * z;
  const sin = 2 * w * z;
  memory.setAll("joint_temperatures", new Array<number>(6).fill(CELSIUS));
  memory.setAll("actual_joint_voltage", new Array<number>(6).fill(VOLT));
  memory.set("actual_main_voltage", VOLT);
  memory.set("actual_robot_voltage", VOLT);

  return (time_s, q, fraction) => {
    slots[AT.timestamp] = time_s;
    const mode =
      states.robotMode === ROBOT_MODE.RUNNING
        ? JOINT_MODE.running
        : states.robotMode === ROBOT_MODE.IDLE
          ? JOINT_MODE.idle
          : JOINT_MODE.powerOff;
    for (let i = 0; i < n; i++) {
      slots[AT.q + i] = slots[AT.targetQ + i] = q[i]!;
      slots[AT.qd + i] = slots[AT.targetQd + i] = mover.qd[i]!;
      slots[AT.jointMode + i] = mode;
    }
    flangePose(arm, q, flange, scratch.arm);
    compose(flange, mover.stream.tool, tool);
    compose(worldInBase, tool, seen);
    toUrVector(seen.quaternion, vector);
    for (let i = 0; i < 3; i++) {
      slots[AT.tcp + i] = slots[AT.targetTcp + i] = seen.position[i]!;
      slots[AT.tcp + 3 + i] = slots[AT.targetTcp + 3 + i] = vector[i]!;
    }
    if (mover.isMoving) tipTwist(jacobian(arm, q, mover.stream.tool.position, rows, scratch), mover.qd, twist);
    else twist.fill(0);
    for (const at of [AT.tcpSpeed, AT.targetTcpSpeed]) {
      for (let i = 0; i < 6; i += 3) {
        slots[at + i] = cos * twist[i]! - sin * twist[i + 1]!;
        slots[at + i + 1] = sin * twist[i]! + cos * twist[i + 1]!;
        slots[at + i + 2] = twist[i + 2]!;
      }
    }
    slots[AT.robotMode] = states.robotMode;
    slots[AT.safetyMode] = slots[AT.safetyStatus] = states.safetyMode;
    slots[AT.safetyBits] = safetyBits(states.safetyMode);
    slots[AT.runtime] = programs.runtime;
    slots[AT.robotBits] =
      (states.robotMode >= ROBOT_MODE.IDLE ? ROBOT_STATUS.powerOn : 0) |
      (programs.runtime === RUNTIME.PLAYING ? ROBOT_STATUS.programRunning : 0);
    slots[AT.scaling] = programs.runtime === RUNTIME.PAUSED ? 0 : fraction;
    slots[AT.fraction] = fraction;
    slots[AT.line] = programs.line;
  };
}
