/** Where a recording goes: a file, a browser's private file system, memory. The whole world of the recorder. */
export interface ByteSink {
  /** Takes the bytes for good: they are not used again by the recorder. Throws when there is no room. */
  write(bytes: Uint8Array): void;
  /** Bytes written so far. */
  readonly position: number;
}

export interface MemorySink extends ByteSink {
  /** Everything written so far, as one piece. */
  bytes(): Uint8Array<ArrayBuffer>;
}

export function memorySink(): MemorySink {
  const pieces: Uint8Array[] = [];
  let position = 0;
  return {
    write(bytes) {
      pieces.push(bytes);
      position += bytes.length;
    },
    get position() {
      return position;
    },
    bytes() {
      const all = new Uint8Array(position);
      let at = 0;
      for (const piece of pieces) {
        all.set(piece, at);
        at += piece.length;
      }
      return all;
    },
  };
}
