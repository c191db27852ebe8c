import { C3_COMMAND, C3_TYPE, C3Fields, FILE_STEP, type C3Writer } from "./c3.ts";

/** What a client asks for. Interpreter 0 is the submit interpreter, 1 the robot's. */
export type C3Request =
  | { readonly kind: "read"; readonly wide: boolean; readonly name: string }
  | { readonly kind: "write"; readonly wide: boolean; readonly name: string; readonly value: string }
  | { readonly kind: "read-many"; readonly names: readonly string[] }
  | { readonly kind: "write-many"; readonly pairs: readonly Assignment[] }
  | { readonly kind: "control"; readonly command: number; readonly interpreter: number }
  | {
      readonly kind: "select";
      readonly run: boolean;
      readonly name: string;
      readonly parameters: string;
      readonly force: boolean;
    }
  | { readonly kind: "info" }
  | { readonly kind: "features" }
  | { readonly kind: "confirm-all" }
  | { readonly kind: "file-create"; readonly name: string }
  | { readonly kind: "file-delete"; readonly name: string }
  | { readonly kind: "put-begin"; readonly size: number }
  | { readonly kind: "put-size" }
  | { readonly kind: "put-data"; readonly offset: number; readonly data: Uint8Array }
  | { readonly kind: "put-end"; readonly flags: number; readonly name: string }
  | { readonly kind: "get-begin"; readonly name: string }
  | { readonly kind: "get-size" }
  | { readonly kind: "get-data"; readonly offset: number; readonly most: number }
  | { readonly kind: "get-end" }
  /** A type that the specification names and this codec does not know, or one that nobody knows. */
  | { readonly kind: "unknown"; readonly type: number }
  | { readonly kind: "malformed"; readonly type: number };
export interface Assignment {
  readonly name: string;
  readonly value: string;
}

/** Copy flag of a file that is there already: overwrite it. */
export const OVERWRITE = 64;
const MODULE = 32;
const SOURCE_AND_DATA = 6;

/** One message into `out`; null when it does not fit into one. The bytes are lent until `out` is used again. */
export function writeC3Request(
  out: C3Writer,
  tag: number,
  request: Exclude<C3Request, { readonly kind: "malformed" }>,
): Uint8Array | null {
  switch (request.kind) {
    case "read":
      return out
        .begin(tag, request.wide ? C3_TYPE.read : C3_TYPE.readAscii)
        .text(request.name, request.wide)
        .take();
    case "write":
      return out
        .begin(tag, request.wide ? C3_TYPE.write : C3_TYPE.writeAscii)
        .text(request.name, request.wide)
        .text(request.value, request.wide)
        .take();
    case "read-many":
      if (request.names.length > 0xff) return null;
      out.begin(tag, C3_TYPE.readMany).u8(request.names.length);
      for (const name of request.names) out.text(name, true);
      return out.take();
    case "write-many":
      if (request.pairs.length > 0xff) return null;
      out.begin(tag, C3_TYPE.writeMany).u8(request.pairs.length);
      for (const { name, value } of request.pairs) out.text(name, true).text(value, true);
      return out.take();
    case "control":
      return out.begin(tag, C3_TYPE.control).u8(request.command).u16(request.interpreter).take();
    case "select":
      return out
        .begin(tag, C3_TYPE.control)
        .u8(request.run ? C3_COMMAND.run : C3_COMMAND.select)
        .u16(1)
        .text(request.name, true)
        .text(request.parameters, true)
        .u8(request.force ? 1 : 0)
        .take();
    case "info":
      return out.begin(tag, C3_TYPE.info).take();
    case "features":
      return out.begin(tag, C3_TYPE.features).take();
    case "confirm-all":
      return out.begin(tag, C3_TYPE.confirmAll).take();
    case "file-create":
      return out
        .begin(tag, C3_TYPE.fileCreate)
        .u16(MODULE)
        .u8(SOURCE_AND_DATA)
        .u8(1)
        .text(request.name, true)
        .text("", true)
        .take();
    case "file-delete":
      return out.begin(tag, C3_TYPE.fileDelete).u8(1).text(request.name, true).take();
    case "put-begin":
      return out.begin(tag, C3_TYPE.fileWrite).u8(FILE_STEP.begin).u32(request.size).take();
    case "put-size":
      return out.begin(tag, C3_TYPE.fileWrite).u8(FILE_STEP.size).take();
    case "put-data":
      return out
        .begin(tag, C3_TYPE.fileWrite)
        .u8(FILE_STEP.data)
        .u32(request.offset)
        .u32(request.data.length)
        .raw(request.data)
        .take();
    case "put-end":
      return out.begin(tag, C3_TYPE.fileWrite).u8(FILE_STEP.end).u32(request.flags).text(request.name, true).take();
    case "get-begin":
      return out.begin(tag, C3_TYPE.fileRead).u8(FILE_STEP.begin).u32(0).text(request.name, true).take();
    case "get-size":
      return out.begin(tag, C3_TYPE.fileRead).u8(FILE_STEP.size).take();
    case "get-data":
      return out.begin(tag, C3_TYPE.fileRead).u8(FILE_STEP.data).u32(request.offset).u32(request.most).take();
    case "get-end":
      return out.begin(tag, C3_TYPE.fileRead).u8(FILE_STEP.end).take();
    case "unknown":
      return out.begin(tag, request.type).take();
  }
}

