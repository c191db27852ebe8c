import { i32, putText, putU32, textAt, u32 } from "./bytes.ts";

/** Answer to 0x72: two words of flags. */
export interface Status {
  step: boolean;
  once: boolean;
  continuous: boolean;
  running: boolean;
  slow: boolean;
  teach: boolean;
  play: boolean;
  remote: boolean;
  heldByPendant: boolean;
  heldOutside: boolean;
  heldByCommand: boolean;
  alarm: boolean;
  error: boolean;
  servo: boolean;
}
export const STATUS_BYTES = 8;
const FIRST = ["step", "once", "continuous", "running", "slow", "teach", "play", "remote"] as const;
const SECOND = [null, "heldByPendant", "heldOutside", "heldByCommand", "alarm", "error", "servo"] as const;

export const noStatus = (): Status => ({
  step: false,
  once: false,
  continuous: false,
  running: false,
  slow: false,
  teach: false,
  play: false,
  remote: false,
  heldByPendant: false,
  heldOutside: false,
  heldByCommand: false,
  alarm: false,
  error: false,
  servo: false,
});

/** False when the data is too short; then `out` is as it was. */
export function readStatus(data: Uint8Array, out: Status): boolean {
  if (data.length < STATUS_BYTES) return false;
  const one = data[0]!;
  const two = data[4]!;
  for (let bit = 0; bit < FIRST.length; bit++) out[FIRST[bit]!] = (one & (1 << bit)) !== 0;
  for (let bit = 1; bit < SECOND.length; bit++) out[SECOND[bit]!] = (two & (1 << bit)) !== 0;
  return true;
}

export function writeStatus(status: Status): Uint8Array {
  const out = new Uint8Array(STATUS_BYTES);
  for (let bit = 0; bit < FIRST.length; bit++) if (status[FIRST[bit]!]) out[0]! |= 1 << bit;
  for (let bit = 1; bit < SECOND.length; bit++) if (status[SECOND[bit]!]) out[4]! |= 1 << bit;
  return out;
}

/** A position as 0x75 and P variables have it: pulses, or X Y Z [µm] and Rx Ry Rz Re [0.0001°]. */
export interface Position {
  type: number;
  form: number;
  tool: number;
  user: number;
  extendedForm: number;
  readonly axes: Int32Array;
}
export const POSITION_BYTES = 52;
export const AXES = 8;
export const noPosition = (): Position => ({
  type: 0,
  form: 0,
  tool: 0,
  user: 0,
  extendedForm: 0,
  axes: new Int32Array(AXES),
});

/**
 * False when the data is too short; then `out` is as it was. Older controllers leave out the last axes: those are 0.
 */
export function readPosition(data: Uint8Array, out: Position): boolean {
  if (data.length < 5 * 4 + 6 * 4) return false;
  out.type = u32(data, 0);
  out.form = u32(data, 4);
  out.tool = u32(data, 8);
  out.user = u32(data, 12);
  out.extendedForm = u32(data, 16);
  for (let i = 0; i < AXES; i++) out.axes[i] = 20 + 4 * i + 4 <= data.length ? i32(data, 20 + 4 * i) : 0;
  return true;
}

export function writePosition(position: Readonly<Position>): Uint8Array {
  const out = new Uint8Array(POSITION_BYTES);
  putU32(out, 0, position.type);
  putU32(out, 4, position.form);
  putU32(out, 8, position.tool);
  putU32(out, 12, position.user);
  putU32(out, 16, position.extendedForm);
  for (let i = 0; i < AXES; i++) putU32(out, 20 + 4 * i, position.axes[i]!);
  return out;
}

/** Answer to 0x70 and 0x71. `time` is `YYYY/MM/DD hh:mm`. */
export interface Alarm {
  readonly code: number;
  readonly data: number;
  readonly type: number;
  readonly time: string;
  readonly name: string;
}
export const ALARM_BYTES = 60;

export function writeAlarm(alarm: Alarm | undefined): Uint8Array {
  const out = new Uint8Array(ALARM_BYTES);
  if (alarm === undefined) return out;
  putU32(out, 0, alarm.code);
  putU32(out, 4, alarm.data);
  putU32(out, 8, alarm.type);
  putText(out, 12, 16, alarm.time);
  putText(out, 28, 32, alarm.name);
  return out;
}
/** Undefined when there is none, or when the answer is too short to name one. */
export function readAlarm(data: Uint8Array): Alarm | undefined {
  if (data.length < 12 || u32(data, 0) === 0) return undefined;
  return {
    code: u32(data, 0),
    data: u32(data, 4),
    type: u32(data, 8),
    time: textAt(data, 12, 16),
    name: textAt(data, 28, 32),
  };
}

/** Answer to 0x73. The override is 1 for 100 %. */
export interface ExecutingJob {
  readonly job: string;
  readonly line: number;
  readonly step: number;
  readonly override: number;
}
export const JOB_BYTES = 44;
const PER_ONE = 10_000;

export function writeJob({ job, line, step, override }: ExecutingJob): Uint8Array {
  const out = new Uint8Array(JOB_BYTES);
  putText(out, 0, 32, job);
  putU32(out, 32, line);
  putU32(out, 36, step);
  putU32(out, 40, Math.round(override * PER_ONE));
  return out;
}
export const readJob = (data: Uint8Array): ExecutingJob | undefined =>
  data.length < JOB_BYTES
    ? undefined
    : { job: textAt(data, 0, 32), line: u32(data, 32), step: u32(data, 36), override: u32(data, 40) / PER_ONE };
