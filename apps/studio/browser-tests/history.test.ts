import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { robotById, type JointSample } from "@twincell/core";
import { saveDocument, tracedCartonCell } from "@twincell/project";
import { createRunRecorder, memorySink } from "@twincell/recording";
import { zstd } from "@twincell/recording/zstd";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { drawn, picture, Studio } from "./support/studio.ts";

const robot = robotById("staubli_rx90l")!;
const n = robot.arm.joints.length;
const HZ = 2;
const DAY_S = 86_400;
const CYCLE_S = 40;
const folder = mkdtempSync(join(tmpdir(), "twincell-day-"));
const day = join(folder, "day.mcap");
let studio: Studio;

/**
 * Where the robot is on that day: it goes round its home, a little farther each hour, and waits; later cycles are
 * slower.
 */
function angles(t_s: number, out = new Float64Array(n)): Float64Array {
  const cycle = Math.floor(t_s / CYCLE_S);
  const inCycle = t_s % CYCLE_S;
  const takes_s = 24 + 6 * ((cycle * CYCLE_S) / DAY_S);
  const part = Math.min(1, inCycle / takes_s);
  const far = 0.35 + (0.1 * Math.floor(t_s / 3600)) / 24;
  for (let j = 0; j < n; j++)
    out[j] = robot.home_rad[j]! + (far * Math.sin(2 * Math.PI * part * (1 + (j % 3)))) / (1 + j / 2);
  return out;
}
const ALARMS_S = [20_030, 61_235, 80_031.5];
async function aDay(): Promise<void> {
  const sink = memorySink();
  const recorder = createRunRecorder(sink, {
    robot,
    startedAt_ns: 1_795_219_200_000_000_000n,
    program: "Carton edge",
    cell: "Line 3",
    compact: { packing: await zstd() },
  });
  const q_rad = new Float64Array(n);
  const signals = new Map<string, boolean | number>([
    ["part", false],
    ["count", 0],
  ]);
  for (let k = 0; k < DAY_S * HZ; k++) {
    const t_s = k / HZ;
    const inCycle = t_s % CYCLE_S;
    const alarm = ALARMS_S.some(at_s => t_s >= at_s && t_s < at_s + 4);
    if (inCycle === 0) {
      signals.set("count", Math.floor(t_s / CYCLE_S));
      signals.set("part", false);
    }
    if (inCycle === 12) signals.set("part", true);
    if (k % (30 * HZ) === 0) {
      const warm = 8 * Math.min(1, t_s / 20_000);
      recorder.note("load", {
        torque_Nm: [40, 90, 55, 8, 6, 3].map(
          (value, j) => value * (1 + 0.1 * Math.sin(k / 4000 + j) + (j === 1 ? (0.4 * t_s) / DAY_S : 0)),
        ),
        current_A: [],
        temperature_C: [31, 35, 33, 29, 28, 27].map(value => value + warm),
      });
    }
    recorder.record({
      sequence: k,
      time_s: t_s,
      q_rad: angles(t_s, q_rad),
      moving: inCycle < 30,
      mode: "automatic",
      safety: alarm ? "protective-stop" : "normal",
      override: 1,
      gripperClosed: inCycle > 12,
      step: inCycle < 12 ? "pick" : inCycle < 30 ? "place" : "wait",
      message: alarm ? "The tool touched the carton." : "",
      signals,
    } satisfies JointSample);
  }
  recorder.finish();
  writeFileSync(day, sink.bytes());
}
beforeAll(async () => {
  [studio] = await Promise.all([Studio.start(), aDay()]);
}, 120_000);
afterAll(async () => {
  await studio.stop();
  rmSync(folder, { recursive: true });
});

// Clicks are sent, not aimed: a page drawn in software takes long to stand still for a pointer.
const history = (page: Page) => page.evaluate(() => window.twincell.stores.historyStore.getState());
async function opened(page: Page): Promise<void> {
  await drawn(page);
  await page.evaluate(() => {
    window.twincell.stores.viewStore.setState({ coachDone: true, mode: "history", sheet: "run" });
  });
  await page.locator("[data-recording-input]").setInputFiles(day);
  await page.waitForFunction(() => window.twincell.stores.historyStore.getState().duration_s > 0, null, {
    timeout: 60_000,
    polling: 100,
  });
}
/** The robot on screen stands where it stood at the moment of the timeline. */
async function standsThere(page: Page): Promise<number> {
  // What was asked for last comes from the worker in its own time.
  let t_s = NaN;
  await expect
    .poll(
      async () => {
        ({ t_s } = await history(page));
        const shown = await page.evaluate(() => Array.from(window.twincell.live.now().q_rad));
        const wanted = angles(Math.floor(t_s * HZ + 1e-6) / HZ);
        return Math.max(...shown.map((q, j) => Math.abs(q - wanted[j]!)));
      },
      { timeout: 10_000 },
    )
    .toBeLessThan(1e-6);
  return t_s;
}

