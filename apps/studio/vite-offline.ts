import { createHash } from "node:crypto";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { deflateSync } from "node:zlib";
import type { Plugin } from "vite";
import { serviceWorkerText } from "./vite-service-worker.ts";

/** Never kept by the worker that it is, nor by a browser that has the pages. */
const SKIPPED = /\.map$|^sw\.js$/;
const ICONS = [180, 192, 512] as const;
const NAME = "Twincell";

/** Makes the built studio installable and lets it open without a network: manifest, icons, service worker. */
export function offlineStudio(): Plugin {
  let outDir = "dist";
  return {
    name: "twincell-offline",
    apply: "build",
    configResolved(config) {
      outDir = resolve(config.root, config.build.outDir);
    },
    transformIndexHtml: {
      order: "post",
      handler: (html, { path }) =>
        path.endsWith("/index.html") && !/\/(camera|pendant)\//.test(path)
          ? html.replace(
              "</head>",
              `  <link rel="manifest" href="./manifest.webmanifest" />\n    <link rel="apple-touch-icon" href="./icon-180.png" />\n    <meta name="theme-color" content="#14181b" />\n  </head>`,
            )
          : html,
    },
    // After the plug-in that copies the models of headset controllers: the list holds them too.
    closeBundle: {
      order: "post",
      sequential: true,
      handler() {
        for (const size of ICONS) writeFileSync(join(outDir, `icon-${size}.png`), icon(size));
        writeFileSync(join(outDir, "manifest.webmanifest"), manifest());
        const files = readdirSync(outDir, { recursive: true, withFileTypes: true })
          .filter(entry => entry.isFile())
          .map(entry =>
            join(entry.parentPath, entry.name)
              .slice(outDir.length + 1)
              .replaceAll("\\", "/"),
          )
          .filter(path => !SKIPPED.test(path))
          .toSorted()
          .map(path => [path, hash(readFileSync(join(outDir, path)))] as const);
        writeFileSync(join(outDir, "sw.js"), serviceWorkerText(hash(JSON.stringify(files)), files));
      },
    },
  };
}

const hash = (data: Buffer | string): string => createHash("sha256").update(data).digest("hex").slice(0, 12);

function manifest(): string {
  return JSON.stringify({
    name: NAME,
    short_name: NAME,
    description: "Teach, check, run and look back at industrial robots.",
    id: "./",
    start_url: "./",
    scope: "./",
    display: "standalone",
    background_color: "#14181b",
    theme_color: "#14181b",
    icons: [192, 512].map(size => ({
      src: `icon-${size}.png`,
      sizes: `${size}x${size}`,
      type: "image/png",
      purpose: "any",
    })),
  });
}

/** The mark of the page, a rounded teal square, as PNG: colour type RGBA, one IDAT chunk, no filter. */
function icon(size: number): Buffer {
  const round = size * 0.22;
  const rows = Buffer.alloc(size * (4 * size + 1));
  for (let y = 0; y < size; y++)
    for (let x = 0; x < size; x++) {
      const dx = Math.max(round - x - 0.5, x + 0.5 - (size - round), 0);
      const dy = Math.max(round - y - 0.5, y + 0.5 - (size - round), 0);
      const alpha = Math.max(0, Math.min(1, round - Math.hypot(dx, dy) + 0.5));
      rows.set([0x3f, 0xb8, 0xb3, Math.round(255 * alpha)], y * (4 * size + 1) + 1 + 4 * x);
    }
  const head = Buffer.alloc(13);
  head.writeUInt32BE(size, 0);
  head.writeUInt32BE(size, 4);
  head.set([8, 6, 0, 0, 0], 8);
  return Buffer.concat([
    Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]),
    chunk("IHDR", head),
    chunk("IDAT", deflateSync(rows)),
    chunk("IEND", Buffer.alloc(0)),
  ]);
}
function chunk(name: string, data: Buffer): Buffer {
  const body = Buffer.concat([Buffer.from(name, "latin1"), data]);
  const out = Buffer.alloc(body.length + 8);
  out.writeUInt32BE(data.length, 0);
  body.copy(out, 4);
  out.writeUInt32BE(crc32(body), body.length + 4);
  return out;
}
/** CRC-32 of ISO 3309, as PNG wants it. */
function crc32(data: Buffer): number {
  let crc = 0xffffffff;
  for (const byte of data) {
    crc ^= byte;
    for (let k = 0; k < 8; k++) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return (crc ^ 0xffffffff) >>> 0;
}
