const ALPHABET = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
const VALUES = new Map([...ALPHABET].map((letter, value) => [letter.charCodeAt(0), value]));
/** Characters joined at a time: long enough to be quick, short enough for an argument list. */
const CHUNK = 4096;

/** RFC 4648 with padding. Written here because below the roof there is neither `btoa` nor `Buffer`. */
export function toBase64(bytes: Uint8Array): string {
  const parts: string[] = [];
  let codes: number[] = [];
  for (let i = 0; i < bytes.length; i += 3) {
    const left = bytes.length - i;
    const triple = (bytes[i]! << 16) | ((bytes[i + 1] ?? 0) << 8) | (bytes[i + 2] ?? 0);
    codes.push(
      ALPHABET.charCodeAt(triple >> 18),
      ALPHABET.charCodeAt((triple >> 12) & 63),
      left > 1 ? ALPHABET.charCodeAt((triple >> 6) & 63) : 61,
      left > 2 ? ALPHABET.charCodeAt(triple & 63) : 61,
    );
    if (codes.length >= CHUNK) {
      parts.push(String.fromCharCode(...codes));
      codes = [];
    }
  }
  parts.push(String.fromCharCode(...codes));
  return parts.join("");
}

/** The bytes, or undefined when the text is not canonical base64: foreign letters, wrong length or stray bits. */
export function fromBase64(text: string): Uint8Array | undefined {
  if (text.length % 4 !== 0) return undefined;
  const padding = text.endsWith("==") ? 2 : text.endsWith("=") ? 1 : 0;
  const bytes = new Uint8Array((text.length / 4) * 3 - padding);
  for (let i = 0, at = 0; i < text.length; i += 4) {
    const last = i + 4 === text.length;
    let triple = 0;
    for (let k = 0; k < 4; k++) {
      const value = last && k >= 4 - padding ? 0 : VALUES.get(text.charCodeAt(i + k));
      if (value === undefined) return undefined;
      triple = (triple << 6) | value;
    }
    const count = last ? 3 - padding : 3;
    if ((triple & ((1 << (8 * (3 - count))) - 1)) !== 0) return undefined;
    for (let k = 0; k < count; k++) bytes[at++] = (triple >> (16 - 8 * k)) & 255;
  }
  return bytes;
}