test("T-54 T-56 X-43 a day is scrubbed, its last alarm found, two cycles laid over each other, its figures read", async () => {
  const { page, problems } = await studio.open({ width: 1120, height: 700 });
  await opened(page);
  expect((await history(page)).cycles.length).toBe(DAY_S / CYCLE_S);
  const slider = page.getByRole("slider", { name: "Moment of the run" });
  for (const key of ["End", "PageDown", "PageDown"]) await slider.press(key);
  const far_s = await standsThere(page);
  expect(far_s).toBeGreaterThan(60_000);
  expect(far_s).toBeLessThan(DAY_S - 1);
  await page.getByRole("button", { name: "Last alarm" }).dispatchEvent("click");
  expect(await standsThere(page)).toBeCloseTo(80_031.5, 0);
  await page.getByRole("button", { name: "Last alarm" }).dispatchEvent("click");
  expect(await standsThere(page)).toBeCloseTo(61_235, 0);
  expect((await history(page)).moment).toMatchObject({
    safety: "protective-stop",
    signals: { part: true, count: Math.floor(61_235 / CYCLE_S) },
  });
  await page.getByRole("group", { name: "Time shown" }).getByRole("button", { name: "10 min" }).dispatchEvent("click");
  const { window: shown } = await history(page);
  expect(shown.to_s - shown.from_s).toBeCloseTo(600, 6);
  await page.screenshot({ path: picture("history-day"), timeout: 90_000 });

  await page.getByRole("radio", { name: "Cycles" }).dispatchEvent("click");
  await page.getByRole("button", { name: "Cycle 2", exact: true }).dispatchEvent("click");
  await page.evaluate(() => {
    document.querySelector("[aria-label=Cycles][role=list]")?.scrollTo(0, 1e9);
  });
  await page.getByRole("button", { name: `Cycle ${DAY_S / CYCLE_S - 1}`, exact: true }).dispatchEvent("click");
  await page.getByText(/at most [\d.]+ mm apart, after/).waitFor();
  expect((await history(page)).overlay?.ways.every(way => way.length > 20)).toBe(true);
  await page.screenshot({ path: picture("history-cycles"), timeout: 90_000 });

  await page.getByRole("radio", { name: "Figures" }).dispatchEvent("click");
  await page.getByText(/2,159 cycles, 40\.00 s median/).waitFor();
  await page.getByText(/The load of joint 2 rose by/).waitFor();
  expect(await page.getByText("Service intervals: not reported.").count()).toBe(1);
  // A person says what stands in the robot's papers, and is told when it is time.
  await page.getByText("Service intervals", { exact: true }).dispatchEvent("click");
  const interval = page.getByRole("textbox", { name: "Service interval of J1" });
  await interval.fill("1000");
  await interval.press("Enter");
  await page.getByText(/Joint 1 used up \d+ % of its service interval\./).waitFor();
  await page.screenshot({ path: picture("history-figures"), timeout: 90_000 });
  expect(problems).toEqual([]);
}, 300_000);

test("X-43 a moment is shared as a link; where the recording is missing it asks for the file and opens there", async () => {
  const { page, context, problems } = await studio.open();
  await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  await opened(page);
  await page.getByRole("button", { name: "Last alarm" }).dispatchEvent("click");
  await page.getByRole("button", { name: "Share this moment" }).dispatchEvent("click");
  await page.getByText("A link to this moment is in the clipboard.").waitFor();
  const link = await page.evaluate(() => navigator.clipboard.readText());
  expect(link).toContain("#moment=day.mcap&t=80031.5");
  await page.goto("about:blank");
  await page.goto(link);
  await drawn(page);
  await page
    .getByText("The link names a moment of day.mcap, which is not kept in this browser.")
    .waitFor({ timeout: 30_000 });
  await opened(page);
  await page.waitForFunction(() => window.twincell.stores.historyStore.getState().t_s > 0, null, { polling: 100 });
  expect(await standsThere(page)).toBeCloseTo(80_031.5, 3);
  expect(problems).toEqual([]);
}, 180_000);

