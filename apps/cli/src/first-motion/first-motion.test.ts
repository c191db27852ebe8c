/** The first motion of a robot, on a virtual controller in a process of its own, with answers on standard input. */
import { spawn, type ChildProcess } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";
import { afterAll, beforeAll, expect, test } from "vitest";
import { idsOf, type Evidence } from "./evidence.ts";

const root = fileURLToPath(new URL("../../../../", import.meta.url));
const CLI = "apps/cli/src/main.ts";
const HOST = "127.0.0.67";
const folder = mkdtempSync(join(tmpdir(), "twincell-first-"));
let controller: ChildProcess;

beforeAll(async () => {
  controller = spawn(process.execPath, [CLI, "virtual", "ur", "--host", HOST, "--json"], {
    cwd: root,
    stdio: ["pipe", "pipe", "inherit"],
  });
  const lines = createInterface({ input: controller.stdout! })[Symbol.asyncIterator]();
  expect(JSON.parse((await lines.next()).value as string)).toMatchObject({ brand: "ur", host: HOST });
}, 60_000);
afterAll(async () => {
  const ended = new Promise(resolve => controller.once("exit", resolve));
  controller.kill("SIGCONT");
  controller.kill("SIGTERM");
  await ended;
  rmSync(folder, { recursive: true, force: true });
});

/** Answers each question as it comes; `answer` sees the text since the last one. null: nobody answers any more. */
function walk(
  file: string,
  answer: (question: string) => string | null,
): Promise<{ code: number | null; text: string }> {
  const args = ["--at", HOST, "--driver", "ur", "--robot", "ur10e", "--by", "A. Tester", "--to", file];
  const child = spawn(process.execPath, [CLI, "first-motion", ...args], {
    cwd: root,
    stdio: ["pipe", "ignore", "pipe"],
  });
  let text = "";
  let seen = 0;
  child.stderr.on("data", (chunk: Buffer) => {
    text += chunk.toString();
    if (!/(skip|Enter): $/.test(text)) return;
    const question = text.slice(seen);
    seen = text.length;
    const said = answer(question);
    if (said === null) child.stdin.end();
    else child.stdin.write(`${said}\n`);
  });
  return new Promise(resolve => {
    child.once("close", code => {
      resolve({ code, text });
    });
  });
}

test("every joint is turned by 2° and back, a stop on the way stands within 2°, a lost link ends the motion; the file says all of it", async () => {
  const file = join(folder, "evidence.json");
  const { code, text } = await walk(file, question => {
    if (question.includes("Pull the controller's network cable")) {
      // Nothing is heard of a controller that is stopped in the middle of a motion, as with a pulled cable.
      setTimeout(() => {
        controller.kill("SIGSTOP");
        setTimeout(() => controller.kill("SIGCONT"), 2000);
      }, 1000);
    }
    return "yes";
  });
  const evidence = JSON.parse(readFileSync(file, "utf8")) as Evidence;
  expect([code, evidence.verdict], text).toEqual([0, "passed"]);
  expect(evidence).toMatchObject({ by: "A. Tester", driver: "ur", model: "ur10e", virtual: true });
  expect(evidence.steps.map(({ id }) => id)).toEqual(idsOf(6));
  for (const { id, measured } of evidence.steps) {
    if (id.startsWith("joint-")) expect(measured!["off_deg"]).toBeLessThan(0.01);
    if (id === "angles") expect(measured!["q_deg"]).toHaveLength(6);
    if (id === "stop") {
      expect(measured!["travel_deg"]).toBeLessThan(2);
      expect(measured!["took_ms"]).toBeLessThan(1000);
    }
  }
  expect(evidence.steps.at(-1)!.question).toContain("The motion ended");
  expect(readFileSync(file, "utf8")).not.toContain(HOST);
}, 180_000);

test("no at the angles: nothing is commanded, and the file says that it failed", async () => {
  const file = join(folder, "refused.json");
  const { code, text } = await walk(file, question => (question.includes("pendant show") ? "no" : "yes"));
  const evidence = JSON.parse(readFileSync(file, "utf8")) as Evidence;
  expect([code, evidence.verdict], text).toEqual([1, "failed"]);
  expect(evidence.steps.map(({ id, answer }) => [id, answer])).toEqual([
    ["alone", "yes"],
    ["angles", "no"],
  ]);
}, 60_000);

test("an end of the answers in the middle moves nothing more: the next joint is never asked for, and the file is incomplete", async () => {
  const file = join(folder, "left.json");
  const { code, text } = await walk(file, question => (question.includes("Joint 2 ") ? null : "yes"));
  const evidence = JSON.parse(readFileSync(file, "utf8")) as Evidence;
  expect([code, evidence.verdict], text).toEqual([1, "incomplete"]);
  expect(evidence.steps.map(({ id, answer }) => [id, answer])).toEqual([
    ["alone", "yes"],
    ["angles", "yes"],
    ["joint-1", "yes"],
    ["joint-2", "skipped"],
  ]);
  expect(text).toContain("Nobody answers any more");
}, 60_000);

test("a file that is there already is not written over, and nothing is asked", async () => {
  const file = join(folder, "kept.json");
  writeFileSync(file, "somebody's");
  const { code, text } = await walk(file, () => "yes");
  expect(code).toBe(2);
  expect(text).toBe(`twincell: ${file} is there already. Name another file for the evidence.\n`);
  expect(readFileSync(file, "utf8")).toBe("somebody's");
}, 60_000);
