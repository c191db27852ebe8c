/** Little-endian numbers in a row of bytes. None checks bounds: callers have looked at the size. */
export const u16 = (bytes: Uint8Array, at: number): number => bytes[at]! | (bytes[at + 1]! << 8);
export const i32 = (bytes: Uint8Array, at: number): number =>
  bytes[at]! | (bytes[at + 1]! << 8) | (bytes[at + 2]! << 16) | (bytes[at + 3]! << 24);
export const u32 = (bytes: Uint8Array, at: number): number => i32(bytes, at) >>> 0;
export const i16 = (bytes: Uint8Array, at: number): number => (u16(bytes, at) << 16) >> 16;

export function putU16(bytes: Uint8Array, at: number, value: number): void {
  bytes[at] = value & 255;
  bytes[at + 1] = (value >> 8) & 255;
}
/** Also for signed numbers: the bytes are the same. */
export function putU32(bytes: Uint8Array, at: number, value: number): void {
  bytes[at] = value & 255;
  bytes[at + 1] = (value >> 8) & 255;
  bytes[at + 2] = (value >> 16) & 255;
  bytes[at + 3] = (value >> 24) & 255;
}

/** Text in a field of fixed length; zeros behind it. A letter beyond Latin 1 becomes "?". */
export function putText(bytes: Uint8Array, at: number, length: number, text: string): void {
  for (let i = 0; i < length; i++) {
    const code = i < text.length ? text.charCodeAt(i) : 0;
    bytes[at + i] = code > 255 ? 63 : code;
  }
}
/** The text up to the first zero. */
export function textAt(bytes: Uint8Array, at: number, length: number): string {
  let text = "";
  for (let i = at; i < Math.min(at + length, bytes.length) && bytes[i] !== 0; i++)
    text += String.fromCharCode(bytes[i]!);
  return text;
}
/** Text as bytes, one each. */
export function textBytes(text: string, length = text.length): Uint8Array {
  const bytes = new Uint8Array(length);
  putText(bytes, 0, length, text);
  return bytes;
}
