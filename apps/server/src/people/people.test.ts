import { spawnSync } from "node:child_process";
import { once } from "node:events";
import { appendFileSync, mkdtempSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { emptyProgram } from "@twincell/core";
import { SOCKETS } from "@twincell/protocol";
import { afterEach, expect, test } from "vitest";
import { WebSocket } from "ws";
import { addToken, auditFile, openAuditLog, readAudit, removeToken, serve, type Served } from "../index.ts";
import { ROLES } from "./tokens.ts";

const root = fileURLToPath(new URL("../../../../", import.meta.url));
const studio = mkdtempSync(join(tmpdir(), "twincell-studio-"));
writeFileSync(join(studio, "index.html"), "<title>studio</title>");
const open: { close(): unknown }[] = [];
afterEach(async () => {
  for (const each of open.splice(0).reverse()) await each.close();
});
const folder = (): string => mkdtempSync(join(tmpdir(), "twincell-data-"));
async function server(data: string): Promise<Served> {
  const served = await serve({ studio, port: 0, version: "test", data });
  open.push(served);
  return served;
}
const ask = async (served: Served, token: string | null, method: string, path: string, body?: unknown) => {
  const response = await fetch(new URL(path, served.url), {
    method,
    headers: {
      ...(token === null ? {} : { authorization: `Bearer ${token}` }),
      ...(body === undefined ? {} : { "content-type": "application/json" }),
    },
    ...(body === undefined ? {} : { body: JSON.stringify(body) }),
  });
  return { status: response.status, body: (await response.json()) as Record<string, unknown> };
};
const written = (data: string) => readAudit(readFileSync(auditFile(data), "utf8"));
const arm = { id: "arm", driver: "ur", model: "ur10e" };
const act = { who: "Ada", action: "moves the joints", robot: "arm", detail: "", outcome: "done" };

test("a token may do what its role says and nothing else: all look and stop, programmers keep programs, operators open robots, admins do both", async () => {
  const data = folder();
  const served = await server(data);
  for (const role of ROLES) {
    const token = addToken(data, role, role, null)!;
    const status = async (method: string, path: string, body?: unknown) =>
      (await ask(served, token, method, path, body)).status;
    expect(await status("GET", "/api/v1/robots"), role).toBe(200);
    expect(await status("POST", "/api/v1/stop", {}), role).toBe(200);
    expect(await status("PUT", "/api/v1/programs/a", emptyProgram("ur10e")), role).toBe(
      role === "programmer" || role === "admin" ? 200 : 403,
    );
    expect(await status("POST", "/api/v1/robots", { ...arm, id: role }), role).toBe(
      role === "operator" || role === "admin" ? 200 : 403,
    );
  }
}, 60_000);

test("a token that is unknown, was taken back or has ended is refused with one sentence at the next request; only its hash is on the disk", async () => {
  const data = folder();
  const served = await server(data);
  expect((await ask(served, "twincell_forged", "GET", "/api/v1/robots")).status).toBe(401);
  const token = addToken(data, "Ada", "viewer", null)!;
  const ended = addToken(data, "Old", "admin", new Date(Date.now() - 1000))!;
  expect((await ask(served, token, "GET", "/api/v1/robots")).status).toBe(200);
  expect(await ask(served, ended, "GET", "/api/v1/robots")).toMatchObject({
    status: 401,
    body: { why: { sentence: "The token of Old has ended." } },
  });
  expect(addToken(data, "Ada", "admin", null)).toBeNull();
  const kept = readFileSync(join(data, "tokens.json"), "utf8");
  expect(kept).not.toContain(token);
  expect(statSync(join(data, "tokens.json")).mode & 0o077).toBe(0);
  expect(removeToken(data, "Ada")).toBe(true);
  expect((await ask(served, token, "GET", "/api/v1/robots")).status).toBe(401);
  const again = addToken(data, "Ada", "viewer", null)!;
  expect((await ask(served, again, "GET", "/api/v1/robots")).status).toBe(200);
  writeFileSync(join(data, "tokens.json"), "{ half");
  expect((await ask(served, again, "GET", "/api/v1/robots")).status).toBe(401);
});

test("by socket a viewer's token opens the read-only stream and not the one that commands", async () => {
  const data = folder();
  const served = await server(data);
  const opens = (token: string, path: string): Promise<boolean> =>
    new Promise(resolve => {
      const socket = new WebSocket(new URL(path, served.url.replace(/^http/, "ws")), {
        headers: { authorization: `Bearer ${token}` },
      });
      socket.on("open", () => {
        socket.terminate();
        resolve(true);
      });
      socket.on("error", () => {
        resolve(false);
      });
    });
  const viewer = addToken(data, "Vera", "viewer", null)!;
  const operator = addToken(data, "Otto", "operator", null)!;
  expect(await opens(viewer, "/api/v1/stream")).toBe(true);
  expect(await opens(viewer, "/stations")).toBe(false);
  expect(await opens(operator, "/stations")).toBe(true);
  expect(await opens("twincell_forged", "/api/v1/stream")).toBe(false);
});

test("a token that is taken back, and one that ends, closes the sockets it opened within two seconds; others stay", async () => {
  const data = folder();
  const served = await server(data);
  const soon = addToken(data, "Soon", "viewer", new Date(Date.now() + 1500))!;
  const tokens = [addToken(data, "Ada", "operator", null)!, soon, addToken(data, "Bea", "operator", null)!];
  const url = served.url.replace(/^http/, "ws");
  const sockets = await Promise.all(
    tokens.map(async (token, i) => {
      const path = i === 1 ? SOCKETS.stream : SOCKETS.commands;
      const socket = new WebSocket(new URL(path, url), { headers: { authorization: `Bearer ${token}` } });
      open.push(socket);
      await once(socket, "open");
      return socket;
    }),
  );
  const [ada, ended, bea] = sockets as [WebSocket, WebSocket, WebSocket];
  expect(removeToken(data, "Ada")).toBe(true);
  const began_ms = Date.now();
  const codes = await Promise.all([once(ada, "close"), once(ended, "close")]);
  expect(codes.map(([code]) => code as number)).toEqual([4401, 4401]);
  expect(Date.now() - began_ms).toBeLessThan(3500);
  expect(bea.readyState).toBe(WebSocket.OPEN);
}, 20_000);

test("what people do is in the log under the names of their tokens, the refused too; nobody commands under another's name", async () => {
  const data = folder();
  const served = await server(data);
  const ada = addToken(data, "Ada", "operator", null)!;
  const vera = addToken(data, "Vera", "viewer", null)!;
  expect((await ask(served, ada, "POST", "/api/v1/robots", arm)).status).toBe(200);
  expect((await ask(served, ada, "POST", "/api/v1/robots/arm/lease", { who: "Bob" })).body["who"]).toMatch(
    /^Bob of Ada /,
  );
  expect((await ask(served, vera, "POST", "/api/v1/robots/arm/lease", {})).status).toBe(403);
  expect((await ask(served, vera, "POST", "/api/v1/robots/arm/stop", {})).status).toBe(200);
  const { lines, verdict } = written(data);
  expect(verdict).toMatchObject({ kind: "whole", lines: lines.length });
  expect(lines).toContainEqual(
    expect.objectContaining({
      who: expect.stringMatching(/^Bob of Ada /) as string,
      action: "takes the lease",
      robot: "arm",
      outcome: "done",
    }),
  );
  expect(lines).toContainEqual(expect.objectContaining({ who: "Vera", action: "is turned away", outcome: "refused" }));
  expect(lines).toContainEqual(
    expect.objectContaining({ who: "Vera", action: "stops the robot", robot: "arm", outcome: "done" }),
  );
  expect(JSON.stringify(lines)).not.toContain(ada);
});

test("a line of the log that was changed, taken out or put in is named; what a crash left unfinished is taken away and said", () => {
  const data = folder();
  const log = openAuditLog(data, () => 0);
  for (let i = 0; i < 5; i++) log.write({ ...act, detail: `to ${i}` });
  log.close();
  const text = readFileSync(auditFile(data), "utf8");
  expect(readAudit(text).verdict).toMatchObject({ kind: "whole", lines: 5 });
  const lines = text.trim().split("\n");
  const broken = (changed: string[]) => readAudit(`${changed.join("\n")}\n`).verdict;
  expect(broken(lines.map((line, i) => (i === 2 ? line.replace("Ada", "Eve") : line)))).toMatchObject({
    kind: "broken",
    line: 3,
  });
  expect(broken(lines.filter((_, i) => i !== 1))).toMatchObject({ kind: "broken", line: 2 });
  expect(broken(lines.toSpliced(3, 0, lines[2]!))).toMatchObject({ kind: "broken", line: 4 });
  appendFileSync(auditFile(data), '{"number":6,"ti');
  const again = openAuditLog(data, () => 0);
  again.write(act);
  again.close();
  const after = written(data);
  expect(after.verdict).toMatchObject({ kind: "whole", lines: 7 });
  expect(after.lines[5]).toMatchObject({ who: "server", action: "takes an unfinished line away" });
  writeFileSync(auditFile(data), text.replace("to 3", "to 9"));
  expect(() => openAuditLog(data, () => 0)).toThrow(/line 4/);
});

test("a second server of one data folder is refused with a sentence; the lock of a process that is gone is not", () => {
  const data = folder();
  const first = openAuditLog(data, () => 0);
  expect(() => openAuditLog(data, () => 0)).toThrow(/Another server \(process \d+\) uses the data folder/);
  first.close();
  writeFileSync(join(data, "audit.lock"), String(process.pid));
  openAuditLog(data, () => 0).close();
  const gone = spawnSync(process.execPath, ["-e", "console.log(process.pid)"], { encoding: "utf8" }).stdout.trim();
  writeFileSync(join(data, "audit.lock"), gone);
  openAuditLog(data, () => 0).close();
});

test("on the command line a token is made, listed and removed, and the log is read and judged", () => {
  const data = folder();
  const twincell = (...args: string[]) =>
    spawnSync(process.execPath, ["apps/cli/src/main.ts", ...args, "--data", data], { cwd: root, encoding: "utf8" });
  const added = twincell("token", "add", "Ada", "--role", "operator", "--days", "30");
  expect(added.stdout).toMatch(/^twincell_[\w-]{43}\n$/);
  expect(JSON.parse(twincell("token", "list").stdout)).toMatchObject({ name: "Ada", role: "operator" });
  expect(twincell("token", "add", "Bob", "--role", "king")).toMatchObject({ status: 2, stdout: "" });
  expect(twincell("token", "remove", "Ada").status).toBe(0);
  expect(twincell("token", "remove", "Ada").status).toBe(1);
  const log = openAuditLog(data, () => 0);
  log.write(act);
  log.write({ ...act, who: "Bob" });
  log.close();
  const read = twincell("audit", "--who", "Bob");
  expect(read.status).toBe(0);
  expect(JSON.parse(read.stdout)).toMatchObject({ number: 2, who: "Bob" });
  writeFileSync(auditFile(data), readFileSync(auditFile(data), "utf8").replace("Bob", "Eve"));
  expect(twincell("audit")).toMatchObject({ status: 1, stderr: expect.stringContaining("line 2") as string });
}, 60_000);