test("T-54 from any past instant a run goes on: posture and step as they were, recorded as a run of its own", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  await page.evaluate(text => {
    window.twincell.stores.viewStore.setState({ coachDone: true });
    window.twincell.document.open(text, "cell.json");
  }, saveDocument(tracedCartonCell()));
  await page.waitForFunction(
    () => {
      const { verdict, checking } = window.twincell.stores.playStore.getState();
      return verdict !== null && checking === null;
    },
    null,
    { timeout: 60_000, polling: 100 },
  );
  await page.evaluate(() => {
    window.twincell.run("run.start");
  });
  const ended = (runs: number) =>
    page.waitForFunction(
      count => {
        const { historyStore, controlStore } = window.twincell.stores;
        return (
          historyStore.getState().runs.filter(({ ending }) => ending !== "running").length === count &&
          !controlStore.getState().running
        );
      },
      runs,
      { timeout: 120_000, polling: 200 },
    );
  await ended(1);
  await page.evaluate(() => {
    window.twincell.stores.viewStore.setState({ mode: "history" });
  });
  await page
    .getByRole("listitem")
    .filter({ has: page.getByRole("button", { name: /Download/ }) })
    .first()
    .getByRole("button")
    .first()
    .dispatchEvent("click");
  await page.waitForFunction(() => window.twincell.stores.historyStore.getState().duration_s > 0, null, {
    polling: 100,
  });
  const slider = page.getByRole("slider", { name: "Moment of the run" });
  for (const key of ["End", "PageDown", "PageDown", "PageDown"]) await slider.press(key);
  await page.waitForTimeout(150);
  const { moment, t_s, duration_s } = await history(page);
  const stood = await page.evaluate(() => Array.from(window.twincell.live.now().q_rad));
  expect(moment.step).not.toBe("");
  await page.getByRole("button", { name: "Branch from here" }).dispatchEvent("click");
  await page.waitForFunction(
    () =>
      window.twincell.stores.controlStore.getState().running &&
      window.twincell.stores.controlStore.getState().step !== "",
    null,
    { polling: 20, timeout: 30_000 },
  );
  expect(await page.evaluate(() => window.twincell.stores.controlStore.getState().step)).toBe(moment.step);
  await ended(2);
  await page.evaluate(() => {
    window.twincell.stores.viewStore.setState({ mode: "history" });
  });
  await page
    .getByRole("listitem")
    .filter({ has: page.getByRole("button", { name: /Download/ }) })
    .first()
    .getByRole("button")
    .first()
    .dispatchEvent("click");
  await page.waitForFunction(
    before => {
      const state = window.twincell.stores.historyStore.getState();
      return state.duration_s > 0 && state.duration_s < before;
    },
    duration_s,
    { polling: 100 },
  );
  const first = await page.evaluate(() => Array.from(window.twincell.live.now().q_rad));
  const branch = await history(page);
  first.forEach((q, j) => {
    expect(Math.abs(q - stood[j]!)).toBeLessThan(1e-6);
  });
  expect(branch.duration_s).toBeLessThan(duration_s - 0.5 * t_s);
  await page.screenshot({ path: picture("history-branch") });
  expect(problems).toEqual([]);
}, 240_000);

test("a phone looks back too; a file that is no recording is one sentence", async () => {
  const { page, problems } = await studio.open({ width: 390, height: 844, touch: true });
  await opened(page);
  await page.getByRole("button", { name: "Last alarm" }).dispatchEvent("click");
  await standsThere(page);
  await page.screenshot({ path: picture("history-phone") });
  await page.getByRole("radio", { name: "Figures" }).dispatchEvent("click");
  await page.getByText(/2,159 cycles/).waitFor();
  await page.screenshot({ path: picture("history-phone-figures") });
  const letter = join(folder, "letter.mcap");
  writeFileSync(letter, "Dear Sir or Madam");
  await page.locator("[data-recording-input]").setInputFiles(letter);
  await page.getByText("The file does not begin like an MCAP file.").waitFor();
  expect(problems).toEqual([]);
}, 120_000);
