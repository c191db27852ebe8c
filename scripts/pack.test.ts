import { spawn, spawnSync } from "node:child_process";
import {
  copyFileSync,
  existsSync,
  mkdirSync,
  mkdtempSync,
  readFileSync,
  readdirSync,
  rmSync,
  statSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { isAllowed, released } from "./licences.mjs";

const root = fileURLToPath(new URL("..", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "twincell-install-"));
let tarball = "";
const bin = join(folder, "node_modules/twincell/cli/twincell.js");
const env = { PATH: process.env["PATH"] ?? "", HOME: folder };
const MOST_BYTES = 25e6;
/** The studio is built first where it is older than its sources. */
const PACK_MS = 240_000;

const twincell = (...args: string[]) =>
  spawnSync(process.execPath, [bin, ...args], { cwd: folder, env, encoding: "utf8" });
const bytesUnder = (path: string): number =>
  statSync(path).isDirectory()
    ? readdirSync(path).reduce((sum, name) => sum + bytesUnder(join(path, name)), 0)
    : statSync(path).size;

afterAll(() => {
  rmSync(folder, { recursive: true });
});

describe("M-64 the package that npm run pack makes", () => {
  beforeAll(() => {
    const packed = spawnSync(process.execPath, ["scripts/pack.mjs"], { cwd: root, encoding: "utf8" });
    expect(packed.status, packed.stderr).toBe(0);
    tarball = /^(\S+\.tgz):/m.exec(packed.stdout)![1]!;
    writeFileSync(join(folder, "package.json"), '{"private":true}\n');
    const args = ["install", "--offline", "--ignore-scripts", "--no-audit", "--no-fund", tarball];
    const installed = spawnSync("npm", args, { cwd: folder, encoding: "utf8", shell: process.platform === "win32" });
    expect(installed.status, installed.stderr).toBe(0);
  }, PACK_MS);

  test("installs in an empty folder without a network: one package of at most 25 MB, without any other", () => {
    expect(readdirSync(join(folder, "node_modules")).filter(name => !name.startsWith("."))).toEqual(["twincell"]);
    expect(bytesUnder(join(folder, "node_modules/twincell"))).toBeLessThanOrEqual(MOST_BYTES);
    for (const file of ["LICENSE", "README.md", "THIRD-PARTY.md"])
      expect(existsSync(join(folder, "node_modules/twincell", file)), file).toBe(true);
    const linked = join(folder, "node_modules/.bin", process.platform === "win32" ? "twincell.cmd" : "twincell");
    expect(existsSync(linked)).toBe(true);
  });

  test("helps, lists robots, checks and exports the example and executes its text", () => {
    expect(twincell("--help")).toMatchObject({ status: 0, stdout: expect.stringContaining("serve") });
    expect(twincell("robots", "--find", "ur5e").stdout).toContain('"id":"ur5e"');
    const program = join(root, "examples/01-edge-trace/program.json");
    const checked = twincell("check", program, "--cell", join(root, "examples/01-edge-trace/cell.json"));
    expect(checked.status, checked.stderr).toBe(0);
    expect(JSON.parse(checked.stdout)).toMatchObject({ ok: true });
    expect(twincell("post", program, "--to", "v-plus", "-o", "out").status).toBe(0);
    const [written] = readdirSync(join(folder, "out")).filter(name => !name.endsWith(".json"));
    expect(readFileSync(join(folder, "out", written!), "utf8")).toContain(".PROGRAM");
  });

  test("has every worker thread that its code starts beside that code", () => {
    const cli = join(folder, "node_modules/twincell/cli");
    const modules = readdirSync(cli).filter(name => name.endsWith(".js"));
    const started = modules.flatMap(name =>
      [...readFileSync(join(cli, name), "utf8").matchAll(/new URL\(["`]\.\/([^"`]+)["`], ?import\.meta\.url\)/g)].map(
        found => found[1]!,
      ),
    );
    expect(started.length).toBeGreaterThanOrEqual(2);
    for (const name of started) expect(modules, name).toContain(name);
  });

  test("says in one sentence how to add physics, and that benchmarks are in the repository", () => {
    const physics = twincell("validate", "--robot", "ur10e");
    expect(physics.status).toBe(2);
    expect(physics.stderr).toContain("npm install @mujoco/mujoco@");
    expect(physics.stderr.trim().split("\n")).toHaveLength(1);
    expect(twincell("bench")).toMatchObject({ status: 2, stderr: expect.stringContaining("repository") });
  });

  test("serves the studio: / and its scripts answer 200, kernels that are kept packed among them", async () => {
    const server = spawn(process.execPath, [bin, "serve", "--port", "0", "--data", join(folder, "data")], {
      cwd: folder,
      env,
    });
    try {
      const url = await new Promise<string>((resolve, reject) => {
        server.stdout.on("data", (text: Buffer) => {
          const said = /Twincell is at (\S+)/.exec(text.toString());
          if (said) resolve(said[1]!);
        });
        server.on("exit", () => {
          reject(new Error("serve ended before it said where it is"));
        });
      });
      const page = await fetch(url);
      expect(page.status).toBe(200);
      const scripts = [...(await page.text()).matchAll(/(?:src|href)="(\.\/assets\/[^"]+)"/g)].map(found => found[1]!);
      expect(scripts.length).toBeGreaterThan(0);
      for (const script of scripts) expect((await fetch(new URL(script, url))).status, script).toBe(200);
      const assets = readdirSync(join(folder, "node_modules/twincell/studio/assets"));
      const kernel = assets.find(name => name.endsWith(".wasm.br"))!.slice(0, -".br".length);
      const answer = await fetch(new URL(`assets/${kernel}`, url));
      expect(answer.status).toBe(200);
      expect(WebAssembly.validate(await answer.arrayBuffer())).toBe(true);
      // The documentation is part of it, without a network: pages with scripts of this server alone, and a search.
      const docs = await fetch(new URL("docs/", url));
      const text = await docs.text();
      expect([docs.status, text.includes("Start in five minutes")]).toEqual([200, true]);
      expect(/<script(?![^>]*\bsrc=)[^>]*>/.exec(text)).toBeNull();
      const parts = [...text.matchAll(/(?:src|href)="(\/docs\/assets\/[^"]+)"/g)].map(found => found[1]!);
      expect(parts.length).toBeGreaterThan(2);
      for (const part of parts) expect((await fetch(new URL(part, url))).status, part).toBe(200);
      expect((await fetch(new URL("docs/controllers/kuka.html", url))).status).toBe(200);
      expect((await fetch(new URL("docs/controllers/TWINCELL.src", url))).status).toBe(200);
    } finally {
      server.kill();
    }
  });

  test.skipIf(process.platform === "win32")(
    "the install step of the container file installs a command that serves the command line of its last line",
    () => {
      const file = readFileSync(join(root, "Containerfile"), "utf8");
      const step = /^RUN (npm install .*)$/m.exec(file)![1]!.replaceAll("/tmp/", `${folder}/`);
      copyFileSync(tarball, join(folder, "twincell.tgz"));
      mkdirSync(join(folder, "global"));
      const inside = { ...env, npm_config_prefix: join(folder, "global") };
      const made = spawnSync("sh", ["-c", step], { cwd: folder, env: inside, encoding: "utf8" });
      expect(made.status, made.stderr).toBe(0);
      expect(existsSync(join(folder, "twincell.tgz"))).toBe(false);
      const [command, ...args] = JSON.parse(/^CMD (.*)$/m.exec(file)![1]!) as string[];
      const installed = join(folder, "global/bin", command!);
      const help = spawnSync(installed, [args[0]!, "--help"], { env, encoding: "utf8" });
      for (const option of args.filter(arg => arg.startsWith("--"))) expect(help.stdout).toContain(option);
    },
  );

  test("doctor says a line for each thing it looked at", () => {
    const { stdout, status } = twincell("doctor");
    const lines = stdout.trim().split("\n");
    for (const line of lines) expect(line).toMatch(/^(ok|note|bad) +\S.*[.\d]$/);
    expect(lines.some(line => line.includes("npm install occt-import-js@"))).toBe(true);
    expect(status).toBe(lines.some(line => line.startsWith("bad")) ? 1 : 0);
  });
});

test("every part of a release is under a licence that may be in it", () => {
  const parts = released() as readonly { readonly name: string }[];
  expect(parts.length).toBeGreaterThan(50);
  expect(parts.filter(each => !(isAllowed(each) as boolean))).toEqual([]);
});
