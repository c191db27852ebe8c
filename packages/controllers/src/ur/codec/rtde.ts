import { SHAPES, type Field, type FieldType } from "./rtde-fields.ts";

/** Kinds of frames of RTDE: each is a letter. */
export const RTDE = {
  protocolVersion: 86,
  controllerVersion: 118,
  text: 77,
  data: 85,
  outputs: 79,
  inputs: 73,
  start: 83,
  pause: 80,
} as const;
const HEADER = 3;
/** The size is 16 bits wide, the header included. */
export const LARGEST_FRAME = 0xffff;

export interface Frames {
  /**
   * Takes what came and hands out whole frames. `payload` is lent for the call.
   * Returns a sentence when the bytes cannot be frames of RTDE: the stream has no way back from there.
   */
  push(bytes: Uint8Array, frame: (type: number, payload: Uint8Array) => void): string | null;
}

/**
 * Cuts a stream into frames, however it was split: `uint16 size | uint8 type | payload`, big-endian. Keeps at most one
 * frame.
 */
export function rtdeFrames(): Frames {
  const kept = new Uint8Array(LARGEST_FRAME);
  let have = 0;
  return {
    push(bytes, frame) {
      let at = 0;
      while (at < bytes.length || have > 0) {
        // The size first, then the rest of its frame; what is whole in the bytes that came is not copied.
        if (have === 0 && bytes.length - at >= HEADER) {
          const size = (bytes[at]! << 8) | bytes[at + 1]!;
          if (size < HEADER) return tooSmall(size);
          if (at + size <= bytes.length) {
            frame(bytes[at + 2]!, bytes.subarray(at + HEADER, at + size));
            at += size;
            continue;
          }
        }
        const wanted = have < HEADER ? HEADER : (kept[0]! << 8) | kept[1]!;
        if (wanted < HEADER) return tooSmall(wanted);
        const take = Math.min(wanted - have, bytes.length - at);
        kept.set(bytes.subarray(at, at + take), have);
        have += take;
        at += take;
        if (have < wanted) return null;
        if (have === HEADER && ((kept[0]! << 8) | kept[1]!) !== HEADER) continue;
        have = 0;
        frame(kept[2]!, kept.subarray(HEADER, wanted));
      }
      return null;
    },
  };
}
const tooSmall = (size: number): string => `A frame of RTDE has at least ${HEADER} bytes; one of ${size} came.`;

/** A frame with that payload. */
export function rtdeFrame(type: number, payload: ArrayLike<number> = []): Uint8Array {
  const out = new Uint8Array(HEADER + payload.length);
  out[0] = out.length >> 8;
  out[1] = out.length & 255;
  out[2] = type;
  out.set(payload, HEADER);
  return out;
}

const latin = (text: string): number[] =>
  Array.from(text, letter => {
    const code = letter.charCodeAt(0);
    return code < 128 ? code : 63;
  });
export const ascii = (bytes: Uint8Array): string => {
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return text;
};

export const askProtocol = (version: number): Uint8Array =>
  rtdeFrame(RTDE.protocolVersion, [version >> 8, version & 255]);
export const askVersion = (): Uint8Array => rtdeFrame(RTDE.controllerVersion);
export const start = (): Uint8Array => rtdeFrame(RTDE.start);
export const pause = (): Uint8Array => rtdeFrame(RTDE.pause);
export const accepted = (type: number, yes: boolean): Uint8Array => rtdeFrame(type, [yes ? 1 : 0]);

/** major, minor, bugfix, build */
export type Version = readonly [number, number, number, number];
export function versionAnswer(version: Version): Uint8Array {
  const payload = new Uint8Array(16);
  const view = new DataView(payload.buffer);
  version.forEach((part, i) => {
    view.setUint32(4 * i, part);
  });
  return rtdeFrame(RTDE.controllerVersion, payload);
}
export function readVersion(payload: Uint8Array): Version | null {
  if (payload.length < 16) return null;
  const view = viewOf(payload);
  return [view.getUint32(0), view.getUint32(4), view.getUint32(8), view.getUint32(12)];
}

/** Protocol 2 says how often [Hz]. */
export function askOutputs(names: readonly string[], frequency_Hz: number): Uint8Array {
  const head = new Uint8Array(8);
  new DataView(head.buffer).setFloat64(0, frequency_Hz);
  return rtdeFrame(RTDE.outputs, [...head, ...latin(names.join(","))]);
}
export const askInputs = (names: readonly string[]): Uint8Array => rtdeFrame(RTDE.inputs, latin(names.join(",")));
/** Names as they come: some clients end the list with a comma. */
export const namesIn = (payload: Uint8Array): string[] =>
  ascii(payload)
    .split(",")
    .map(name => name.trim())
    .filter(name => name !== "");
export const outputsAsked = (
  payload: Uint8Array,
  protocol: number,
): { readonly frequency_Hz: number; readonly names: string[] } =>
  protocol < 2 || payload.length < 8
    ? { frequency_Hz: 0, names: namesIn(payload) }
    : { frequency_Hz: viewOf(payload).getFloat64(0), names: namesIn(payload.subarray(8)) };

