/**
 * The variables of RTDE that are spoken here, with their types. Every number of a variable has a slot in one array, so
 * that a package is packed and read without an object per field. Bits of 64 are kept as numbers: only the lower 18 are
 * in use.
 */
export type FieldType =
  | "BOOL"
  | "UINT8"
  | "UINT32"
  | "INT32"
  | "UINT64"
  | "DOUBLE"
  | "VECTOR3D"
  | "VECTOR6D"
  | "VECTOR6INT32"
  | "VECTOR6UINT32";
export interface Field {
  readonly name: string;
  readonly type: FieldType;
  /** First of its numbers in an array of all slots. */
  readonly slot: number;
}

/** What a type takes on the wire, and how many numbers it is. */
export const SHAPES: Readonly<
  Record<
    FieldType,
    { readonly bytes: number; readonly numbers: number; readonly each: "u8" | "u32" | "i32" | "u64" | "f64" }
  >
> = {
  BOOL: { bytes: 1, numbers: 1, each: "u8" },
  UINT8: { bytes: 1, numbers: 1, each: "u8" },
  UINT32: { bytes: 4, numbers: 1, each: "u32" },
  INT32: { bytes: 4, numbers: 1, each: "i32" },
  UINT64: { bytes: 8, numbers: 1, each: "u64" },
  DOUBLE: { bytes: 8, numbers: 1, each: "f64" },
  VECTOR3D: { bytes: 24, numbers: 3, each: "f64" },
  VECTOR6D: { bytes: 48, numbers: 6, each: "f64" },
  VECTOR6INT32: { bytes: 24, numbers: 6, each: "i32" },
  VECTOR6UINT32: { bytes: 24, numbers: 6, each: "u32" },
};

const words = (text: string): string[] => text.trim().split(/\s+/);
const OUTPUTS: readonly (readonly [FieldType, string])[] = [
  [
    "VECTOR6D",
    `target_q target_qd target_qdd target_current target_moment actual_q actual_qd actual_current joint_control_output actual_TCP_pose actual_TCP_speed
    actual_TCP_force target_TCP_pose target_TCP_speed joint_temperatures actual_joint_voltage tcp_offset ft_raw_wrench payload_inertia actual_current_as_torque`,
  ],
  ["VECTOR6INT32", "joint_mode"],
  ["UINT64", "actual_digital_input_bits actual_digital_output_bits"],
  ["INT32", "robot_mode safety_mode safety_status tool_output_voltage"],
  [
    "UINT32",
    "runtime_state robot_status_bits safety_status_bits analog_io_types tool_mode script_control_line output_bit_registers0_to_31 output_bit_registers32_to_63",
  ],
  ["VECTOR3D", "actual_tool_accelerometer elbow_position elbow_velocity payload_cog"],
  [
    "DOUBLE",
    `timestamp speed_scaling target_speed_fraction actual_momentum actual_main_voltage actual_robot_voltage actual_robot_current actual_execution_time standard_analog_input0
    standard_analog_input1 standard_analog_output0 standard_analog_output1 tool_analog_input0 tool_analog_input1 tool_temperature tool_output_current payload`,
  ],
];
const INPUTS: readonly (readonly [FieldType, string])[] = [
  ["UINT32", "speed_slider_mask input_bit_registers0_to_31 input_bit_registers32_to_63"],
  ["DOUBLE", "speed_slider_fraction standard_analog_output_0 standard_analog_output_1"],
  [
    "UINT8",
    `standard_digital_output_mask configurable_digital_output_mask tool_digital_output_mask standard_digital_output configurable_digital_output tool_digital_output
    standard_analog_output_mask standard_analog_output_type`,
  ],
  ["VECTOR6D", "external_force_torque"],
];
/** Registers of each kind; 24 … 47 are for clients of RTDE, 0 … 23 for fieldbuses. */
export const REGISTERS = 48;
const registers = (side: "input" | "output"): (readonly [FieldType, string])[] => [
  ["INT32", Array.from({ length: REGISTERS }, (_, i) => `${side}_int_register_${i}`).join(" ")],
  ["DOUBLE", Array.from({ length: REGISTERS }, (_, i) => `${side}_double_register_${i}`).join(" ")],
  ["BOOL", Array.from({ length: 64 }, (_, i) => `${side}_bit_register_${i + 64}`).join(" ")],
];

let slots = 0;
function laidOut(groups: readonly (readonly [FieldType, string])[]): Field[] {
  return groups.flatMap(([type, names]) =>
    words(names).map(name => {
      const field = { name, type, slot: slots };
      slots += SHAPES[type].numbers;
      return field;
    }),
  );
}
const outputs = laidOut([...OUTPUTS, ...registers("output")]);
const inputs = laidOut([...INPUTS, ...registers("input")]);
const byName = (fields: readonly Field[]): ReadonlyMap<string, Field> =>
  new Map(fields.map(field => [field.name, field]));

/** What a client can write. */
export const INPUT_FIELDS = byName(inputs);
/** What a client can read: inputs that were written can be read back. */
export const OUTPUT_FIELDS = byName([...outputs, ...inputs.filter(({ name }) => name.startsWith("input_"))]);
/** An array of this length holds every variable. */
export const SLOTS = slots;

/** The slot of a variable that is known to exist. */
export function slotOf(name: string): number {
  const field = OUTPUT_FIELDS.get(name) ?? INPUT_FIELDS.get(name);
  if (!field) throw new RangeError(`RTDE has no variable "${name}" here.`);
  return field.slot;
}
