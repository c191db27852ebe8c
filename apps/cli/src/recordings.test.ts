import { spawn, spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { robotById } from "@twincell/core";
import { serve } from "@twincell/server";
import { afterAll, beforeAll, expect, test } from "vitest";
import { killOnce } from "../../../scripts/soak/kill-recorder.ts";
import { stateLines } from "./io/state-lines.ts";

const root = fileURLToPath(new URL("../../../", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "twincell-recordings-"));
afterAll(() => {
  rmSync(folder, { recursive: true, force: true });
});

function twincell(args: readonly string[], input = "") {
  const run = spawnSync(process.execPath, ["apps/cli/src/main.ts", ...args], {
    cwd: root,
    encoding: "utf8",
    input,
    maxBuffer: 1 << 28,
  });
  return { code: run.status ?? -1, out: run.stdout, err: run.stderr };
}
interface Line {
  t: number;
  q: number[];
  io: Record<string, unknown>;
  step: string;
  position: number[];
  safety: string;
  sentence?: string;
  kind?: string;
}
const lines = (text: string): Line[] =>
  text
    .trim()
    .split("\n")
    .map(line => JSON.parse(line) as Line);
const file = join(folder, "run.mcap");
let simulated: Line[];

beforeAll(() => {
  const run = twincell([
    "simulate",
    "examples/01-edge-trace/program.json",
    "--cell",
    "examples/01-edge-trace/cell.json",
    "--period",
    "0.02",
  ]);
  simulated = lines(run.out);
  const kept = twincell(["record", "--to", file, "--robot", "staubli_rx90l", "--cell", "Edge trace"], run.out);
  expect({ code: kept.code, err: kept.err }).toEqual({
    code: 0,
    err: `Recording Stäubli RX90L to ${file}.\n${simulated.length} samples recorded.\n`,
  });
}, 60_000);

test("X-43 what simulate wrote is recorded, and replay gives the same stream", () => {
  const { code, out, err } = twincell(["replay", file]);
  const replayed = lines(out);
  expect({ code, err }).toEqual({ code: 0, err: "" });
  const byTime = new Map(replayed.map(line => [line.t.toFixed(3), line]));
  let held = replayed[0]!;
  for (const line of simulated) {
    // Samples that are alike are kept once: what was there before them holds.
    held = byTime.get(line.t.toFixed(3)) ?? held;
    line.q.forEach((q, joint) => {
      expect(Math.abs(held.q[joint]! - q)).toBeLessThan(1e-6);
    });
    expect({ step: held.step, io: held.io }).toEqual({ step: line.step, io: line.io });
  }
  const part = lines(twincell(["replay", file, "--from", "1", "--until", "2", "--period", "0.1"]).out);
  expect(part.map(line => line.t)).toEqual(Array.from({ length: 11 }, (_, i) => Number((1 + 0.1 * i).toFixed(6))));
  expect(part[3]!.q[0]).toBeCloseTo(simulated.find(line => Math.abs(line.t - 1.3) < 1e-9)!.q[0]!, 6);
});

test("a folder takes file after file; alarms are marks, and replay begins before the last one", () => {
  const stream = Array.from({ length: 4000 }, (_, k) =>
    JSON.stringify({
      t: k / 100,
      q: [Math.sin(k / 100), 0, 0, 0, 0, 0],
      step: "a",
      safety: k === 3000 ? "protective-stop" : "normal",
      message: k === 3000 ? "Contact." : "",
    }),
  );
  stream.splice(
    100,
    0,
    JSON.stringify({ event: { code: "shift", level: "info", sentence: "The late shift begins." } }),
  );
  const day = join(folder, "day");
  const { code, err } = twincell(
    ["record", "--to", `${day}/`, "--robot", "ur10e", "--file-mb", "0.05"],
    stream.join("\n"),
  );
  expect(code).toBe(0);
  expect(err).toContain(
    "A new file begins every 1 h or 0.05 MB; files go after 30 days, the oldest also when all pass 20 GB.",
  );
  expect(readdirSync(day).length).toBeGreaterThan(2);
  const marks = lines(twincell(["replay", day, "--marks"]).out);
  expect(marks.filter(mark => mark.kind === "alarm")).toMatchObject([{ sentence: "Contact." }]);
  expect(marks).toContainEqual(
    expect.objectContaining({ kind: "event", code: "shift", sentence: "The late shift begins." }),
  );
  const alarm = marks.find(mark => mark.kind === "alarm")!;
  const before = lines(twincell(["replay", day, "--from", "alarm"]).out);
  expect(Math.abs(before[0]!.t - (alarm.t - 10))).toBeLessThan(0.03);
  expect(before.some(line => line.safety === "protective-stop")).toBe(true);
});

test("wrong use and unreadable input: exit 2 with the line, and what came before is kept", { timeout: 60_000 }, () => {
  const bad = join(folder, "bad.mcap");
  const stream = [
    ...Array.from({ length: 50 }, (_, k) => JSON.stringify({ t: k, q: [0, 0, 0, 0, 0, k / 100] })),
    '{"t":50,"q":[1,2]}',
  ].join("\n");
  const recorded = twincell(["record", "--to", bad, "--robot", "ur10e"], stream);
  expect(recorded.code).toBe(2);
  expect(recorded.err).toContain("Line 51: Universal Robots UR10e has 6 joints but 2 angles were given.");
  expect(lines(twincell(["replay", bad]).out).at(-1)).toMatchObject({ t: 49 });
  expect(twincell(["record", "--to", join(folder, "x.mcap"), "--robot", "ur10e"], "{").err).toMatch(
    /Line 1 is not JSON/,
  );
  const read =
    (...values: unknown[]) =>
    () => {
      const next = stateLines(robotById("ur10e")!);
      values.forEach((value, i) => next(value, i + 1));
    };
  expect(read([1])).toThrow("Line 1 wants an object");
  expect(read({ q: [0, 0, 0, 0, 0, 0] })).toThrow('Line 1 wants "t"');
  expect(read({ t: 2, q: [0, 0, 0, 0, 0, 0] }, { t: 1, q: [0, 0, 0, 0, 0, 0] })).toThrow(
    "Line 2: the time goes back from 2 s to 1 s.",
  );
  expect(twincell(["record", "--to", bad, "--robot", "ur10e"])).toMatchObject({
    code: 2,
    err: `twincell: ${bad} is already there. Give another name; recordings are not written over.\n`,
  });
  const letter = join(folder, "letter.mcap");
  writeFileSync(letter, "Dear Sir or Madam");
  expect(twincell(["replay", letter])).toMatchObject({
    code: 2,
    err: `twincell: ${letter} is no recording. The file does not begin like an MCAP file.\n`,
  });
  mkdirSync(join(folder, "none"));
  expect(twincell(["replay", join(folder, "none")]).err).toBe(
    `twincell: ${join(folder, "none")} is no recording. There is no recording here.\n`,
  );
  expect(twincell(["replay", file, "--from", "1e9"]).err).toMatch(/lies behind its end/);
});

test("a recording that was cut off replays up to where it ends, and says so", () => {
  const cut = join(folder, "cut.mcap");
  const bytes = readFileSync(file);
  writeFileSync(cut, bytes.subarray(0, Math.floor(bytes.length * 0.7)));
  const { code, out, err } = twincell(["replay", cut]);
  expect({ code, err }).toEqual({
    code: 0,
    err: "twincell: cut.mcap was cut off; it is here up to its last second.\n",
  });
  expect(lines(out).length).toBeGreaterThan(simulated.length / 3);
});

test("kill -9 costs less than a second, and leaves no hole", async () => {
  for (const after_s of [1.3, 2.1]) {
    const { lost_s, whole } = await killOnce(after_s);
    expect(lost_s).toBeLessThan(1);
    expect(whole).toBe(true);
  }
}, 60_000);

test("T-61 the stations of a server are recorded from outside, until it goes", async () => {
  const studio = mkdtempSync(join(folder, "studio-"));
  writeFileSync(join(studio, "index.html"), "");
  const served = await serve({ studio, port: 0 });
  const to = join(folder, "stations");
  const recorder = spawn(process.execPath, ["apps/cli/src/main.ts", "record", "--to", `${to}/`, "--from", served.url], {
    cwd: root,
    stdio: ["ignore", "ignore", "pipe"],
  });
  let said = "";
  recorder.stderr.on("data", (part: Buffer) => {
    said += part.toString();
  });
  const ended = new Promise<number | null>(resolve => {
    recorder.once("close", resolve);
  });
  try {
    const socket = new WebSocket(served.url.replace("http", "ws").replace(/\/$/, "/stations"));
    const answers = new Map<number, string>();
    socket.addEventListener("message", ({ data }) => {
      const message = JSON.parse(String(data)) as { type: string; id: number; outcome: { kind: string } };
      if (message.type === "answer") answers.set(message.id, message.outcome.kind);
    });
    await new Promise(resolve => {
      socket.addEventListener("open", resolve);
    });
    socket.send(JSON.stringify({ type: "open", id: 1, station: "left", brand: "ur", robot: "ur10e" }));
    await expect.poll(() => answers.get(1), { timeout: 20_000 }).toBe("done");
    socket.send(JSON.stringify({ type: "connect", id: 2, station: "left" }));
    await expect.poll(() => [answers.get(2), said.includes("Recording")], { timeout: 20_000 }).toEqual(["done", true]);
    await new Promise(resolve => {
      setTimeout(resolve, 1500);
    });
    socket.close();
  } finally {
    await served.close();
  }
  expect(await ended).toBe(1);
  expect(said).toMatch(/Recording .* to .*left\. A new file begins every 1 h/);
  expect(said).toMatch(/ended the connection\.\n$/);
  const replayed = lines(twincell(["replay", join(to, "left")]).out);
  expect(replayed.at(-1)!.t).toBeGreaterThan(1);
  expect(replayed.at(-1)!.q.length).toBe(6);
}, 60_000);
