import type { ByteSink } from "../sink.ts";

export interface StoredFile {
  readonly name: string;
  readonly bytes: number;
}

/** Where recordings lie: a folder, a browser's database, a file that was dropped on the page, memory. */
export interface FilePort {
  list(): Promise<readonly StoredFile[]>;
  /** Bytes from there on; fewer at the end of the file. Rejects when the file is gone. The bytes are the caller's. */
  read(name: string, from: number, length: number): Promise<Uint8Array>;
}

/** A place that also takes new recordings. */
export interface ArchivePort extends FilePort {
  /**
   * A new, empty file. What is written is with the operating system when `write` returns: a crash of ours does not lose
   * it.
   */
  create(name: string): FileSink;
  remove(name: string): Promise<void>;
}
export interface FileSink extends ByteSink {
  close(): void;
}

/** Files in memory. */
export function memoryFiles(files: Iterable<readonly [string, Uint8Array]> = []): ArchivePort {
  const kept = new Map<string, Uint8Array[]>([...files].map(([name, bytes]) => [name, [bytes]]));
  const sizeOf = (pieces: readonly Uint8Array[]): number => pieces.reduce((sum, piece) => sum + piece.length, 0);
  return {
    list: () => Promise.resolve([...kept].map(([name, pieces]) => ({ name, bytes: sizeOf(pieces) }))),
    read(name, from, length) {
      const pieces = kept.get(name);
      if (!pieces) return Promise.reject(new Error(`There is no file ${name}`));
      const until = Math.min(from + length, sizeOf(pieces));
      const out = new Uint8Array(Math.max(0, until - from));
      let at = 0;
      for (const piece of pieces) {
        const first = Math.max(from, at);
        const last = Math.min(until, at + piece.length);
        if (first < last) out.set(piece.subarray(first - at, last - at), first - from);
        at += piece.length;
      }
      return Promise.resolve(out);
    },
    create(name) {
      const pieces: Uint8Array[] = [];
      let position = 0;
      kept.set(name, pieces);
      return {
        write(bytes) {
          pieces.push(bytes);
          position += bytes.length;
        },
        get position() {
          return position;
        },
        close() {
          kept.set(name, pieces);
        },
      };
    },
    remove(name) {
      kept.delete(name);
      return Promise.resolve();
    },
  };
}
