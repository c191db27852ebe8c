import { compose, inverse, toUrVector, type Pose, type Robot } from "@twincell/core";
import { leadingJoint, lineNumber } from "../codec/models.ts";
import { slotOf } from "../codec/rtde-fields.ts";
import type { AdapterMotion } from "../../driver/index.ts";
import { ORDERS, REGISTERS } from "./control-program.ts";

const six = (first: number): string[] => Array.from({ length: 6 }, (_, i) => `input_double_register_${first + i}`);
/** Groups of inputs: what is written together. */
export const GROUPS = {
  heartbeat: 0,
  order: 1,
  slider: 2,
  standard: 3,
  configurable: 4,
  tool: 5,
  analogue: 6,
} as const;
export const INPUTS: readonly (readonly string[])[] = [
  [`input_int_register_${REGISTERS.heartbeat}`],
  [
    `input_int_register_${REGISTERS.order}`,
    `input_int_register_${REGISTERS.what}`,
    ...six(REGISTERS.target),
    ...six(REGISTERS.via),
    `input_double_register_${REGISTERS.speed}`,
    `input_double_register_${REGISTERS.acceleration}`,
  ],
  ["speed_slider_mask", "speed_slider_fraction"],
  ["standard_digital_output_mask", "standard_digital_output"],
  ["configurable_digital_output_mask", "configurable_digital_output"],
  ["tool_digital_output_mask", "tool_digital_output"],
  [
    "standard_analog_output_mask",
    "standard_analog_output_type",
    "standard_analog_output_0",
    "standard_analog_output_1",
  ],
];
const AT = {
  heartbeat: slotOf(`input_int_register_${REGISTERS.heartbeat}`),
  order: slotOf(`input_int_register_${REGISTERS.order}`),
  what: slotOf(`input_int_register_${REGISTERS.what}`),
  target: slotOf(`input_double_register_${REGISTERS.target}`),
  via: slotOf(`input_double_register_${REGISTERS.via}`),
  speed: slotOf(`input_double_register_${REGISTERS.speed}`),
  acceleration: slotOf(`input_double_register_${REGISTERS.acceleration}`),
  sliderMask: slotOf("speed_slider_mask"),
  slider: slotOf("speed_slider_fraction"),
} as const;
/** Whether the control box has an output of that name. */
export const isOutput = (signal: string): boolean => /out$/.test(lineNumber(signal)?.kind ?? "");
const WRAP = 1_000_000;

/**
 * Writes orders into the slots that are sent. Poses leave as the controller counts them: from its own base, with a
 * rotation vector.
 */
export class Orders {
  private readonly slots: Float64Array;
  private readonly robot: Robot;
  number = 0;

  /** @param first  a number that the program on the robot has not seen last. */
  constructor(slots: Float64Array, robot: Robot, first: number) {
    this.slots = slots;
    this.robot = robot;
    this.number = first;
    slots[AT.order] = first;
  }

  beat(): void {
    this.slots[AT.heartbeat] = (this.slots[AT.heartbeat]! + 1) % WRAP;
  }

  private next(what: number): number {
    this.number = (this.number % WRAP) + 1;
    this.slots[AT.order] = this.number;
    this.slots[AT.what] = what;
    return this.number;
  }
  private place(at: number, baseFromFlange: Pose<"base", "flange">): void {
    const { position, quaternion } = compose(inverse(this.robot.baseFromVendorWorld), baseFromFlange);
    this.slots.set(position, at);
    this.slots.set(toUrVector(quaternion), at + 3);
  }

  /** Returns the number of the order. */
  motion(motion: AdapterMotion): number {
    const { slots } = this;
    const slowest = leadingJoint(this.robot);
    const isJoints = motion.path === "joints";
    if (isJoints) slots.set(motion.q_rad, AT.target);
    else this.place(AT.target, motion.baseFromFlange);
    if (motion.path === "arc") this.place(AT.via, motion.baseFromVia);
    slots[AT.speed] = isJoints ? motion.ratio * slowest.speed_rad_s : motion.speed_mps;
    slots[AT.acceleration] = motion.acceleration * slowest.acceleration_rad_s2;
    return this.next(isJoints ? ORDERS.joints : motion.path === "line" ? ORDERS.line : ORDERS.arc);
  }
  stop(): number {
    return this.next(ORDERS.stop);
  }
  payload(mass_kg: number, [x, y, z]: readonly [number, number, number]): number {
    this.slots.set([mass_kg, x, y, z], AT.target);
    return this.next(ORDERS.payload);
  }
  slider(ratio: number): void {
    this.slots[AT.sliderMask] = 1;
    this.slots[AT.slider] = ratio;
  }

  /**
   * The group to send for that line.
   *
   * @param signal  an output; see `isOutput`.
   */
  line(signal: string, value: boolean | number): number {
    const line = lineNumber(signal)!;
    const { slots } = this;
    if (line.kind === "analogue-out") {
      slots[slotOf("standard_analog_output_mask")] = 1 << line.number;
      slots[slotOf(`standard_analog_output_${line.number}`)] = Number(value);
      return GROUPS.analogue;
    }
    const group = line.number < 8 ? "standard" : line.number < 16 ? "configurable" : "tool";
    const bit = 1 << (line.number % 8);
    slots[slotOf(`${group}_digital_output_mask`)] = bit;
    slots[slotOf(`${group}_digital_output`)] = value === true || (typeof value === "number" && value !== 0) ? bit : 0;
    return GROUPS[group];
  }
}
