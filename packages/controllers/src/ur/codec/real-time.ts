import { INPUT_FIELDS, OUTPUT_FIELDS } from "./rtde-fields.ts";
import { viewOf } from "./rtde.ts";

/**
 * The package of the real-time interface (port 30003) since software 5.10: `int32 size`, then big-endian doubles, whole
 * numbers among them. Names are those of RTDE for the same number; what the vendor keeps to itself has none and is 0.
 * The lengths of the shorter packages before (1060, 1108, 1116 and 1140 bytes) end where this one's parts end.
 */
const PARTS: readonly (readonly [name: string | null, count: number])[] = [
  ["timestamp", 1],
  ["target_q", 6],
  ["target_qd", 6],
  ["target_qdd", 6],
  ["target_current", 6],
  ["target_moment", 6],
  ["actual_q", 6],
  ["actual_qd", 6],
  ["actual_current", 6],
  ["joint_control_output", 6],
  ["actual_TCP_pose", 6],
  ["actual_TCP_speed", 6],
  ["actual_TCP_force", 6],
  ["target_TCP_pose", 6],
  ["target_TCP_speed", 6],
  ["actual_digital_input_bits", 1],
  ["joint_temperatures", 6],
  ["actual_execution_time", 1],
  [null, 1],
  ["robot_mode", 1],
  ["joint_mode", 6],
  ["safety_mode", 1],
  [null, 6],
  ["actual_tool_accelerometer", 3],
  [null, 6],
  ["speed_scaling", 1],
  ["actual_momentum", 1],
  [null, 2],
  ["actual_main_voltage", 1],
  ["actual_robot_voltage", 1],
  ["actual_robot_current", 1],
  ["actual_joint_voltage", 6],
  ["actual_digital_output_bits", 1],
  ["runtime_state", 1],
  ["elbow_position", 3],
  ["elbow_velocity", 3],
  ["safety_status", 1],
  [null, 3],
  ["payload", 1],
  ["payload_cog", 3],
  ["payload_inertia", 6],
];
const SIZE_BYTES = 4;
const NUMBER_BYTES = 8;

/** Where each number of the package is found among the controller's variables; −1 where it is not. */
const SLOTS = Int32Array.from(
  PARTS.flatMap(([name, count]) => {
    const field = name === null ? undefined : (OUTPUT_FIELDS.get(name) ?? INPUT_FIELDS.get(name));
    return Array.from({ length: count }, (_, i) => (field ? field.slot + i : -1));
  }),
);
export const REAL_TIME_BYTES = SIZE_BYTES + NUMBER_BYTES * SLOTS.length;

/** Writes packages into one buffer, which is lent until the next. Allocates nothing. */
export function realTimeWriter(): (slots: Float64Array) => Uint8Array {
  const bytes = new Uint8Array(REAL_TIME_BYTES);
  const view = viewOf(bytes);
  view.setInt32(0, REAL_TIME_BYTES);
  return slots => {
    for (let i = 0; i < SLOTS.length; i++) {
      const slot = SLOTS[i]!;
      view.setFloat64(SIZE_BYTES + NUMBER_BYTES * i, slot < 0 ? 0 : slots[slot]!);
    }
    return bytes;
  };
}
