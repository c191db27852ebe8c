import { C3_ERROR, C3_TYPE, C3Fields, FILE_STEP, type C3Writer } from "./c3.ts";

/** One of several variables: its own error code, and its value as text. */
export interface C3Item {
  readonly error: number;
  readonly value: string;
}
/** What a controller answers. `error` is 1 where it went well. */
export type C3Reply =
  | { readonly kind: "value"; readonly value: string; readonly error: number }
  | { readonly kind: "values"; readonly items: readonly C3Item[]; readonly error: number }
  | { readonly kind: "control"; readonly command: number; readonly error: number }
  | {
      readonly kind: "file";
      readonly step: number;
      readonly offset: number;
      readonly size: number;
      readonly data: Uint8Array;
      readonly error: number;
    }
  | { readonly kind: "features"; readonly types: readonly number[]; readonly error: number }
  | {
      readonly kind: "info";
      readonly version: readonly [number, number, number];
      readonly host: string;
      readonly error: number;
    }
  /** No more than the error code. */
  | { readonly kind: "plain"; readonly error: number }
  | { readonly kind: "malformed" };

/**
 * One message into `out`; where it does not fit, error 10 in its place. The bytes are lent until `out` is used again.
 */
export function writeC3Reply(
  out: C3Writer,
  tag: number,
  type: number,
  reply: Exclude<C3Reply, { readonly kind: "malformed" }>,
): Uint8Array {
  const wide = type !== C3_TYPE.readAscii && type !== C3_TYPE.writeAscii;
  out.begin(tag, type);
  switch (reply.kind) {
    case "value":
      out.text(reply.value, wide);
      break;
    case "values":
      out.u8(reply.items.length);
      for (const { error, value } of reply.items) out.u8(error).text(value, true);
      break;
    case "control":
      out.u8(reply.command);
      break;
    case "file":
      out.u8(reply.step);
      if (reply.step === FILE_STEP.data) out.u32(reply.offset).u32(reply.size);
      else if (reply.step !== FILE_STEP.end) out.u32(reply.size);
      out.raw(reply.data);
      break;
    case "features": {
      const field = new Uint8Array(32);
      for (const each of reply.types) field[31 - (each >> 3)]! |= 1 << (each & 7);
      out.raw(field);
      break;
    }
    case "info":
      out.u8(reply.version[0]).u8(reply.version[1]).u8(reply.version[2]);
      // The time of day is left empty: a virtual controller knows none.
      for (let i = 0; i < 8; i++) out.u16(0);
      out.text(reply.host, true);
      break;
    case "plain":
      break;
  }
  return out.footer(reply.error).take() ?? out.begin(tag, type).footer(C3_ERROR.longAnswer).take()!;
}

/** Footer of every reply. */
const FOOTER = 3;

/** @param payload  what follows the type; data of a file stays a view of it. */
export function readC3Reply(type: number, payload: Uint8Array): C3Reply {
  if (payload.length < FOOTER) return { kind: "malformed" };
  const end = payload.length - FOOTER;
  const error = (payload[end]! << 8) | payload[end + 1]!;
  const ok = payload[end + 2]! !== 0;
  const from = new C3Fields(payload.subarray(0, end));
  if (ok !== (error === C3_ERROR.success)) return { kind: "malformed" };
  // An error may come with nothing in front of it.
  const reply = end === 0 ? ({ kind: "plain", error } as const) : bodyOf(type, from, error);
  return from.whole ? reply : { kind: "malformed" };
}

function bodyOf(type: number, from: C3Fields, error: number): C3Reply {
  switch (type) {
    case C3_TYPE.readAscii:
    case C3_TYPE.writeAscii:
      return { kind: "value", value: from.text(false), error };
    case C3_TYPE.read:
    case C3_TYPE.write:
      return { kind: "value", value: from.text(true), error };
    case C3_TYPE.readMany:
    case C3_TYPE.writeMany: {
      const items: C3Item[] = [];
      const count = from.u8();
      for (let i = 0; i < count && !from.short; i++) items.push({ error: from.u8(), value: from.text(true) });
      return { kind: "values", items, error };
    }
    case C3_TYPE.control:
      return { kind: "control", command: from.u8(), error };
    case C3_TYPE.features: {
      const types: number[] = [];
      const field = from.raw(32);
      for (let each = 0; each < 256; each++)
        if (((field[31 - (each >> 3)] ?? 0) >> (each & 7)) % 2 === 1) types.push(each);
      return { kind: "features", types, error };
    }
    case C3_TYPE.info: {
      const version = [from.u8(), from.u8(), from.u8()] as const;
      from.raw(16);
      return { kind: "info", version, host: from.text(true), error };
    }
    case C3_TYPE.fileWrite:
    case C3_TYPE.fileRead: {
      const step = from.u8();
      const offset = step === FILE_STEP.data ? from.u32() : 0;
      const size = step === FILE_STEP.end ? 0 : from.u32();
      return {
        kind: "file",
        step,
        offset,
        size,
        data: type === C3_TYPE.fileRead && step === FILE_STEP.data ? from.raw(size) : new Uint8Array(),
        error,
      };
    }
    default:
      return { kind: "malformed" };
  }
}
