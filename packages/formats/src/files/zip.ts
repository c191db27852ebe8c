import { answering, Refusal, type NotUnderstood } from "../refusal.ts";
import { utf8 } from "../utf8.ts";
import { shorten } from "../xml.ts";
import { normalPath } from "./source.ts";

/** What an archive may hold at most. */
export const ZIP_LIMITS = { files: 5000, bytes: 512_000_000, ratio: 200 } as const;
const END = 0x06054b50;
const ENTRY = 0x02014b50;
const LOCAL = 0x04034b50;
/** A few kilobytes of spaces compress a thousandfold; below this nobody is hurt [bytes]. */
const HARMLESS = 1_000_000;

export interface ZipRead {
  readonly kind: "read";
  readonly files: ReadonlyMap<string, Uint8Array>;
}

/**
 * Unpacks a ZIP archive into memory. What would grow beyond the limits, lead out of its folder or is encrypted is
 * refused before a byte is unpacked. Stored and deflated entries are read; ZIP64 is not.
 *
 * @param inflate  raw DEFLATE (RFC 1951); must never give more than `size` bytes, and throws for what is no DEFLATE.
 * @see PKWARE APPNOTE.TXT 6.3.10, 4.3
 */
export function readZip(
  bytes: Uint8Array,
  inflate: (packed: Uint8Array, size: number) => Uint8Array,
): ZipRead | NotUnderstood {
  return answering(() => {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const entries = directory(bytes, view);
    const files = new Map<string, Uint8Array>();
    for (const entry of entries) files.set(entry.path, contentOf(entry, bytes, view, inflate));
    return { kind: "read", files };
  });
}

interface Entry {
  readonly path: string;
  readonly method: number;
  readonly packed: number;
  readonly size: number;
  readonly at: number;
}

function directory(bytes: Uint8Array, view: DataView): Entry[] {
  let end = bytes.length - 22;
  const first = Math.max(0, end - 65_535);
  while (end >= first && view.getUint32(end, true) !== END) end--;
  if (end < first) throw new Refusal("The file is no ZIP archive, or its end is missing.");
  const count = view.getUint16(end + 10, true);
  let at = view.getUint32(end + 16, true);
  if (count > ZIP_LIMITS.files)
    throw new Refusal(`The archive holds ${count} files; at most ${ZIP_LIMITS.files} are read.`);
  const entries: Entry[] = [];
  const paths = new Set<string>();
  let total = 0;
  for (let i = 0; i < count; i++) {
    if (at + 46 > bytes.length || view.getUint32(at, true) !== ENTRY)
      throw new Refusal(`The list of the archive ends after ${i} of ${count} files.`);
    const flags = view.getUint16(at + 8, true);
    const size = view.getUint32(at + 24, true);
    const packed = view.getUint32(at + 20, true);
    const nameLength = view.getUint16(at + 28, true);
    const name = utf8(bytes.subarray(at + 46, at + 46 + nameLength));
    const entry = { method: view.getUint16(at + 10, true), packed, size, at: view.getUint32(at + 42, true) };
    at += 46 + nameLength + view.getUint16(at + 30, true) + view.getUint16(at + 32, true);
    if (name.endsWith("/")) continue;
    const path = normalPath(name);
    if (
      path === undefined ||
      path === "" ||
      path.startsWith("/") ||
      /^[a-z]:/i.test(path) ||
      path !== name.replaceAll("\\", "/").replace(/^\.\//, "")
    )
      throw new Refusal(`The archive holds “${shorten(name)}”, a path that leads out of its folder.`);
    if (paths.has(path)) throw new Refusal(`The archive holds “${shorten(path)}” twice.`);
    if ((flags & 1) !== 0) throw new Refusal(`“${shorten(path)}” in the archive is encrypted.`);
    total += size;
    if (total > ZIP_LIMITS.bytes)
      throw new Refusal(`Unpacked, the archive has more than ${ZIP_LIMITS.bytes} bytes; so many are not read.`);
    if (size > HARMLESS && size > packed * ZIP_LIMITS.ratio)
      throw new Refusal(`“${shorten(path)}” in the archive would grow from ${packed} to ${size} bytes: it is refused.`);
    paths.add(path);
    entries.push({ path, ...entry });
  }
  return entries;
}

function contentOf(
  { path, method, packed, size, at }: Entry,
  bytes: Uint8Array,
  view: DataView,
  inflate: (packed: Uint8Array, size: number) => Uint8Array,
): Uint8Array {
  if (at + 30 > bytes.length || view.getUint32(at, true) !== LOCAL)
    throw new Refusal(`“${shorten(path)}” is not where the archive says.`);
  const start = at + 30 + view.getUint16(at + 26, true) + view.getUint16(at + 28, true);
  if (start + packed > bytes.length) throw new Refusal(`The archive ends inside “${shorten(path)}”.`);
  const content = bytes.subarray(start, start + packed);
  if (method === 0) return content;
  if (method !== 8) throw new Refusal(`“${shorten(path)}” is packed in a way that is not read (method ${method}).`);
  let out: Uint8Array;
  try {
    out = inflate(content, size);
  } catch (problem) {
    throw new Refusal(
      `“${shorten(path)}” in the archive is damaged: ${problem instanceof Error ? problem.message : String(problem)}.`,
    );
  }
  if (out.length !== size)
    throw new Refusal(`“${shorten(path)}” has ${out.length} bytes where the archive says ${size}.`);
  return out;
}
