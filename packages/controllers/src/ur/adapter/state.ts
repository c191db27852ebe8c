import type { JointSample, Robot, SafetyState } from "@twincell/core";
import { ANALOGUE_LINES, DIGITAL_LINES } from "../codec/models.ts";
import { EMERGENCY_STOPS, ROBOT_MODE, RUNTIME, SAFEGUARD_STOPS, SAFETY_MODE } from "../codec/modes.ts";
import { slotOf } from "../codec/rtde-fields.ts";
import { LISTENING, REGISTERS } from "./control-program.ts";

/** What the driver asks the controller to tell, 500 times a second. */
export const OUTPUTS = [
  "timestamp",
  "actual_q",
  "target_q",
  "target_qd",
  "robot_mode",
  "safety_mode",
  "runtime_state",
  "target_speed_fraction",
  "actual_digital_input_bits",
  "actual_digital_output_bits",
  "standard_analog_input0",
  "standard_analog_input1",
  "standard_analog_output0",
  "standard_analog_output1",
  `output_int_register_${REGISTERS.ended}`,
  `output_int_register_${REGISTERS.listening}`,
  `input_int_register_${REGISTERS.heartbeat}`,
] as const;
export const RATE_HZ = 500;
const AT = {
  time: slotOf("timestamp"),
  q: slotOf("actual_q"),
  target: slotOf("target_q"),
  speed: slotOf("target_qd"),
  mode: slotOf("robot_mode"),
  safety: slotOf("safety_mode"),
  runtime: slotOf("runtime_state"),
  fraction: slotOf("target_speed_fraction"),
  inputs: slotOf("actual_digital_input_bits"),
  outputs: slotOf("actual_digital_output_bits"),
  ended: slotOf(`output_int_register_${REGISTERS.ended}`),
  listening: slotOf(`output_int_register_${REGISTERS.listening}`),
  echo: slotOf(`input_int_register_${REGISTERS.heartbeat}`),
  analogue: [
    "standard_analog_input0",
    "standard_analog_input1",
    "standard_analog_output0",
    "standard_analog_output1",
  ].map(slotOf),
} as const;
/** Slower joints stand [rad/s]. */
const STANDS_RAD_S = 1e-6;
/** Output 0 at the tool closes the gripper. */
export const GRIPPER_LINE = 16;
const ANALOGUE_NAMES = ["in", "out"].flatMap(side =>
  Array.from({ length: ANALOGUE_LINES }, (_, i) => `analog_${side}_${i}`),
);

type Lent = { -readonly [K in keyof Omit<JointSample, "step">]: JointSample[K] };

/** What the last package said, as the rest of the world reads it. */
export class UrReading {
  private readonly slots: Float64Array;
  private readonly signals = new Map<string, boolean | number>();
  private inputs = NaN;
  private outputs = NaN;
  readonly sample: Lent;

  constructor(slots: Float64Array, robot: Robot) {
    const n = robot.arm.joints.length;
    this.slots = slots;
    this.sample = {
      sequence: 0,
      time_s: 0,
      q_rad: new Float64Array(n),
      target_rad: new Float64Array(n),
      moving: false,
      mode: "remote",
      safety: "normal",
      override: 1,
      gripperClosed: false,
      message: "",
      signals: this.signals,
    };
  }

  get robotMode(): number {
    return this.slots[AT.mode]!;
  }
  get safetyMode(): number {
    return this.slots[AT.safety]!;
  }
  get runtime(): number {
    return this.slots[AT.runtime]!;
  }
  /** The last heartbeat that the controller has heard. */
  get echo(): number {
    return this.slots[AT.echo]!;
  }
  get ended(): number {
    return this.slots[AT.ended]!;
  }
  get isPlaying(): boolean {
    return this.runtime === RUNTIME.PLAYING || this.runtime === RUNTIME.RESUMING;
  }
  get isIdle(): boolean {
    return this.runtime === RUNTIME.STOPPED;
  }
  /** Whether our own program takes orders. */
  get listens(): boolean {
    return this.isPlaying && this.slots[AT.listening] === LISTENING;
  }
  get mayMove(): boolean {
    return (
      this.robotMode === ROBOT_MODE.RUNNING &&
      (this.safetyMode === SAFETY_MODE.NORMAL || this.safetyMode === SAFETY_MODE.REDUCED)
    );
  }

  /** Drives that are off are what others know as after an emergency stop: nothing moves before a reset. */
  private get safety(): SafetyState {
    const { safetyMode } = this;
    if (EMERGENCY_STOPS.has(safetyMode)) return "emergency-stop";
    if (SAFEGUARD_STOPS.has(safetyMode)) return "guard-stop";
    if (safetyMode !== SAFETY_MODE.NORMAL && safetyMode !== SAFETY_MODE.REDUCED) return "protective-stop";
    return this.robotMode === ROBOT_MODE.RUNNING ? "normal" : "emergency-stop";
  }

  /** Fills the sample from the slots; lent. */
  read(remote: boolean, message: string): Lent {
    const { slots, sample, signals } = this;
    const n = sample.q_rad.length;
    const target_rad = sample.target_rad as Float64Array;
    sample.time_s = slots[AT.time]!;
    sample.sequence = Math.round(sample.time_s * RATE_HZ);
    let moving = false;
    for (let i = 0; i < n; i++) {
      sample.q_rad[i] = slots[AT.q + i]!;
      target_rad[i] = slots[AT.target + i]!;
      if (Math.abs(slots[AT.speed + i]!) > STANDS_RAD_S) moving = true;
    }
    sample.moving = moving;
    sample.mode = remote ? "remote" : "manual";
    sample.safety = this.safety;
    sample.override = slots[AT.fraction]!;
    sample.message = message;
    const inputs = slots[AT.inputs]!;
    const outputs = slots[AT.outputs]!;
    if (inputs !== this.inputs) {
      this.inputs = inputs;
      for (let i = 0; i < DIGITAL_LINES; i++) signals.set(`digital_in_${i}`, (inputs & (1 << i)) !== 0);
    }
    if (outputs !== this.outputs) {
      this.outputs = outputs;
      for (let i = 0; i < DIGITAL_LINES; i++) signals.set(`digital_out_${i}`, (outputs & (1 << i)) !== 0);
      sample.gripperClosed = (outputs & (1 << GRIPPER_LINE)) !== 0;
    }
    for (let i = 0; i < AT.analogue.length; i++) {
      const name = ANALOGUE_NAMES[i]!;
      const value = slots[AT.analogue[i]!]!;
      if (signals.get(name) !== value) signals.set(name, value);
    }
    return sample;
  }
}
