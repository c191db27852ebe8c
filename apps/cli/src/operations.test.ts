/** Settings by file and environment, the systemd unit, and a server that is ended as a plant ends it. */
import { spawn, spawnSync } from "node:child_process";
import { once } from "node:events";
import { mkdtempSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";
import { emptyProgram } from "@twincell/core";
import { expect, test } from "vitest";
import { serveCommand } from "./commands/serve.ts";
import { environmentName, SERVE_OPTIONS, serveArguments, settingsTable } from "./io/serve-options.ts";

const root = fileURLToPath(new URL("../../../", import.meta.url));
const main = join(root, "apps/cli/src/main.ts");
const folder = (): string => mkdtempSync(join(tmpdir(), "twincell-operations-"));
const file = (value: unknown): string => {
  const path = join(folder(), "twincell.json");
  writeFileSync(path, typeof value === "string" ? value : JSON.stringify(value));
  return path;
};

test("settings: the command line wins over the environment, the environment over the file; the table of the documentation has every one", () => {
  const path = file({ port: 1, data: "/a", lan: true, robots: ["192.0.2.5", "192.0.2.6"], site: "file" });
  const env = { TWINCELL_SERVE_PORT: "2", TWINCELL_SERVE_LAN: "false", TWINCELL_SERVE_NATS_HOURS: "3" };
  expect(serveArguments(["--config", path, "--port", "3"], env)).toEqual([
    "--port=2",
    "--data=/a",
    "--robots=192.0.2.5,192.0.2.6",
    "--site=file",
    "--nats-hours=3",
    "--port",
    "3",
  ]);
  expect(serveArguments([], { TWINCELL_SERVE_CONFIG: path })).toContain("--lan");
  expect(readFileSync(join(root, "docs/operations.md"), "utf8")).toContain(settingsTable());
  for (const { name } of SERVE_OPTIONS) expect(serveCommand.usage).toContain(`--${name}`);
  expect(environmentName("nats-hours")).toBe("TWINCELL_SERVE_NATS_HOURS");
});

test.each([
  [{ prot: 1 }, {}, "there is no setting “prot”"],
  [{ port: "1" }, {}, '“port” wants a number, not "1"'],
  [{ lan: 1 }, {}, "“lan” wants true or false, not 1"],
  ["[1]", {}, "a file of settings is an object"],
  ["{", {}, "it cannot be read"],
  [{}, { TWINCELL_SERVE_PROT: "1" }, "TWINCELL_SERVE_PROT, which is no setting"],
  [{}, { TWINCELL_SERVE_LAN: "perhaps" }, "TWINCELL_SERVE_LAN wants true or false, not “perhaps”"],
  [{}, { TWINCELL_SERVE_PORT: "x" }, "TWINCELL_SERVE_PORT wants a number"],
])("a setting that is none is refused with its place: %j %j", (value, env, sentence) => {
  expect(() => serveArguments(["--config", file(value)], env)).toThrow(sentence);
});

test("the systemd unit is one that systemd reads, and a path it would read otherwise is refused", () => {
  const unit = spawnSync(process.execPath, [main, "service", "--data", "/var/lib/twincell", "--user", "root"], {
    encoding: "utf8",
  });
  expect(unit.status, unit.stderr).toBe(0);
  expect(unit.stdout).toContain(`ExecStart=${process.execPath} ${main} serve --log=json --data=/var/lib/twincell`);
  const path = join(folder(), "twincell.service");
  writeFileSync(path, unit.stdout);
  const verified = spawnSync("systemd-analyze", ["verify", "--man=no", "--recursive-errors=no", path], {
    encoding: "utf8",
  });
  // Where there is no systemd the unit's text is all that can be looked at.
  if (!verified.error)
    expect(verified.stderr.split("\n").filter(line => line.includes("twincell.service"))).toEqual([]);
  const bad = spawnSync(process.execPath, [main, "service", "--data", "/a b%n"], { encoding: "utf8" });
  expect(bad.status).toBe(2);
  expect(bad.stderr).toContain("reads otherwise");
});

test("SIGTERM while a robot moves: it is stopped and stands before the server ends with 0; the log is JSON lines without the link of the first admin", async () => {
  const data = folder();
  const studio = folder();
  writeFileSync(join(studio, "index.html"), "<title>studio</title>");
  const config = file({ port: 0, data, studio, accounts: true, log: "json" });
  const server = spawn(process.execPath, [main, "serve", "--config", config], { stdio: ["ignore", "pipe", "pipe"] });
  let errors = "";
  server.stderr.on("data", part => (errors += String(part)));
  const lines: Record<string, unknown>[] = [];
  const raw: string[] = [];
  let url = "";
  const listening = new Promise<void>((resolve, reject) => {
    createInterface(server.stdout).on("line", line => {
      raw.push(line);
      const said = JSON.parse(line) as Record<string, unknown>;
      lines.push(said);
      if (said["event"] === "secret") resolve();
      if (said["event"] === "listening") url = String(said["url"]);
    });
    server.once("exit", () => {
      reject(new Error(errors));
    });
  });
  const ended = once(server, "exit");
  try {
    await listening;
    const link = new URL(readFileSync(join(data, "set-up-link.txt"), "utf8").trim()).searchParams.get("invitation")!;
    expect(statSync(join(data, "set-up-link.txt")).mode & 0o077).toBe(0);
    let cookie = "";
    let lease = "";
    const ask = async (method: string, path: string, body?: unknown): Promise<{ status: number; value: object }> => {
      const answer = await fetch(new URL(`/api/v1${path}`, url), {
        method,
        headers: { cookie, "twincell-lease": lease, "content-type": "application/json" },
        ...(body === undefined ? {} : { body: JSON.stringify(body) }),
      });
      cookie = (answer.headers.get("set-cookie") ?? cookie).split(";")[0]!;
      return { status: answer.status, value: (await answer.json()) as object };
    };
    await ask("POST", "/invitation", { link, name: "Ada", password: "correct horse" });
    await ask("POST", "/robots", { id: "arm", driver: "yaskawa", model: "yaskawa_gp8" });
    lease = ((await ask("POST", "/robots/arm/lease", {})).value as { lease: string }).lease;
    expect((await ask("POST", "/robots/arm/connect")).status).toBe(200);
    await ask("POST", "/robots/arm/confirm");
    expect((await ask("PUT", "/programs/p", emptyProgram("yaskawa_gp8"))).status).toBe(200);
    // No sample has come yet in the first moments of a connection.
    const moves = async (): Promise<boolean> =>
      ((await ask("GET", "/robots/arm/state")).value as { sample: { moving: boolean } | null }).sample?.moving === true;
    await ask("POST", "/robots/arm/speed", { percent: 10 });
    const motion = ask("POST", "/robots/arm/move", { q_rad: [1.5, 0, 0, 0, 0, 0] }).catch(() => null);
    while (!(await moves())) await new Promise(setImmediate);
    server.kill("SIGTERM");
    const outcome = await motion;
    expect(outcome === null || outcome.status === 409).toBe(true);
    expect(await ended).toEqual([0, null]);
    expect(errors).toBe("");
    const closing = lines.filter(({ event }) => event === "closing");
    expect(closing.map(({ level }) => level)).toEqual(["info"]);
    expect(lines.some(({ event, who }) => event === "act" && String(who).startsWith("Ada"))).toBe(true);
    for (const line of lines) expect(Number.isNaN(Date.parse(String(line["time"])))).toBe(false);
    expect(raw.join("\n")).not.toContain(link);
    expect(raw.join("\n")).not.toContain(lease);
  } finally {
    server.kill("SIGKILL");
  }
}, 40_000);
