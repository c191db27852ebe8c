import { createHash } from "node:crypto";
import { readFile, stat } from "node:fs/promises";
import { extname, join, normalize, sep } from "node:path";
import { promisify } from "node:util";
import { brotliCompress, brotliDecompress, constants, gzip } from "node:zlib";

const TYPES: Readonly<Record<string, string>> = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".css": "text/css; charset=utf-8",
  ".json": "application/json",
  ".wasm": "application/wasm",
  ".svg": "image/svg+xml",
  ".png": "image/png",
  ".webp": "image/webp",
  ".woff2": "font/woff2",
  ".woff": "font/woff",
  ".glb": "model/gltf-binary",
  ".mcap": "application/octet-stream",
  ".ico": "image/x-icon",
};
const COMPRESSIBLE = new Set([".html", ".js", ".css", ".json", ".svg", ".wasm", ".glb"]);

export interface StaticAnswer {
  readonly status: 200 | 304 | 404;
  readonly headers: Readonly<Record<string, string>>;
  readonly body: Buffer;
}

/**
 * Files of one folder, compressed once and kept: the studio is small and asked for again and again. `NAME.br` stands
 * for NAME where there is no NAME itself: a package keeps its large files that way.
 */
export function staticFiles(folder: string) {
  const kept = new Map<
    string,
    { readonly mtime: number; readonly etag: string; readonly bodies: Map<string, Buffer> }
  >();
  const compress = {
    br: (body: Buffer) => promisify(brotliCompress)(body, { params: { [constants.BROTLI_PARAM_QUALITY]: 5 } }),
    gzip: (body: Buffer) => promisify(gzip)(body),
  };

  /** @param path decoded path of the address, "/" first. Anything outside the folder does not exist. */
  return async function answer(path: string, accepts: string, knownEtag: string | undefined): Promise<StaticAnswer> {
    const notFound: StaticAnswer = {
      status: 404,
      headers: { "content-type": "text/plain; charset=utf-8" },
      body: Buffer.from("There is nothing at this address.\n"),
    };
    const file = normalize(join(folder, path.endsWith("/") ? `${path}index.html` : path));
    if (path.includes("\0") || !file.startsWith(normalize(folder + sep))) return notFound;
    const own = await stat(file).catch(() => null);
    const isPacked = own?.isFile() !== true && COMPRESSIBLE.has(extname(file).toLowerCase());
    const stored = isPacked ? `${file}.br` : file;
    const found = isPacked ? await stat(stored).catch(() => null) : own;
    if (!found?.isFile()) return notFound;

    let entry = kept.get(file);
    if (!entry || entry.mtime !== found.mtimeMs) {
      const body = await readFile(stored);
      entry = {
        mtime: found.mtimeMs,
        etag: `"${createHash("sha256").update(body).digest("base64url").slice(0, 22)}"`,
        bodies: new Map([[isPacked ? "br" : "", body]]),
      };
      kept.set(file, entry);
    }
    const extension = extname(file).toLowerCase();
    const encoding = !COMPRESSIBLE.has(extension)
      ? ""
      : /\bbr\b/.test(accepts)
        ? "br"
        : /\bgzip\b/.test(accepts)
          ? "gzip"
          : "";
    const headers: Record<string, string> = {
      "content-type": TYPES[extension] ?? "application/octet-stream",
      // Names under assets/ carry a hash of their content.
      "cache-control": path.startsWith("/assets/") ? "public, max-age=31536000, immutable" : "no-cache",
      etag: entry.etag,
      vary: "accept-encoding",
    };
    if (encoding) headers["content-encoding"] = encoding;
    if (knownEtag === entry.etag) return { status: 304, headers, body: Buffer.alloc(0) };
    let body = entry.bodies.get(encoding);
    if (!body) {
      const plain = entry.bodies.get("") ?? (await promisify(brotliDecompress)(entry.bodies.get("br")!));
      body = encoding === "" ? plain : await compress[encoding as "br" | "gzip"](plain);
      entry.bodies.set(encoding, body);
    }
    return { status: 200, headers, body };
  };
}
