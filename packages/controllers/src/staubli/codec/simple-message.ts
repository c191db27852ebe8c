/**
 * simple_message as the open VAL 3 program ros_server speaks it: signed 32-bit numbers and 32-bit reals, little-endian.
 * A message is the length of what follows it, its type, how it is meant, a reply code, a body. Joint angles are
 * radians.
 */
export const MOTION_PORT = 11_000;
export const FEEDBACK_PORT = 11_002;
export const MESSAGE = { joints: 10, point: 11, status: 13, fullPoint: 14 } as const;
export const COMM = { topic: 1, request: 2, reply: 3 } as const;
export const REPLY = { none: 0, success: 1, failure: 2 } as const;
/**
 * Sequence numbers that are none. The program looks for `stop` only: the other three come with a point like any other.
 */
export const SEQUENCE = { startDownload: -1, startStreaming: -2, end: -3, stop: -4 } as const;
/** Every message has room for so many joints; those that are not there are 0. */
export const AXES = 10;

/** Body of each type that is understood [bytes]. */
const BODY: Readonly<Record<number, number>> = { 10: 44, 11: 52, 13: 28, 14: 136 };
const HEAD = 16;
const LONGEST = HEAD + 136;

export interface Point {
  sequence: number;
  readonly q_rad: Float64Array;
  /** Share of the greatest joint speeds, 0 … 1. */
  velocity: number;
  duration_s: number;
}
export const noPoint = (): Point => ({ sequence: 0, q_rad: new Float64Array(AXES), velocity: 0, duration_s: 0 });

/** `mode`: 1 by hand, 2 automatic (local or remote: it does not say which), −1 not known. */
export interface Status {
  powered: boolean;
  emergency: boolean;
  error: number;
  inError: boolean;
  moving: boolean;
  mode: number;
  possible: boolean;
}
export const noStatus = (): Status => ({
  powered: false,
  emergency: false,
  error: 0,
  inError: false,
  moving: false,
  mode: -1,
  possible: false,
});

function framed(type: number, comm: number, reply: number): { readonly bytes: Uint8Array; readonly view: DataView } {
  const bytes = new Uint8Array(HEAD + BODY[type]!);
  const view = new DataView(bytes.buffer);
  view.setInt32(0, bytes.length - 4, true);
  view.setInt32(4, type, true);
  view.setInt32(8, comm, true);
  view.setInt32(12, reply, true);
  return { bytes, view };
}

export function pointBytes({ sequence, q_rad, velocity, duration_s }: Point, comm: number, reply: number): Uint8Array {
  const { bytes, view } = framed(MESSAGE.point, comm, reply);
  view.setInt32(HEAD, sequence, true);
  for (let i = 0; i < AXES; i++) view.setFloat32(HEAD + 4 + 4 * i, q_rad[i]!, true);
  view.setFloat32(HEAD + 44, velocity, true);
  view.setFloat32(HEAD + 48, duration_s, true);
  return bytes;
}
/** @param q_rad  as many as the robot has. */
export function jointsBytes(q_rad: ArrayLike<number>): Uint8Array {
  const { bytes, view } = framed(MESSAGE.joints, COMM.topic, REPLY.none);
  for (let i = 0; i < q_rad.length; i++) view.setFloat32(HEAD + 4 + 4 * i, q_rad[i]!, true);
  return bytes;
}
export function statusBytes({ powered, emergency, error, inError, moving, mode, possible }: Status): Uint8Array {
  const { bytes, view } = framed(MESSAGE.status, COMM.topic, REPLY.none);
  [powered, emergency, error, inError, moving, mode, possible].forEach((value, i) => {
    view.setInt32(HEAD + 4 * i, Number(value), true);
  });
  return bytes;
}
/** How a full point is answered: the sequence and nothing else. */
export function fullPointReply(sequence: number, reply: number): Uint8Array {
  const { bytes, view } = framed(MESSAGE.fullPoint, COMM.reply, reply);
  view.setInt32(HEAD + 4, sequence, true);
  return bytes;
}

/**
 * One message; valid during the call only. `fits`: whether its length is the one of its type, which ros_server does not
 * look at.
 */
export interface Message {
  type: number;
  comm: number;
  reply: number;
  fits: boolean;
  readonly view: DataView;
}

export function readPoint({ view }: Message, out: Point): Point {
  out.sequence = view.getInt32(HEAD, true);
  for (let i = 0; i < AXES; i++) out.q_rad[i] = view.getFloat32(HEAD + 4 + 4 * i, true);
  out.velocity = view.getFloat32(HEAD + 44, true);
  out.duration_s = view.getFloat32(HEAD + 48, true);
  return out;
}
/**
 * A full point as ros_server reads it: number of the robot, sequence, valid fields and time all from the first word,
 * the first speed for the share.
 */
export function readFullPoint({ view }: Message, out: Point): Point {
  out.sequence = view.getInt32(HEAD, true);
  out.duration_s = view.getFloat32(HEAD, true);
  for (let i = 0; i < AXES; i++) out.q_rad[i] = view.getFloat32(HEAD + 16 + 4 * i, true);
  out.velocity = view.getFloat32(HEAD + 56, true);
  return out;
}
export function readJoints({ view }: Message, out: Float64Array): void {
  for (let i = 0; i < AXES; i++) out[i] = view.getFloat32(HEAD + 4 + 4 * i, true);
}
export function readStatus({ view }: Message, out: Status): void {
  const at = (i: number): number => view.getInt32(HEAD + 4 * i, true);
  out.powered = at(0) === 1;
  out.emergency = at(1) === 1;
  out.error = at(2);
  out.inError = at(3) === 1;
  out.moving = at(4) === 1;
  out.mode = at(5);
  out.possible = at(6) === 1;
}

/** Cuts a stream into messages, however it arrives, and holds at most one of them. One per connection. */
export class MessageReader {
  private readonly bytes = new Uint8Array(LONGEST);
  private readonly message: Message = { type: 0, comm: 0, reply: 0, fits: true, view: new DataView(this.bytes.buffer) };
  private filled = 0;
  private wanted = HEAD;

  /** @returns why the stream cannot go on, or null. Saying false from `onMessage` ends the reading. */
  push(lent: Uint8Array, onMessage: (message: Message) => boolean): string | null {
    for (let at = 0; at < lent.length; ) {
      const part = Math.min(lent.length - at, this.wanted - this.filled);
      this.bytes.set(lent.subarray(at, at + part), this.filled);
      this.filled += part;
      at += part;
      if (this.filled < this.wanted) continue;
      const { message } = this;
      const { view } = message;
      if (this.wanted === HEAD) {
        const type = view.getInt32(4, true);
        const body = BODY[type];
        if (body === undefined) return `A message of type ${type} came, which is none of the program's.`;
        message.type = type;
        message.fits = view.getInt32(0, true) === HEAD - 4 + body;
        message.comm = view.getInt32(8, true);
        message.reply = view.getInt32(12, true);
        if (message.comm < COMM.topic || message.comm > COMM.reply)
          return `A message is meant as ${message.comm}, which is neither topic nor request nor reply.`;
        this.wanted = HEAD + body;
        continue;
      }
      this.filled = 0;
      this.wanted = HEAD;
      if (!onMessage(message)) return null;
    }
    return null;
  }
}
