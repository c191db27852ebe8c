/**
 * C3 Bridge Interface, a superset of KUKAVARPROXY: TCP 7000, big-endian numbers. Every message is
 *
 *     u16 tag | u16 bytes after this field | u8 type | payload [| u16 error | u8 success]   (the last two in replies)
 *
 * and a reply carries its request's tag. Texts of types 0 and 1 are Latin-1, all others UTF-16LE with their length in
 * characters. Source: C3 Bridge Interface protocol specification 1.3 to 1.5 (Ulyanovsk State University); KUKAVARPROXY
 * itself knows types 0 and 1.
 */
export const C3_PORT = 7000;

export const C3_TYPE = {
  readAscii: 0,
  writeAscii: 1,
  read: 4,
  write: 5,
  readMany: 6,
  writeMany: 7,
  control: 10,
  info: 13,
  features: 14,
  fileCreate: 22,
  fileDelete: 23,
  fileWrite: 29,
  fileRead: 30,
  confirmAll: 63,
} as const;
/** The greatest type that the specification gives a name, and the one it keeps for extensions. */
const LAST_NAMED_TYPE = 66;
const EXTENDED_TYPE = 255;
const RESERVED_TYPES: readonly (readonly [number, number])[] = [
  [8, 9],
  [18, 19],
  [31, 49],
  [67, 254],
];
/** Whether the specification names that type at all, whoever can do it. */
export const isC3Type = (type: number): boolean =>
  (type <= LAST_NAMED_TYPE || type === EXTENDED_TYPE) &&
  !RESERVED_TYPES.some(([from, to]) => type >= from && type <= to);

export const C3_ERROR = {
  general: 0,
  success: 1,
  access: 2,
  argument: 3,
  memory: 4,
  pointer: 5,
  unexpected: 6,
  notImplemented: 7,
  noInterface: 8,
  protocol: 9,
  longAnswer: 10,
} as const;
const ERROR_WORDS = [
  "the controller did not do it",
  "done",
  "access was denied",
  "a value does not fit",
  "the controller has no memory left",
  "a pointer was empty",
  "something unexpected happened",
  "this controller cannot do that",
  "there is no such interface",
  "the message is not well formed",
  "the answer does not fit into one message",
] as const;
export const c3ErrorWords = (code: number): string => ERROR_WORDS[code] ?? `error ${code}`;

export const C3_COMMAND = { reset: 1, start: 2, stop: 3, cancel: 4, select: 5, run: 6 } as const;
export const FILE_STEP = { begin: 1, data: 2, size: 3, end: 4 } as const;

const HEADER = 4;
const MOST = 0xffff;
/** Most bytes of one message: the length field says no more. */
export const C3_MAX_BYTES = HEADER + MOST;

/**
 * Cuts a stream into messages, however it arrives. Holds at most one message. One per connection.
 */
export class C3Reader {
  private readonly buffer = new Uint8Array(C3_MAX_BYTES);
  private filled = 0;
  /** Whether a message has begun that is not complete. */
  get partial(): boolean {
    return this.filled > 0;
  }

  /**
   * @param lent     only read during the call.
   * @param onFrame  tag, type and payload of every message that is complete; the payload is only valid during the call.
   *                 Saying false ends the reading.
   * @returns why the stream cannot go on, or null.
   */
  push(lent: Uint8Array, onFrame: (tag: number, type: number, payload: Uint8Array) => boolean): string | null {
    const { buffer } = this;
    for (let at = 0; at < lent.length; ) {
      const wanted = this.filled < HEADER ? HEADER : HEADER + ((buffer[2]! << 8) | buffer[3]!);
      const count = Math.min(wanted - this.filled, lent.length - at);
      for (let i = 0; i < count; i++) buffer[this.filled + i] = lent[at + i]!;
      this.filled += count;
      at += count;
      if (this.filled < HEADER) return null;
      const length = (buffer[2]! << 8) | buffer[3]!;
      if (length === 0) return "A message of length 0 came, without a type.";
      if (this.filled < HEADER + length) continue;
      this.filled = 0;
      if (!onFrame((buffer[0]! << 8) | buffer[1]!, buffer[HEADER]!, buffer.subarray(HEADER + 1, HEADER + length)))
        return null;
    }
    return null;
  }
}

/** Writes one message after the other into the same bytes. `take` lends them until the next `begin`. */
export class C3Writer {
  private readonly bytes = new Uint8Array(C3_MAX_BYTES);
  private at = 0;
  private tooLong = false;

  begin(tag: number, type: number): this {
    this.at = 0;
    this.tooLong = false;
    return this.u16(tag).u16(0).u8(type);
  }
  u8(value: number): this {
    if (this.at >= C3_MAX_BYTES) this.tooLong = true;
    else this.bytes[this.at++] = value;
    return this;
  }
  u16(value: number): this {
    return this.u8(value >>> 8).u8(value);
  }
  u32(value: number): this {
    return this.u16(value >>> 16).u16(value);
  }
  raw(data: Uint8Array): this {
    for (const value of data) this.u8(value);
    return this;
  }
  /** Length and text; Latin-1 where `wide` is false: what it has no character for becomes a question mark. */
  text(value: string, wide: boolean): this {
    if (value.length > MOST) this.tooLong = true;
    this.u16(value.length);
    for (let i = 0; i < value.length; i++) {
      const code = value.charCodeAt(i);
      if (wide) this.u8(code).u8(code >>> 8);
      else this.u8(code > 0xff ? 0x3f : code);
    }
    return this;
  }
  footer(error: number): this {
    return this.u16(error).u8(error === C3_ERROR.success ? 1 : 0);
  }
  /** Null when it does not fit into one message. */
  take(): Uint8Array | null {
    if (this.tooLong) return null;
    const length = this.at - HEADER;
    this.bytes[2] = length >>> 8;
    this.bytes[3] = length;
    return this.bytes.subarray(0, this.at);
  }
}

/** Reads a payload field by field; beyond its end everything is empty and `short` says so. */
export class C3Fields {
  private readonly bytes: Uint8Array;
  private at = 0;
  short = false;
  constructor(bytes: Uint8Array) {
    this.bytes = bytes;
  }
  get left(): number {
    return this.bytes.length - this.at;
  }
  u8(): number {
    if (this.at >= this.bytes.length) {
      this.short = true;
      return 0;
    }
    return this.bytes[this.at++]!;
  }
  u16(): number {
    return (this.u8() << 8) | this.u8();
  }
  u32(): number {
    return this.u16() * 0x10000 + this.u16();
  }
  /** Lent: a view of the payload. */
  raw(count: number): Uint8Array {
    if (count > this.left) {
      this.short = true;
      return new Uint8Array();
    }
    return this.bytes.subarray(this.at, (this.at += count));
  }
  text(wide: boolean): string {
    const length = this.u16();
    if (length * (wide ? 2 : 1) > this.left) {
      this.short = true;
      return "";
    }
    let text = "";
    for (let i = 0; i < length; i++) text += String.fromCharCode(wide ? this.u8() | (this.u8() << 8) : this.u8());
    return text;
  }
  /** Everything was there, and nothing more. */
  get whole(): boolean {
    return !this.short && this.left === 0;
  }
}
