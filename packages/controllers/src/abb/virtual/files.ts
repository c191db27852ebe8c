const MOST_BYTES = 16_000_000;
const MOST_FILES = 2_000;
/** Folders a controller has from the beginning. */
export const FOLDERS = ["$HOME", "$TEMP", "$RAMDISK"] as const;

/**
 * Files of a controller by their paths below `$HOME` and its like; kept over a restart. Small and capital letters are
 * the same.
 */
export class Files {
  private readonly files = new Map<string, { readonly path: readonly string[]; readonly bytes: Uint8Array }>();
  private held = 0;

  /** `HOME:/a.mod`, `$home/a.mod` and `$HOME/a.mod` are one place; null when it is none. */
  static place(path: readonly string[]): readonly string[] | null {
    const [volume = "", ...rest] = path;
    const name = `$${volume.replace(/^\$/, "").replace(/:$/, "").toUpperCase()}`;
    return (FOLDERS as readonly string[]).includes(name) &&
      rest.every(part => /^[^/\\:\x00-\x1F]{1,120}$/.test(part) && part !== "." && part !== "..") &&
      rest.length <= 16
      ? [name, ...rest]
      : null;
  }
  private static key(path: readonly string[]): string {
    return path.join("/").toUpperCase();
  }

  read(path: readonly string[]): Uint8Array | undefined {
    return this.files.get(Files.key(path))?.bytes;
  }
  /** Whether it was new; null when the disk is full. */
  write(path: readonly string[], bytes: Uint8Array): boolean | null {
    const key = Files.key(path);
    const before = this.files.get(key);
    if (
      this.held - (before?.bytes.length ?? 0) + bytes.length > MOST_BYTES ||
      (!before && this.files.size >= MOST_FILES)
    )
      return null;
    this.held += bytes.length - (before?.bytes.length ?? 0);
    this.files.set(key, { path, bytes });
    return !before;
  }
  remove(path: readonly string[]): boolean {
    const key = Files.key(path);
    this.held -= this.files.get(key)?.bytes.length ?? 0;
    return this.files.delete(key);
  }
  /** Names in a folder, and how long each file is; -1 for a folder. Null when there is no such folder. */
  list(path: readonly string[]): ReadonlyMap<string, number> | null {
    const names = new Map<string, number>();
    const prefix = `${Files.key(path)}/`;
    for (const [key, file] of this.files) {
      if (!key.startsWith(prefix)) continue;
      const own = file.path.slice(path.length);
      names.set(own[0]!, own.length === 1 ? file.bytes.length : -1);
    }
    return names.size > 0 || path.length === 1 ? names : null;
  }
}
