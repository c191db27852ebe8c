/** Backups of the data folder of a server that runs and is written to meanwhile. */
import { appendFileSync, existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { emptyProgram } from "@twincell/core";
import { afterEach, expect, test } from "vitest";
import { auditFile, checkBackup, makeBackup, readAudit, restoreBackup, serve, type Served } from "../index.ts";

const studio = mkdtempSync(join(tmpdir(), "twincell-studio-"));
writeFileSync(join(studio, "index.html"), "<title>studio</title>");
const open: Served[] = [];
afterEach(async () => {
  for (const each of open.splice(0)) await each.close();
});
const folder = (): string => mkdtempSync(join(tmpdir(), "twincell-data-"));
const PASSWORD = "correct horse";

test("a backup that is made while the server runs and is written to gives back its people, programs and an unbroken log in another folder; a half one, a changed one, one of a later release and a folder that is not empty are refused with a sentence", async () => {
  const data = folder();
  const first = await serve({ studio, port: 0, version: "test", data, accounts: true });
  open.push(first);
  const link = new URL(first.setUp!).searchParams.get("invitation");
  const post = (served: Served, path: string, method: string, body: unknown, cookie = "") =>
    fetch(new URL(path, served.url), {
      method,
      body: JSON.stringify(body),
      headers: { "content-type": "application/json", cookie },
    });
  const entered = await post(first, "/api/v1/invitation", "POST", { link, name: "Ada", password: PASSWORD });
  const [cookie = ""] = (entered.headers.get("set-cookie") ?? "").split(";");
  let kept = 0;
  let stop = false;
  const writing = (async () => {
    while (!stop) {
      const { status } = await post(first, `/api/v1/programs/p${kept}`, "PUT", emptyProgram("ur10e"), cookie);
      expect(status).toBe(200);
      kept++;
    }
  })();
  while (kept < 5) await new Promise(resolve => setImmediate(resolve));
  const before = kept;
  const to = join(folder(), "backup");
  const made = await makeBackup(data, to, new Date());
  stop = true;
  await writing;
  expect(made.files.filter(({ path }) => path.startsWith("programs/")).length).toBeGreaterThanOrEqual(before);
  expect(made.files.some(({ path }) => path === "audit.lock" || path.endsWith(".new"))).toBe(false);

  const elsewhere = join(folder(), "restored");
  await restoreBackup(to, elsewhere);
  expect(readAudit(readFileSync(auditFile(elsewhere), "utf8")).verdict.kind).toBe("whole");
  const second = await serve({ studio, port: 0, version: "test", data: elsewhere });
  open.push(second);
  expect((await post(second, "/api/v1/session", "POST", { name: "Ada", password: PASSWORD })).status).toBe(200);
  await expect(restoreBackup(to, elsewhere)).rejects.toThrow("is not empty");
  await expect(makeBackup(data, to, new Date())).rejects.toThrow("is not empty");

  const at = join(to, "files", "programs/p0.json");
  appendFileSync(at, " ");
  await expect(checkBackup(to)).rejects.toThrow(/programs\/p0\.json has \d+ of \d+ bytes/);
  writeFileSync(at, readFileSync(join(data, "programs/p0.json"), "utf8").replace("ur10e", "ur10f"));
  await expect(checkBackup(to)).rejects.toThrow("programs/p0.json was changed");
  const list = JSON.parse(readFileSync(join(to, "backup.json"), "utf8")) as object;
  writeFileSync(join(to, "backup.json"), JSON.stringify({ ...list, version: 2 }));
  await expect(checkBackup(to)).rejects.toThrow("is of version 2; this release reads version 1");
  rmSync(join(to, "backup.json"));
  const nowhere = join(folder(), "nowhere");
  await expect(restoreBackup(to, nowhere)).rejects.toThrow("is no backup, or half of one");
  expect(existsSync(nowhere)).toBe(false);
}, 60_000);
