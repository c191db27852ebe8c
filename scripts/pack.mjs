// npm run pack: one tarball with studio, server and command line, out/twincell-VERSION.tgz. It needs nothing beside it:
// what the command line imports is bundled, large files of the studio are kept packed (the server answers with them as
// they are).
import { execFileSync } from "node:child_process";
import { cpSync, mkdirSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { brotliCompressSync, constants } from "node:zlib";
import { rolldown } from "rolldown";
import { build, buildDocs } from "./prepare.mjs";
import { thirdParty } from "./licences.mjs";

const root = fileURLToPath(new URL("..", import.meta.url));
const out = join(root, "out");
const folder = join(out, "package");
/** Loaded when somebody asks for what needs them; the command line says how to add them. */
const OPTIONAL = [
  "@mujoco/mujoco",
  "occt-import-js",
  "node-opcua",
  "mqtt",
  "@opentelemetry/api",
  "@opentelemetry/sdk-trace",
  "@opentelemetry/resources",
  "@opentelemetry/exporter-trace-otlp-http",
  "@nats-io/transport-node",
  "@nats-io/jetstream",
  "@nats-io/kv",
  "@simplewebauthn/server",
];
/** Types that the server knows how to unpack; smaller files are not worth it. */
const PACKED = [".wasm", ".js", ".css", ".glb", ".json", ".svg"];
const LEAST_BYTES = 4096;
const QUALITY = 9;
/** Kernels are most of the weight: they are packed as small as it goes. */
const KERNEL_QUALITY = 11;

const cli = JSON.parse(readFileSync(join(root, "apps/cli/package.json"), "utf8"));
const { engines } = JSON.parse(readFileSync(join(root, "package.json"), "utf8"));
const optional = Object.fromEntries(OPTIONAL.map(name => [name, versionOf(name)]));

build();
buildDocs();
rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
await bundle();
pages(join(root, "apps/studio/dist"), join(folder, "studio"), PACKED);
pages(join(root, "docs/.vitepress/dist"), join(folder, "docs"), [...PACKED, ".html"]);
for (const file of ["LICENSE", "README.md", "CHANGELOG.md"]) cpSync(join(root, file), join(folder, file));
writeFileSync(join(folder, "THIRD-PARTY.md"), thirdParty());
writeFileSync(
  join(folder, "package.json"),
  `${JSON.stringify(
    {
      name: cli.name,
      version: cli.version,
      description: "Teach, simulate, check and twin industrial robot cells in a browser or a headset.",
      license: cli.license,
      type: "module",
      engines,
      bin: { twincell: "cli/twincell.js" },
      files: ["cli", "studio", "docs", "THIRD-PARTY.md", "CHANGELOG.md"],
      peerDependencies: optional,
      peerDependenciesMeta: Object.fromEntries(OPTIONAL.map(name => [name, { optional: true }])),
    },
    null,
    2,
  )}\n`,
);
const tarball = join(out, `${cli.name}-${cli.version}.tgz`);
rmSync(tarball, { force: true });
execFileSync("npm", ["pack", folder, "--pack-destination", out, "--loglevel", "error"], {
  cwd: out,
  stdio: ["ignore", "ignore", "inherit"],
  shell: process.platform === "win32",
});
console.log(`${tarball}: ${megabytes(statSync(tarball).size)} MB, ${megabytes(bytesUnder(folder))} MB installed`);

/** The command line and its worker threads as modules of one folder. */
async function bundle() {
  const made = await rolldown({
    cwd: root,
    input: {
      twincell: "apps/cli/src/main.ts",
      "lay-out.worker": "apps/server/src/stations/lay-out.worker.ts",
      "judge.worker": "apps/server/src/api/judge.worker.ts",
    },
    platform: "node",
    external: [...OPTIONAL, "bufferutil", "utf-8-validate"],
    plugins: [
      {
        name: "worker-address",
        transform: code =>
          code.includes('.worker.ts"') ? code.replaceAll(/"\.\/([\w-]+\.worker)\.ts"/g, '"./$1.js"') : null,
      },
    ],
  });
  await made.write({
    dir: join(folder, "cli"),
    format: "esm",
    entryFileNames: "[name].js",
    chunkFileNames: "[name]-[hash].js",
    banner: "const __dirname = import.meta.dirname;",
    // Names stay, so that a fault that somebody reports can be read.
    minify: { compress: false, mangle: false, codegen: { removeWhitespace: true } },
  });
  await made.close();
  cpSync(join(root, "node_modules/@bokuweb/zstd-wasm/dist/common/zstd.wasm"), join(folder, "cli/zstd.wasm"));
}

/** Pages as the server hands them out: what can be packed and is worth it is packed. */
function pages(from, into, packed) {
  mkdirSync(into, { recursive: true });
  for (const entry of readdirSync(from, { withFileTypes: true })) {
    const source = join(from, entry.name);
    const target = join(into, entry.name);
    if (entry.isDirectory()) pages(source, target, packed);
    else if (packed.some(end => entry.name.endsWith(end)) && statSync(source).size >= LEAST_BYTES)
      writeFileSync(
        `${target}.br`,
        brotliCompressSync(readFileSync(source), {
          params: { [constants.BROTLI_PARAM_QUALITY]: entry.name.endsWith(".wasm") ? KERNEL_QUALITY : QUALITY },
        }),
      );
    else cpSync(source, target);
  }
}

function versionOf(name) {
  return JSON.parse(readFileSync(join(root, "node_modules", name, "package.json"), "utf8")).version;
}

function bytesUnder(path) {
  const found = statSync(path);
  return found.isDirectory()
    ? readdirSync(path).reduce((sum, name) => sum + bytesUnder(join(path, name)), 0)
    : found.size;
}

function megabytes(bytes) {
  return (bytes / 1e6).toFixed(1);
}
