import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { brotliCompressSync, brotliDecompressSync, gunzipSync } from "node:zlib";
import { afterAll, expect, test } from "vitest";
import { staticFiles } from "./static-files.ts";

const folder = mkdtempSync(join(tmpdir(), "twincell-files-"));
afterAll(() => {
  rmSync(folder, { recursive: true });
});

test("a file that is kept packed (NAME.br) answers as NAME to every client: packed, as gzip or plain", async () => {
  const wanted = Buffer.from("export const answer = 42;\n".repeat(50));
  writeFileSync(join(folder, "kernel.wasm.br"), brotliCompressSync(wanted));
  const answer = staticFiles(folder);
  const packed = await answer("/kernel.wasm", "gzip, br", undefined);
  expect(packed).toMatchObject({
    status: 200,
    headers: { "content-type": "application/wasm", "content-encoding": "br" },
  });
  expect(brotliDecompressSync(packed.body)).toEqual(wanted);
  const gzipped = await answer("/kernel.wasm", "gzip", undefined);
  expect(gzipped.headers["content-encoding"]).toBe("gzip");
  expect(gunzipSync(gzipped.body)).toEqual(wanted);
  const plain = await answer("/kernel.wasm", "", undefined);
  expect(plain.headers["content-encoding"]).toBeUndefined();
  expect(plain.body).toEqual(wanted);
  expect((await answer("/other.wasm", "br", undefined)).status).toBe(404);
});
