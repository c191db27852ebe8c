/** Cuts a stream of text into lines. */
export interface Lines {
  /** Returns a sentence when a line grows past the bound: the stream has no way back from there. */
  push(bytes: Uint8Array, line: (text: string) => void): string | null;
}

/** Lines end with LF; a CR before it is no part of them. Bytes that are no ASCII become "?". */
export function lineReader(longest = 4096): Lines {
  let kept = "";
  return {
    push(bytes, line) {
      for (const byte of bytes) {
        if (byte !== 10) {
          if (kept.length >= longest) return `A line has at most ${longest} letters; a longer one came.`;
          kept += byte < 128 ? String.fromCharCode(byte) : "?";
          continue;
        }
        const text = kept.endsWith("\r") ? kept.slice(0, -1) : kept;
        kept = "";
        line(text);
      }
      return null;
    },
  };
}

/** A line as it is sent. */
export function lineBytes(text: string): Uint8Array {
  const out = new Uint8Array(text.length + 1);
  for (let i = 0; i < text.length; i++) {
    const code = text.charCodeAt(i);
    out[i] = code < 128 ? code : 63;
  }
  out[text.length] = 10;
  return out;
}
