import { putU16, putU32, u16, u32 } from "./bytes.ts";

/** UDP ports of the high-speed Ethernet server. */
export const ROBOT_PORT = 10_040;
export const FILE_PORT = 10_041;
export const HEADER_BYTES = 32;
/** Data of one packet: the size of a block of the plural commands and of files is chosen to stay below it. */
export const MAX_DATA_BYTES = 479;
/** Set in the number of the last, or only, block of an answer and of a file. */
export const LAST_BLOCK = 0x8000_0000;
export const DIVISION = { robot: 1, file: 2 } as const;
export type Division = (typeof DIVISION)[keyof typeof DIVISION];

/** What is asked, or a block of a file, or the acknowledgement of one (`ack`). */
export interface HsesRequest {
  readonly division: Division;
  readonly ack: boolean;
  /** Chosen by who asks, 0 … 255; the answer repeats it. */
  readonly id: number;
  readonly block: number;
  readonly command: number;
  readonly instance: number;
  readonly attribute: number;
  readonly service: number;
  readonly data: Uint8Array;
}
export interface HsesReply {
  readonly division: Division;
  readonly id: number;
  readonly block: number;
  /** Of the request, without the bit of answers. */
  readonly service: number;
  /** 0 is well. */
  readonly status: number;
  /** Why not, when `status` is not 0. */
  readonly added: number;
  readonly data: Uint8Array;
}

/** The packet, or one sentence with the controller's own code for that flaw of a header. */
export type ReadPacket<T> =
  | { readonly kind: "packet"; readonly packet: T }
  | { readonly kind: "flawed"; readonly added: number; readonly sentence: string };

const MARK = [0x59, 0x45, 0x52, 0x43] as const; // YERC
const NINE = 0x39;
const RESERVED = 3;
const ANSWER = 0x80;

function writeHeader(out: Uint8Array, division: number, ack: number, id: number, block: number, size: number): void {
  out.set(MARK, 0);
  putU16(out, 4, HEADER_BYTES);
  putU16(out, 6, size);
  out[8] = RESERVED;
  out[9] = division;
  out[10] = ack;
  out[11] = id;
  putU32(out, 12, block);
  out.fill(NINE, 16, 24);
}

/** Writes a request into the caller's bytes (at least header and data) and returns how many it takes. */
export function writeRequest(request: HsesRequest, out: Uint8Array): number {
  const { data } = request;
  writeHeader(out, request.division, request.ack ? 1 : 0, request.id, request.block, data.length);
  putU16(out, 24, request.command);
  putU16(out, 26, request.instance);
  out[28] = request.attribute;
  out[29] = request.service;
  out[30] = 0;
  out[31] = 0;
  out.set(data, HEADER_BYTES);
  return HEADER_BYTES + data.length;
}

/** Writes an answer; the added status takes one word when there is one. */
export function writeReply(reply: HsesReply, out: Uint8Array): number {
  const { data } = reply;
  writeHeader(out, reply.division, 1, reply.id, reply.block, data.length);
  out[24] = reply.service | ANSWER;
  out[25] = reply.status;
  out[26] = reply.added === 0 ? 0 : 1;
  out[27] = 0;
  putU16(out, 28, reply.added);
  putU16(out, 30, 0);
  out.set(data, HEADER_BYTES);
  return HEADER_BYTES + data.length;
}

const flawed = (
  added: number,
  sentence: string,
): { readonly kind: "flawed"; readonly added: number; readonly sentence: string } => ({
  kind: "flawed",
  added,
  sentence,
});

function headerFlaw(bytes: Uint8Array): ReturnType<typeof flawed> | undefined {
  if (bytes.length < HEADER_BYTES)
    return flawed(0xe49d, `A packet of ${bytes.length} bytes is shorter than its header of ${HEADER_BYTES}.`);
  if (MARK.some((letter, i) => bytes[i] !== letter)) return flawed(0xe4a6, "The packet does not begin with YERC.");
  if (u16(bytes, 4) !== HEADER_BYTES)
    return flawed(0xe49d, `The header says it has ${u16(bytes, 4)} bytes; it has ${HEADER_BYTES}.`);
  const size = u16(bytes, 6);
  if (size > MAX_DATA_BYTES || size !== bytes.length - HEADER_BYTES)
    return flawed(0xe4a7, `The header says ${size} bytes of data; ${bytes.length - HEADER_BYTES} came.`);
  if (bytes[9] !== DIVISION.robot && bytes[9] !== DIVISION.file)
    return flawed(0xe4a3, `There is no division ${bytes[9]}.`);
  if (bytes[10]! > 1) return flawed(0xe4a2, `The acknowledgement is 0 or 1, not ${bytes[10]}.`);
  return undefined;
}

/** Reads what a controller receives. `data` of the packet is a view into `bytes`. */
export function readRequest(bytes: Uint8Array): ReadPacket<HsesRequest> {
  const flaw = headerFlaw(bytes);
  if (flaw !== undefined) return flaw;
  const ack = bytes[10] === 1;
  const block = u32(bytes, 12);
  if (!ack && block !== 0) return flawed(0xe4a1, `A request has block number 0, not ${block}.`);
  return {
    kind: "packet",
    packet: {
      division: bytes[9] as Division,
      ack,
      id: bytes[11]!,
      block,
      command: u16(bytes, 24),
      instance: u16(bytes, 26),
      attribute: bytes[28]!,
      service: bytes[29]!,
      data: bytes.subarray(HEADER_BYTES),
    },
  };
}

/** Reads what a controller answers. `data` of the packet is a view into `bytes`. */
export function readReply(bytes: Uint8Array): ReadPacket<HsesReply> {
  const flaw = headerFlaw(bytes);
  if (flaw !== undefined) return flaw;
  if (bytes[10] !== 1) return flawed(0xe4a2, "The packet is a question, not an answer.");
  if ((bytes[24]! & ANSWER) === 0) return flawed(0xe49d, "The packet is no answer to any service.");
  return {
    kind: "packet",
    packet: {
      division: bytes[9] as Division,
      id: bytes[11]!,
      block: u32(bytes, 12),
      service: bytes[24]! & ~ANSWER,
      status: bytes[25]!,
      added: bytes[26] === 0 ? 0 : u16(bytes, 28),
      data: bytes.subarray(HEADER_BYTES),
    },
  };
}