/** What stands in the place of a type when a variable cannot be had. */
export type NotHad = "NOT_FOUND" | "IN_USE";
/** Protocol 1 has no id for outputs. */
export const recipeAnswer = (kind: number, id: number | null, types: readonly (FieldType | NotHad)[]): Uint8Array =>
  rtdeFrame(kind, [...(id === null ? [] : [id]), ...latin(types.join(","))]);
export const recipeAnswered = (
  payload: Uint8Array,
  hasId: boolean,
): { readonly id: number; readonly types: string[] } => ({
  id: hasId ? (payload[0] ?? 0) : 0,
  types: namesIn(hasId ? payload.subarray(1) : payload),
});

export type TextLevel = "exception" | "error" | "warning" | "info";
const LEVELS: readonly TextLevel[] = ["exception", "error", "warning", "info"];
export interface RtdeText {
  readonly message: string;
  readonly source: string;
  readonly level: TextLevel;
}
/** Protocol 2: message and source, each with its length, and a level; protocol 1: the level, then the message. */
export function textFrame({ message, source, level }: RtdeText, protocol: number): Uint8Array {
  const text = latin(message).slice(0, 255);
  const from = latin(source).slice(0, 255);
  const rank = LEVELS.indexOf(level);
  return rtdeFrame(RTDE.text, protocol < 2 ? [rank, ...text] : [text.length, ...text, from.length, ...from, rank]);
}
export function readText(payload: Uint8Array, protocol: number): RtdeText {
  if (protocol < 2)
    return { message: ascii(payload.subarray(1)), source: "", level: LEVELS[payload[0] ?? 3] ?? "info" };
  const length = payload[0] ?? 0;
  const from = payload[1 + length] ?? 0;
  const after = 2 + length + from;
  return {
    message: ascii(payload.subarray(1, 1 + length)),
    source: ascii(payload.subarray(2 + length, after)),
    level: LEVELS[payload[after] ?? 3] ?? "info",
  };
}

/** Which variables a data package holds, in order. */
export interface Recipe {
  readonly id: number;
  readonly fields: readonly Field[];
  readonly bytes: number;
}
export const recipeOf = (id: number, fields: readonly Field[]): Recipe => ({
  id,
  fields,
  bytes: fields.reduce((sum, { type }) => sum + SHAPES[type].bytes, 0),
});
/** Types answered are those that were expected, or the names that are not. */
export const unexpected = (fields: readonly Field[], types: readonly string[]): string[] =>
  fields.length === types.length
    ? fields.flatMap(({ name, type }, i) => (type === types[i] ? [] : [`${name} (${types[i] ?? "nothing"})`]))
    : [`${fields.length} variables, ${types.length} types`];

export const viewOf = (bytes: Uint8Array): DataView => new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);

/** A buffer for packages of that recipe, with its header in place: `packData` fills in the rest. */
export function dataBuffer(recipe: Recipe, withId: boolean): Uint8Array {
  const out = rtdeFrame(RTDE.data, new Uint8Array((withId ? 1 : 0) + recipe.bytes));
  if (withId) out[HEADER] = recipe.id;
  return out;
}

/** Writes the slots of a recipe into its buffer. Allocates nothing but the view. */
export function packData(recipe: Recipe, slots: Float64Array, out: Uint8Array, view: DataView): void {
  let at = out.length - recipe.bytes;
  for (const { type, slot } of recipe.fields) {
    const { numbers, each } = SHAPES[type];
    for (let i = 0; i < numbers; i++) {
      const value = slots[slot + i]!;
      switch (each) {
        case "f64":
          view.setFloat64(at, value);
          at += 8;
          break;
        case "u64":
          view.setUint32(at, Math.floor(value / 0x1_0000_0000));
          view.setUint32(at + 4, value >>> 0);
          at += 8;
          break;
        case "i32":
          view.setInt32(at, value);
          at += 4;
          break;
        case "u32":
          view.setUint32(at, value);
          at += 4;
          break;
        default:
          view.setUint8(at, value);
          at += 1;
      }
    }
  }
}

/** Reads the fields of a recipe into their slots; false when the package is not as long as the recipe says. */
export function unpackData(recipe: Recipe, body: Uint8Array, slots: Float64Array): boolean {
  if (body.length !== recipe.bytes) return false;
  const view = viewOf(body);
  let at = 0;
  for (const { type, slot } of recipe.fields) {
    const { numbers, each } = SHAPES[type];
    for (let i = 0; i < numbers; i++) {
      switch (each) {
        case "f64":
          slots[slot + i] = view.getFloat64(at);
          at += 8;
          break;
        case "u64":
          slots[slot + i] = view.getUint32(at) * 0x1_0000_0000 + view.getUint32(at + 4);
          at += 8;
          break;
        case "i32":
          slots[slot + i] = view.getInt32(at);
          at += 4;
          break;
        case "u32":
          slots[slot + i] = view.getUint32(at);
          at += 4;
          break;
        default:
          slots[slot + i] = view.getUint8(at);
          at += 1;
      }
    }
  }
  return true;
}
