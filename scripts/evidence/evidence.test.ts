import { spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { afterAll, expect, test } from "vitest";
import { EVIDENCE, scriptsOf } from "./list.mjs";
import { dateOf, evidenceStates, stateSentence } from "./state.mjs";

const root = fileURLToPath(new URL("../../", import.meta.url));
const folder = `${mkdtempSync(join(tmpdir(), "twincell-evidence-"))}/`;
afterAll(() => {
  rmSync(folder, { recursive: true, force: true });
});
const git = (day: string, ...args: readonly string[]): void => {
  const env = { ...process.env, GIT_COMMITTER_DATE: `${day}T12:00:00Z`, GIT_AUTHOR_DATE: `${day}T12:00:00Z` };
  const identity = ["-c", "user.name=test", "-c", "user.email=test@localhost"];
  expect(spawnSync("git", [...identity, ...args], { cwd: folder, env }).status).toBe(0);
};

test("every soak script and the public programs are evidence, and every entry's script is there", () => {
  expect(scriptsOf(EVIDENCE, root)).toEqual([]);
  const helpers = ["kept"];
  const soaks = readdirSync(`${root}scripts/soak`)
    .filter(file => file.endsWith(".ts") && !file.endsWith(".test.ts"))
    .map(file => file.slice(0, -3))
    .filter(name => !helpers.includes(name));
  expect(EVIDENCE.map(each => each.name)).toEqual(expect.arrayContaining(soaks));
});

test("a result is missing without a file, older when its code changed on a later day, current otherwise; a changed test changes nothing", () => {
  mkdirSync(`${folder}code`);
  git("2026-01-01", "init", "-q");
  writeFileSync(`${folder}code/a.ts`, "1");
  git("2026-01-01", "add", ".");
  git("2026-01-01", "commit", "-qm", "a");
  const of = (result: string) =>
    evidenceStates([{ name: "soak", result, command: [], judges: ["code"] }], folder).map(state => state.level);
  expect(of("none.json")).toEqual(["missing"]);
  writeFileSync(`${folder}undated.json`, "{}");
  expect(of("undated.json")).toEqual(["missing"]);
  writeFileSync(`${folder}result.json`, '{"date": "2026-02-01T10:00:00Z", "parts": {"a": {"date": "2026-01-20"}}}');
  expect(of("result.json")).toEqual(["current"]);
  writeFileSync(`${folder}code/a.test.ts`, "1");
  git("2026-03-01", "add", ".");
  git("2026-03-01", "commit", "-qm", "test");
  expect(of("result.json")).toEqual(["current"]);
  writeFileSync(`${folder}code/a.ts`, "2");
  git("2026-03-02", "add", ".");
  git("2026-03-02", "commit", "-qm", "b");
  const [state] = evidenceStates([{ name: "soak", result: "result.json", command: [], judges: ["code"] }], folder);
  expect(stateSentence(state!)).toBe(
    "soak: made 2026-02-01, code changed 2026-03-02; npm run evidence -- soak makes it anew.",
  );
});

test("the newest date of a result counts", () => {
  expect(dateOf('{"a": {"date": "2026-01-02"}, "b": {"date": "2026-01-03"}}')).toBe("2026-01-03");
  expect(dateOf("{}")).toBeUndefined();
});
