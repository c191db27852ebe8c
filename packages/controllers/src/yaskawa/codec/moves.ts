import { i32, putText, putU32, textAt, u32 } from "./bytes.ts";
import { AXES } from "./state.ts";

/** Data of 0x8B: pulses. */
export interface PulseMove {
  readonly robot: number;
  readonly station: number;
  readonly speedClass: number;
  readonly speed: number;
  readonly axes: ArrayLike<number>;
  readonly tool: number;
}
export const PULSE_MOVE_BYTES = 88;

export function writePulseMove({ robot, station, speedClass, speed, axes, tool }: PulseMove): Uint8Array {
  const out = new Uint8Array(PULSE_MOVE_BYTES);
  putU32(out, 0, robot);
  putU32(out, 4, station);
  putU32(out, 8, speedClass);
  putU32(out, 12, speed);
  for (let i = 0; i < AXES; i++) putU32(out, 16 + 4 * i, axes[i] ?? 0);
  putU32(out, 48, tool);
  return out;
}

/** Fields of fixed places; undefined when the data is too short for the axes and the tool. */
export function readPulseMove(data: Uint8Array): PulseMove | undefined {
  if (data.length < 52) return undefined;
  return {
    robot: u32(data, 0),
    station: u32(data, 4),
    speedClass: u32(data, 8),
    speed: u32(data, 12),
    axes: Int32Array.from({ length: AXES }, (_, i) => i32(data, 16 + 4 * i)),
    tool: u32(data, 48),
  };
}

/** Data of 0x8A: X Y Z [µm] and Rx Ry Rz [0.0001°] in a frame, with the posture that reaches them. */
export interface CartesianMove {
  readonly robot: number;
  readonly station: number;
  readonly speedClass: number;
  readonly speed: number;
  readonly frame: number;
  /** X, Y, Z, Rx, Ry, Rz, Re. */
  readonly place: ArrayLike<number>;
  readonly form: number;
  readonly extendedForm: number;
  readonly tool: number;
  readonly user: number;
}
export const CARTESIAN_MOVE_BYTES = 104;
const PLACES = 7;

export function writeCartesianMove(move: CartesianMove): Uint8Array {
  const out = new Uint8Array(CARTESIAN_MOVE_BYTES);
  putU32(out, 0, move.robot);
  putU32(out, 4, move.station);
  putU32(out, 8, move.speedClass);
  putU32(out, 12, move.speed);
  putU32(out, 16, move.frame);
  for (let i = 0; i < PLACES; i++) putU32(out, 20 + 4 * i, move.place[i] ?? 0);
  putU32(out, 52, move.form);
  putU32(out, 56, move.extendedForm);
  putU32(out, 60, move.tool);
  putU32(out, 64, move.user);
  return out;
}

export function readCartesianMove(data: Uint8Array): CartesianMove | undefined {
  if (data.length < 68) return undefined;
  return {
    robot: u32(data, 0),
    station: u32(data, 4),
    speedClass: u32(data, 8),
    speed: u32(data, 12),
    frame: u32(data, 16),
    place: Int32Array.from({ length: PLACES }, (_, i) => i32(data, 20 + 4 * i)),
    form: u32(data, 52),
    extendedForm: u32(data, 56),
    tool: u32(data, 60),
    user: u32(data, 64),
  };
}

/** Data of 0x87: the job without .JBI, and the line it begins with. */
export function writeSelection(job: string, line = 0): Uint8Array {
  const out = new Uint8Array(36);
  putText(out, 0, 32, job);
  putU32(out, 32, line);
  return out;
}
export const readSelection = (data: Uint8Array): { readonly job: string; readonly line: number } | undefined =>
  data.length < 36 ? undefined : { job: textAt(data, 0, 32), line: u32(data, 32) };

/** The single word that switches take. */
export function word(value: number): Uint8Array {
  const out = new Uint8Array(4);
  putU32(out, 0, value);
  return out;
}
