/** What a server says of disks, clocks and folders that are not as they should be. */
import { existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { emptyProgram } from "@twincell/core";
import { afterEach, expect, test } from "vitest";
import { addToken, jsonLog, serve, withoutSecrets, type Served } from "../index.ts";

const studio = mkdtempSync(join(tmpdir(), "twincell-studio-"));
writeFileSync(join(studio, "index.html"), "<title>studio</title>");
const open: Served[] = [];
afterEach(async () => {
  for (const each of open.splice(0)) await each.close();
});
const folder = (): string => mkdtempSync(join(tmpdir(), "twincell-data-"));
const heard: string[] = [];
async function started(data: string): Promise<Served> {
  heard.length = 0;
  const log = jsonLog(line => heard.push(line), Date.now);
  const served = await serve({ studio, port: 0, version: "9.9.9", data, log });
  open.push(served);
  return served;
}

test("a data folder of a later release is refused with both versions, and nothing in it is touched", async () => {
  const data = folder();
  const later = JSON.stringify({ format: "twincell.data", version: 2, release: "10.0.0", seen_ms: 0 });
  writeFileSync(join(data, "folder.json"), later);
  await expect(started(data)).rejects.toThrow(
    "is of version 2, written by Twincell 10.0.0; this release reads versions up to 1",
  );
  expect(readdirSync(data)).toEqual(["folder.json"]);
  expect(readFileSync(join(data, "folder.json"), "utf8")).toBe(later);
});

test("a clock that is behind what the folder has seen is said, and a token that had ended by then stays ended", async () => {
  const data = folder();
  const seen_ms = Date.now() + 3 * 3_600_000;
  const kept = { format: "twincell.data", version: 1, release: "1.0.0", seen_ms };
  writeFileSync(join(data, "folder.json"), JSON.stringify(kept));
  const ended = addToken(data, "old", "viewer", new Date(seen_ms - 3_600_000))!;
  const good = addToken(data, "new", "viewer", new Date(seen_ms + 3_600_000))!;
  const served = await started(data);
  expect(heard.join("")).toContain("The clock of this machine is 180 min behind");
  const ask = async (token: string) => {
    const answer = await fetch(new URL("/api/v1/robots", served.url), {
      headers: { authorization: `Bearer ${token}` },
    });
    return [answer.status, await answer.text()] as const;
  };
  expect((await ask(good))[0]).toBe(200);
  const [status, text] = await ask(ended);
  expect(status).toBe(401);
  expect(text).toContain("The token of old has ended.");
});

test.skipIf(!existsSync("/dev/full"))(
  "a full disk: a program is refused in one sentence and stays as it was",
  async () => {
    const data = folder();
    const served = await started(data);
    const put = async (robot: string) => {
      const body = JSON.stringify(emptyProgram(robot));
      const headers = { "content-type": "application/json" };
      const answer = await fetch(new URL("/api/v1/programs/p", served.url), { method: "PUT", headers, body });
      return { status: answer.status, body: (await answer.json()) as unknown };
    };
    expect((await put("ur10e")).status).toBe(200);
    mkdirSync(join(data, "programs"), { recursive: true });
    // Whatever is written there meets a disk without room.
    symlinkSync("/dev/full", join(data, "programs", `p.json.${process.pid}.new`));
    expect(await put("ur5e")).toEqual({
      status: 507,
      body: {
        kind: "refused",
        why: {
          code: "server.disk",
          sentence: "Nothing was kept: the disk is full.",
          hint: "Make room in the data folder of the server, and ask again.",
        },
      },
    });
    expect(readFileSync(join(data, "programs/p.json"), "utf8")).toContain("ur10e");
    expect((await put("ur5e")).status).toBe(200);
  },
);

test("codes, links, tokens and passwords are in no line of a log", () => {
  const lines: string[] = [];
  const log = jsonLog(
    line => lines.push(line),
    () => 0,
  );
  const secret = "s3cr3t-Value_1";
  for (const text of [
    `http://127.0.0.1/?code=${secret}`,
    `http://h/?a=1&token=${secret}&b`,
    `authorization: Bearer ${secret}`,
    `twincell_${secret}`,
    `mqtt://user:${secret}@broker:1883`,
    `{"password":"${secret}"}`,
  ])
    log.say("info", "x", text, { more: text });
  expect(lines.join("")).not.toContain(secret);
  expect(JSON.parse(lines[0]!)).toEqual({
    time: "1970-01-01T00:00:00.000Z",
    level: "info",
    event: "x",
    sentence: "http://127.0.0.1/?code=***",
    more: "http://127.0.0.1/?code=***",
  });
  expect(withoutSecrets("Link 3 touches the table.")).toBe("Link 3 touches the table.");
});
