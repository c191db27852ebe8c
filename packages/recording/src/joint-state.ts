import { utf8Bytes } from "./text.ts";

/**
 * Joint angles as `sensor_msgs/msg/JointState` in CDR: what Foxglove, Rerun, PlotJuggler and ROS 2 read, plot and pose
 * a robot with, unasked. Seven times cheaper to write than JSON.
 */
export const JOINT_STATE_SCHEMA = {
  name: "sensor_msgs/msg/JointState",
  encoding: "ros2msg",
  text: [
    "std_msgs/Header header",
    "string[] name",
    "float64[] position",
    "float64[] velocity",
    "float64[] effort",
    "=".repeat(80),
    "MSG: std_msgs/Header",
    "builtin_interfaces/Time stamp",
    "string frame_id",
    "=".repeat(80),
    "MSG: builtin_interfaces/Time",
    "int32 sec",
    "uint32 nanosec",
    "",
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
  const align = (to: number): void => {
    while ((bytes.length - ENCAPSULATION) % to !== 0) bytes.push(0);
  };
  const uint32 = (value: number): void => {
    align(4);
    bytes.push(value & 255, (value >> 8) & 255, (value >> 16) & 255, (value >>> 24) & 255);
  };
  const string = (text: string): void => {
    const encoded = utf8Bytes(text);
    uint32(encoded.length + 1);
    bytes.push(...encoded, 0);
  };
  const stampAt = bytes.length;
  uint32(0);
  uint32(0);
  string(frame);
  uint32(names.length);
  for (const name of names) string(name);
  uint32(names.length);
  align(8);
  const positionsAt = bytes.length;
  for (let i = 0; i < 8 * names.length; i++) bytes.push(0);
  uint32(0);
  uint32(0);
  return { bytes: Uint8Array.from(bytes), stampAt, positionsAt };
}

/**
 * Where the positions of a message begin, counted from its first byte: one float64 a joint, little endian.
 *
 * @param view  holds the message from byte `from` to before byte `until`.
 * @returns     -1 when the message does not hold that many positions.
 */
export function positionsOffset(view: DataView, from: number, until: number, joints: number): number {
  if (until - from < 16 || view.getUint8(from + 1) !== 1) return -1;
  const body = from + ENCAPSULATION;
  let offset = skipString(view, body, body + 8, until);
  const names = uint32At(view, body, offset, until);
  if (names !== joints) return -1;
  offset = aligned(body, offset, 4) + 4;
  for (let i = 0; i < names; i++) offset = skipString(view, body, offset, until);
  if (uint32At(view, body, offset, until) !== joints) return -1;
  offset = aligned(body, aligned(body, offset, 4) + 4, 8);
  return offset + 8 * joints <= until ? offset - from : -1;
}

const aligned = (body: number, offset: number, to: number): number => offset + ((to - ((offset - body) % to)) % to);
/** The next number, or -1 behind the end. */
function uint32At(view: DataView, body: number, offset: number, until: number): number {
  const at = aligned(body, offset, 4);
  return at + 4 <= until ? view.getUint32(at, true) : -1;
}
/** Where the next string ends; behind the end when it does not fit. */
function skipString(view: DataView, body: number, offset: number, until: number): number {
  const length = uint32At(view, body, offset, until);
  const end = aligned(body, offset, 4) + 4 + length;
  return length >= 0 && end <= until ? end : until + 1;
}
