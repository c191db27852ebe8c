/** The TypeScript client of clients/typescript, packed and installed as a user does it, against a server. */
import { spawn, spawnSync } from "node:child_process";
import { cpSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { emptyProgram, type Program } from "@twincell/core";
import { afterEach, expect, test } from "vitest";
import { serve, type Served } from "./index.ts";

const root = fileURLToPath(new URL("../../../", import.meta.url));
const client = join(root, "clients/typescript");
const tsc = join(root, "node_modules/typescript7/bin/tsc");
let served: Served | undefined;
afterEach(async () => {
  await served?.close();
  served = undefined;
});
const program: Program = {
  ...emptyProgram("yaskawa_gp8"),
  steps: [0.3, 0].map((q, i) => ({
    id: `s${i}`,
    type: "move",
    path: "ptp",
    speed: { ratio: 0.5 },
    blend_m: 0,
    target: { q: [q, 0, 0, 0, 0, 0] },
  })),
} as Program;

test("the types of the TypeScript client are those of the server's schemas; after a change run node scripts/write-client.mjs", () => {
  const written = spawnSync(
    process.execPath,
    ["-e", `import("./scripts/client-types.mjs").then(({ clientTypes }) => process.stdout.write(clientTypes()))`],
    { cwd: root, encoding: "utf8" },
  );
  expect(written.status, written.stderr).toBe(0);
  const formatted = spawnSync(
    join(root, "node_modules/.bin/biome"),
    ["format", "--stdin-file-path", "clients/typescript/src/api.ts"],
    { cwd: root, encoding: "utf8", input: written.stdout },
  );
  expect(formatted.status, formatted.stderr).toBe(0);
  expect(readFileSync(join(client, "src/api.ts"), "utf8")).toBe(formatted.stdout);
});

test("the TypeScript client is packed, installed and type-checked in a project of its own; it connects, streams, checks, plans, moves, is refused, is stopped and fetches the recording", async () => {
  const project = mkdtempSync(join(tmpdir(), "twincell-client-"));
  const run = (command: string, args: readonly string[], cwd: string): void => {
    const done = spawnSync(command, args, { cwd, encoding: "utf8", shell: process.platform === "win32" });
    expect(done.status, `${done.stdout}${done.stderr}`).toBe(0);
  };
  // Built beside: the working copy stays as it is.
  const copy = join(project, "client");
  cpSync(client, copy, { recursive: true, filter: path => !path.includes("dist") });
  run(process.execPath, [tsc, "-p", copy], copy);
  run("npm", ["pack", copy, "--ignore-scripts", "--pack-destination", project, "--loglevel", "error"], project);
  writeFileSync(join(project, "package.json"), JSON.stringify({ type: "module", private: true }));
  run("npm", ["install", "--offline", "--no-audit", "--no-fund", "./twincell-client-0.1.0.tgz"], project);
  cpSync(join(client, "examples/session.ts"), join(project, "session.ts"));
  writeFileSync(
    join(project, "tsconfig.json"),
    JSON.stringify({
      compilerOptions: {
        strict: true,
        noEmit: true,
        noUncheckedIndexedAccess: true,
        module: "NodeNext",
        target: "ES2023",
        lib: ["ES2023", "ESNext.Disposable", "DOM", "DOM.Iterable"],
        types: ["node"],
        typeRoots: [join(root, "node_modules/@types")],
      },
      files: ["session.ts"],
    }),
  );
  run(process.execPath, [tsc, "-p", "."], project);

  const studio = mkdtempSync(join(tmpdir(), "twincell-studio-"));
  writeFileSync(join(studio, "index.html"), "<title>studio</title>");
  served = await serve({ studio, port: 0, version: "test", data: mkdtempSync(join(tmpdir(), "twincell-data-")) });
  writeFileSync(join(project, "program.json"), JSON.stringify(program));
  const session = spawn(process.execPath, ["session.ts", served.url, "program.json"], { cwd: project });
  let out = "";
  let errors = "";
  session.stdout.on("data", part => (out += String(part)));
  session.stderr.on("data", part => (errors += String(part)));
  const status = await new Promise(resolve => session.on("close", resolve));
  expect(status, errors).toBe(0);
  const said = JSON.parse(out) as Record<string, unknown>;
  expect(said).toMatchObject({ ok: true, ordered: true, recorded: "MCAP" });
  expect(said["off_rad"]).toBeLessThan((0.001 * Math.PI) / 180);
  expect(said["planned"]).toBeGreaterThan(10);
  expect(said["samples"]).toBeGreaterThan(20);
  expect(said["refused"]).toMatch(/joint 1|J1|S/i);
  expect(said["stopped"]).toMatch(/^\w+\.[\w-]+$/);
  expect(said["judged"]).toMatch(/^\w+\.[\w-]+$/);
}, 90_000);