/** @param payload  what follows the type; data of a file stays a view of it. */
export function readC3Request(type: number, payload: Uint8Array): C3Request {
  const from = new C3Fields(payload);
  const request = requestOf(type, from);
  return from.short || (request.kind !== "unknown" && from.left > 0) ? { kind: "malformed", type } : request;
}

function requestOf(type: number, from: C3Fields): C3Request {
  switch (type) {
    case C3_TYPE.readAscii:
    case C3_TYPE.read:
      return { kind: "read", wide: type === C3_TYPE.read, name: from.text(type === C3_TYPE.read) };
    case C3_TYPE.writeAscii:
    case C3_TYPE.write: {
      const wide = type === C3_TYPE.write;
      return { kind: "write", wide, name: from.text(wide), value: from.text(wide) };
    }
    case C3_TYPE.readMany:
      return { kind: "read-many", names: counted(from, () => from.text(true)) };
    case C3_TYPE.writeMany:
      return { kind: "write-many", pairs: counted(from, () => ({ name: from.text(true), value: from.text(true) })) };
    case C3_TYPE.control:
      return control(from);
    case C3_TYPE.info:
      return { kind: "info" };
    case C3_TYPE.features:
      return { kind: "features" };
    case C3_TYPE.confirmAll:
      return { kind: "confirm-all" };
    case C3_TYPE.fileCreate: {
      from.u16();
      from.u8();
      from.u8();
      const name = from.text(true);
      from.text(true);
      return { kind: "file-create", name };
    }
    case C3_TYPE.fileDelete:
      from.u8();
      return { kind: "file-delete", name: from.text(true) };
    case C3_TYPE.fileWrite:
      return put(from);
    case C3_TYPE.fileRead:
      return get(from);
    default:
      return { kind: "unknown", type };
  }
}

function control(from: C3Fields): C3Request {
  const command = from.u8();
  const interpreter = from.u16();
  if (command === C3_COMMAND.select || command === C3_COMMAND.run) {
    return {
      kind: "select",
      run: command === C3_COMMAND.run,
      name: from.text(true),
      parameters: from.text(true),
      force: from.u8() !== 0,
    };
  }
  return command >= C3_COMMAND.reset && command <= C3_COMMAND.cancel
    ? { kind: "control", command, interpreter }
    : { kind: "malformed", type: C3_TYPE.control };
}

function put(from: C3Fields): C3Request {
  switch (from.u8()) {
    case FILE_STEP.begin:
      return { kind: "put-begin", size: from.u32() };
    case FILE_STEP.size:
      return { kind: "put-size" };
    case FILE_STEP.data: {
      const offset = from.u32();
      const size = from.u32();
      return { kind: "put-data", offset, data: from.raw(size) };
    }
    case FILE_STEP.end:
      return { kind: "put-end", flags: from.u32(), name: from.text(true) };
    default:
      return { kind: "malformed", type: C3_TYPE.fileWrite };
  }
}

function get(from: C3Fields): C3Request {
  switch (from.u8()) {
    case FILE_STEP.begin:
      from.u32();
      return { kind: "get-begin", name: from.text(true) };
    case FILE_STEP.size:
      return { kind: "get-size" };
    case FILE_STEP.data:
      return { kind: "get-data", offset: from.u32(), most: from.u32() };
    case FILE_STEP.end:
      return { kind: "get-end" };
    default:
      return { kind: "malformed", type: C3_TYPE.fileRead };
  }
}

function counted<T>(from: C3Fields, one: () => T): T[] {
  const all: T[] = [];
  const count = from.u8();
  for (let i = 0; i < count && !from.short; i++) all.push(one());
  return all;
}
