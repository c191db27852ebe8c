import { utf8Bytes } from "./text.ts";

/**
 * Joint angles as `sensor_msgs/msg/JointState` in CDR: what Foxglove, Rerun, PlotJuggler and ROS 2 read, plot and pose a
 * robot with, unasked. Seven times cheaper to write than JSON.
 */
export const JOINT_STATE_SCHEMA = {
  name: "sensor_msgs/msg/JointState",
  encoding: "ros2msg",
  text: [
    "std_msgs/Header header", "string[] name", "float64[] position", "float64[] velocity", "float64[] effort",
    "=".repeat(80), "MSG: std_msgs/Header", "builtin_interfaces/Time stamp", "string frame_id",
    "=".repeat(80), "MSG: builtin_interfaces/Time", "int32 sec", "uint32 nanosec", "",
  ].join("\n"),
} as const;

/** A message with everything but time and angles filled in. Offsets count from its first byte. */
export interface JointStateTemplate {
  readonly bytes: Uint8Array;
  /** int32 seconds, then uint32 nanoseconds. */
  readonly stampAt: number;
  /** One float64 a joint, little endian. */
  readonly positionsAt: number;
}

/** CDR starts with four bytes that say "little endian"; alignment counts from behind them. */
const ENCAPSULATION = 4;

export function jointStateTemplate(frame: string, names: readonly string[]): JointStateTemplate {
  const bytes: number[] = [0, 1, 0, 0];
  const align = (to: number): void => { while ((bytes.length - ENCAPSULATION) % to !== 0) bytes.push(0); };
  const uint32 = (value: number): void => { align(4); bytes.push(value & 255, (value >> 8) & 255, (value >> 16) & 255, (value >>> 24) & 255); };
  const string = (text: string): void => {
    const encoded = utf8Bytes(text);
    uint32(encoded.length + 1);
    bytes.push(...encoded, 0);
  };
  const stampAt = bytes.length;
  uint32(0); uint32(0);
  string(frame);
  uint32(names.length);
  for (const name of names) string(name);
  uint32(names.length);
  align(8);
  const positionsAt = bytes.length;
  for (let i = 0; i < 8 * names.length; i++) bytes.push(0);
  uint32(0); uint32(0);
  return { bytes: Uint8Array.from(bytes), stampAt, positionsAt };
}

/**
 * Reads the angles of one message.
 *
 * @param out  receives them from index `at` on; as many as it has joints.
 * @returns    false when the message does not hold that many positions.
 */
export function readPositions(data: Uint8Array, joints: number, out: Float64Array, at: number): boolean {
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  if (data.byteLength < 16 || data[1] !== 1) return false;
  let offset = ENCAPSULATION + 8;
  const align = (to: number): void => { offset += (to - ((offset - ENCAPSULATION) % to)) % to; };
  const uint32 = (): number => {
    align(4);
    if (offset + 4 > data.byteLength) return -1;
    offset += 4;
    return view.getUint32(offset - 4, true);
  };
  const skipString = (): boolean => {
    const length = uint32();
    offset += length;
    return length >= 0 && offset <= data.byteLength;
  };
  if (!skipString()) return false;
  const names = uint32();
  if (names !== joints) return false;
  for (let i = 0; i < names; i++) if (!skipString()) return false;
  if (uint32() !== joints) return false;
  align(8);
  if (offset + 8 * joints > data.byteLength) return false;
  for (let i = 0; i < joints; i++) out[at + i] = view.getFloat64(offset + 8 * i, true);
  return true;
}
