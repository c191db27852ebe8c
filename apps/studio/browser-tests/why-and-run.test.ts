import { readFileSync } from "node:fs";
import { manualScheduler, type MoveStep, type Program, type Step } from "@twincell/core";
import { saveDocument, tracedCartonCell, type CellDocument } from "@twincell/project";
import { openRecording } from "@twincell/recording";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { drawn, picture, Studio } from "./support/studio.ts";

let studio: Studio;
beforeAll(async () => {
  studio = await Studio.start();
});
afterAll(async () => {
  await studio.stop();
});

const cell = tracedCartonCell();
const program = cell.programs[0]!;
const withSteps = (change: (steps: Step[]) => Step[]): CellDocument => {
  const changed: Program = { ...program, steps: change([...program.steps]) };
  return { ...cell, programs: [changed] };
};
const opened = async (page: Page, document: CellDocument): Promise<void> => {
  await drawn(page);
  await page.evaluate(text => {
    window.twincell.stores.viewStore.setState({ coachDone: true });
    return window.twincell.document.open(text, "cell.json");
  }, saveDocument(document));
  await judged(page);
};
const judged = (page: Page) =>
  page.waitForFunction(
    () =>
      window.twincell.stores.playStore.getState().verdict !== null &&
      window.twincell.stores.playStore.getState().checking === null,
    null,
    { timeout: 60_000, polling: 100 },
  );
/** Waits until the checker finds so many points out of reach. */
const reachFindings = (page: Page, count: number) =>
  page.waitForFunction(
    wanted =>
      window.twincell.stores.playStore
        .getState()
        .verdict?.steps.flatMap(step => step.findings)
        .filter(finding => finding.code.startsWith("reach")).length === wanted,
    count,
    { timeout: 60_000, polling: 100 },
  );
/** Meshes of the ghost of a way out. */
const ghosts = (page: Page): Promise<number> =>
  page.evaluate(() => {
    let count = 0;
    window.twincellScene!.scene.traverse(({ name }) => {
      if (name.startsWith("repair/")) count++;
    });
    return count;
  });
const to = (id: string, name: string, x: number, y: number, z: number): MoveStep => ({
  id,
  name,
  type: "move",
  path: "ptp",
  speed: { ratio: 0.3 },
  blend_m: 0,
  target: { pose: { position: [x, y, z], quaternion: [0, 1, 0, 0] }, frame: "world", tool: "torch" },
});

test("Why cards name step, fact and way out; one click repairs, one key takes it back", async () => {
  const { page, problems } = await studio.open();
  const broken = withSteps(steps => [
    ...steps.slice(0, 1),
    to("far", "Far point", 1.9, 0, 0.5),
    to("in", "Inside", 0.6, 0, 0.45),
    ...steps.slice(1),
  ]);
  await opened(page, broken);
  await page
    .getByRole("radio", { name: "Check" })
    .or(page.getByRole("tab", { name: "Check" }))
    .or(page.getByRole("button", { name: "Check", exact: true }))
    .first()
    .click();
  const far = page.locator("article.why", { hasText: "Far point" });
  const inside = page.locator("article.why", { hasText: "Inside" });
  expect(await far.innerText()).toMatch(/The wrist would be \d+ mm from the shoulder; the arm is 1100 mm long\./);
  expect(await inside.innerText()).toMatch(/touches “Carton”/);
  await page.screenshot({ path: picture("why-cards") });

  // The first card has looked for ways out by itself; each was proven on the whole program.
  const ways = far.getByRole("list", { name: "Ways out" });
  await ways.waitFor();
  const offered = await ways.getByRole("listitem").allInnerTexts();
  expect(offered.length).toBeGreaterThan(0);
  expect(offered.length).toBeLessThanOrEqual(3);
  const robotStands = () => page.evaluate(() => Array.from(window.twincell.live.now().q_rad));
  const before = await robotStands();
  expect(await ghosts(page)).toBe(0);
  await page.keyboard.press("1");
  await expect.poll(() => ghosts(page)).toBeGreaterThan(0);
  expect(await robotStands()).toEqual(before);
  await page.screenshot({ path: picture("why-ways-out") });
  await page.keyboard.press("Escape");
  await expect.poll(() => ghosts(page)).toBe(0);

  await far.getByRole("button", { name: "Apply 1" }).click();
  await reachFindings(page, 0);
  await page.keyboard.press("Control+z");
  await reachFindings(page, 1);
  await page
    .getByRole("button", { name: /Repair all/ })
    .first()
    .click();
  await page.waitForFunction(() => window.twincell.stores.playStore.getState().verdict?.ok === true, null, {
    timeout: 60_000,
    polling: 100,
  });
  // All of it was one edit.
  await page.keyboard.press("Control+z");
  await reachFindings(page, 1);
  await page.keyboard.press("Control+Shift+z");
  await page.waitForFunction(() => window.twincell.stores.playStore.getState().verdict?.ok === true, null, {
    timeout: 60_000,
    polling: 100,
  });
  expect(await page.evaluate(() => window.twincell.stores.playStore.getState().verdict)).toMatchObject({ ok: true });
  expect(problems).toEqual([]);
});

test("L-39 L-40 L-41 path and time line change colour inside a move at limit − 10° and at the limit; a click there goes there", async () => {
  const { page, problems } = await studio.open();
  const fifth = (id: string, deg: number): MoveStep => ({
    id,
    name: id,
    type: "move",
    path: "ptp",
    speed: { ratio: 0.2 },
    blend_m: 0,
    target: { q: [0, -1.2, 1.9, 0, (deg * Math.PI) / 180, 0], tool: "torch" },
  });
  await opened(
    page,
    withSteps(steps => [...steps.slice(0, 1), fifth("start", 60), fifth("sweep", 125)]),
  );
  await page.keyboard.press("3");
  const pieces = await page.evaluate(() =>
    window.twincell.stores.playStore.getState().path.filter(({ step }) => step === "sweep"),
  );
  expect(pieces.map(({ verdict }) => verdict)).toEqual(["ok", "warn", "bad"]);
  const shown = await page
    .locator(".block[data-block='sweep'] .block-piece")
    .evaluateAll(marks => marks.map(mark => [mark.dataset.verdict, mark.getBoundingClientRect().width > 1]));
  expect(shown).toEqual([
    ["warn", true],
    ["bad", true],
  ]);
  const fifthNow = () => page.evaluate(() => (window.twincell.live.now().q_rad[4]! * 180) / Math.PI);
  for (const [piece, low, high] of [
    [pieces[1]!, 110, 120],
    [pieces[2]!, 120, 125],
  ] as const) {
    const place = await page.evaluate(
      point => window.twincellScene!.project(point),
      piece.points[Math.floor(piece.points.length / 2)]!,
    );
    await page.mouse.click(place.x, place.y);
    await expect.poll(fifthNow).toBeGreaterThan(low);
    expect(await fifthNow()).toBeLessThan(high);
  }
  // Row L-40: the offender is red, alone.
  await expect
    .poll(() => page.locator(".joint-line[data-near='bad'] .axis-name").allTextContents(), { timeout: 20_000 })
    .toEqual(["J5"]);
  await page.screenshot({ path: picture("within-a-move") });
  await page.evaluate(() => window.twincell.seek(0));
  await page.keyboard.press("F8");
  await expect.poll(fifthNow).toBeGreaterThan(119.9);
  expect(problems).toEqual([]);
});

test("the base position map colours the floor, and the place that it suggests makes a program good that is out of reach", async () => {
  const { page, problems } = await studio.open();
  const { position, quaternion } = cell.robot.worldFromBase;
  await opened(page, {
    ...cell,
    // Not the column: the robot is to be moved off it.
    objects: cell.objects.filter(({ name }) => name !== "Column"),
    robot: { ...cell.robot, worldFromBase: { position: [position[0] - 0.35, position[1], position[2]], quaternion } },
  });
  const ok = () =>
    page.evaluate(() => {
      const { stale, verdict } = window.twincell.stores.playStore.getState();
      return stale ? null : verdict?.ok;
    });
  expect(await ok()).toBe(false);
  await page.keyboard.press("3");
  await page.getByRole("checkbox", { name: "Base position map" }).check();
  const move = page.getByRole("button", { name: "Move the robot there" });
  await move.waitFor({ timeout: 30_000 });
  await move.scrollIntoViewIfNeeded();
  const drawnMap = () =>
    page.evaluate(() => ({
      squares: window.twincellScene!.scene.getObjectByName("base-map") !== undefined,
      beacon: window.twincellScene!.scene.getObjectByName("base-beacon") !== undefined,
    }));
  expect(await drawnMap()).toEqual({ squares: true, beacon: true });
  await page.screenshot({ path: picture("base-map") });
  await move.click();
  await expect.poll(ok, { timeout: 60_000 }).toBe(true);
  await page.getByRole("checkbox", { name: "Base position map" }).uncheck();
  await expect.poll(drawnMap).toEqual({ squares: false, beacon: false });
  expect(problems).toEqual([]);
});

test("the timeline plays at any speed, holds at 0 %, and the robot stands where the plan says", async () => {
  const { page, problems } = await studio.open();
  await opened(page, cell);
  const playhead = () => page.evaluate(() => window.twincell.live.playhead());
  await page.evaluate(() => {
    window.twincell.seek(5);
  });
  await page.getByRole("button", { name: "Play", exact: true }).click();
  await page.waitForFunction(() => window.twincell.live.playhead() > 5.5, null, { polling: 50 });
  await page.evaluate(() => {
    window.twincell.stores.playStore.setState({ speed: 0 });
  });
  const held = await playhead();
  await page.waitForFunction(
    before => (window.twincellScene?.meter.frames ?? 0) >= before,
    await page.evaluate(() => window.twincellScene!.frames),
  );
  expect(await playhead()).toBeCloseTo(held, 9);
  await page.evaluate(() => {
    window.twincell.stores.playStore.setState({ speed: 1 });
  });
  await page.waitForFunction(before => window.twincell.live.playhead() > before, held, { polling: 50 });
  await page.getByRole("button", { name: "Pause", exact: true }).click();
  await page.evaluate(() => {
    window.twincell.seek(0);
  });
  const home = await page.evaluate(() => Array.from(window.twincell.live.now().q_rad));
  [0, -Math.PI / 2, Math.PI / 2, 0, 0, 0].forEach((angle, joint) => {
    expect(home[joint]).toBeCloseTo(angle, 9);
  });
  expect(problems).toEqual([]);
});

test("T-54 a run on the virtual controller is mirrored within 0.001°, stopped by STOP, recorded, and any moment of it comes back", async () => {
  const { page, problems } = await studio.open();
  await opened(
    page,
    withSteps(steps => steps.slice(0, 6)),
  );
  await page
    .getByRole("radio", { name: "Run" })
    .or(page.getByRole("tab", { name: "Run" }))
    .or(page.getByRole("button", { name: "Run", exact: true }))
    .first()
    .click();
  await page.locator("section, div").getByRole("button", { name: "Run", exact: true }).last().click();
  await page.waitForFunction(
    () =>
      window.twincell.stores.controlStore.getState().running && window.twincell.stores.controlStore.getState().line > 0,
    null,
    { timeout: 30_000, polling: 100 },
  );
  await page.screenshot({ path: picture("run") });
  await page.waitForFunction(() => !window.twincell.stores.controlStore.getState().running, null, {
    timeout: 90_000,
    polling: 200,
  });
  const { twinError_rad } = await page.evaluate(() => window.twincell.stores.controlStore.getState());
  expect((twinError_rad * 180) / Math.PI).toBeLessThan(0.001);
  const ending = await page.evaluate(() => window.twincell.stores.historyStore.getState().runs[0]);
  expect(ending).toMatchObject({ ending: "done" });

  // A second run is ended by hand; nothing goes on by itself.
  await page.evaluate(() => {
    window.twincell.run("run.start");
  });
  await page.waitForFunction(() => window.twincell.stores.controlStore.getState().running, null, { polling: 50 });
  await page.getByRole("button", { name: "STOP", exact: true }).click();
  await page.waitForFunction(() => window.twincell.stores.historyStore.getState().runs.length === 2, null, {
    timeout: 30_000,
    polling: 100,
  });
  expect(await page.evaluate(() => window.twincell.stores.controlStore.getState().running)).toBe(false);

  // Look back: the file that is kept, and the robot on screen.
  await page
    .getByRole("radio", { name: "History" })
    .or(page.getByRole("tab", { name: "History" }))
    .or(page.getByRole("button", { name: "History", exact: true }))
    .first()
    .click();
  const rows = page.getByRole("listitem").filter({ has: page.getByRole("button", { name: /Download/ }) });
  const waiting = page.waitForEvent("download");
  await rows
    .last()
    .getByRole("button", { name: /Download/ })
    .click();
  const file = readFileSync(await (await waiting).path());
  const recorded = openRecording(new Uint8Array(file), { scheduler: manualScheduler() });
  if (recorded.kind !== "recording") throw new Error(recorded.sentence);
  await rows.last().getByRole("button").first().click();
  await page.waitForFunction(() => window.twincell.stores.historyStore.getState().duration_s > 0, null, {
    polling: 100,
  });
  const slider = page.getByRole("slider", { name: "Moment of the run" });
  await slider.focus();
  for (const key of ["End", "PageDown", "PageDown", "PageDown"]) await slider.press(key);
  const { t_s } = await page.evaluate(() => window.twincell.stores.historyStore.getState());
  expect(t_s).toBeGreaterThan(0);
  expect(t_s).toBeLessThan(recorded.recording.duration_s);
  const wanted = recorded.recording.anglesAt(t_s, new Float64Array(6));
  const shown = await page.evaluate(() => Array.from(window.twincell.live.now().q_rad));
  wanted.forEach((angle, joint) => {
    expect(shown[joint]).toBeCloseTo(angle, 9);
  });
  await page.screenshot({ path: picture("history") });
  expect(problems).toEqual([]);
}, 240_000);

test("a red program asks before it runs: what is wrong is named and shown, it stays where it is, and runs only when told to", async () => {
  const { page, problems } = await studio.open();
  await opened(
    page,
    withSteps(steps => [...steps.slice(0, 1), to("in", "Inside", 0.6, 0, 0.45), ...steps.slice(1)]),
  );
  const before = await page.evaluate(() => [...window.twincell.live.now().q_rad]);
  await page.evaluate(() => window.twincell.run("run.start"));
  const dialog = page.getByRole("dialog", { name: "The check is red" });
  await dialog.waitFor();
  expect(await dialog.innerText()).toMatch(/Inside .*touches “Carton”/);
  await dialog.evaluate(element =>
    Promise.all(element.getAnimations({ subtree: true }).map(({ finished }) => finished)),
  );
  expect(await page.evaluate(() => window.twincell.stores.controlStore.getState().running)).toBe(false);
  await page.screenshot({ path: picture("red-run") });
  await page.setViewportSize({ width: 390, height: 844 });
  await page.screenshot({ path: picture("red-run-phone") });
  await page.setViewportSize({ width: 1280, height: 800 });
  await dialog.getByRole("button", { name: "Do not run" }).click();
  await dialog.waitFor({ state: "hidden" });
  expect(await page.evaluate(() => [...window.twincell.live.now().q_rad])).toEqual(before);
  await page.evaluate(() => window.twincell.run("run.start"));
  await dialog.getByRole("button", { name: "Show" }).click();
  expect(await page.evaluate(() => window.twincell.stores.viewStore.getState().mode)).toBe("check");
  await page.evaluate(() => window.twincell.run("run.start"));
  await dialog.getByRole("button", { name: "Run all the same" }).click();
  await page.waitForFunction(() => window.twincell.stores.controlStore.getState().running);
  // The guard stops it before it touches.
  await page.waitForFunction(() => !window.twincell.stores.controlStore.getState().running, null, { timeout: 60_000 });
  expect(problems).toEqual([]);
});

test("before a red program goes to a robot that is no virtual one, RUN is typed; before that the button does nothing", async () => {
  const { page, problems } = await studio.open();
  await opened(
    page,
    withSteps(steps => [...steps.slice(0, 1), to("far", "Far point", 1.9, 0, 0.5), ...steps.slice(1)]),
  );
  await page.getByRole("combobox", { name: "Connection" }).click();
  await page.getByRole("option", { name: "Virtual: Stäubli CS7 (V+)" }).click();
  await page.waitForFunction(
    () => window.twincell.stores.stationStore.getState().stations[0]?.link.state === "open",
    null,
    { timeout: 60_000 },
  );
  await judged(page);
  const question = page.getByRole("dialog", { name: "The check is red" });
  const anyway = question.getByRole("button", { name: "Run all the same" });
  await page.evaluate(() => window.twincell.run("run.start"));
  await question.waitFor();
  expect(await question.getByLabel("Type RUN").count()).toBe(0);
  expect(await anyway.isEnabled()).toBe(true);
  await question.getByRole("button", { name: "Do not run" }).click();
  // No real controller stands beside this test: the virtual one is told apart by this mark alone.
  await page.evaluate(() => {
    const { stationStore } = window.twincell.stores;
    stationStore.setState({ stations: stationStore.getState().stations.map(each => ({ ...each, virtual: false })) });
  });
  await page.evaluate(() => window.twincell.run("run.start"));
  await question.getByText(/^A real robot moves: /).waitFor();
  expect(await anyway.isDisabled()).toBe(true);
  await question.getByLabel("Type RUN").fill("run");
  expect(await anyway.isDisabled()).toBe(true);
  await question.getByLabel("Type RUN").fill("RUN");
  await page.screenshot({ path: picture("run-typed") });
  expect(await page.evaluate(() => window.twincell.stores.stationStore.getState().stations[0]!.running)).toBe(false);
  await anyway.click();
  await question.waitFor({ state: "hidden" });
  // The far point cannot be reached: the connection refuses the program, and the robot stands.
  await page
    .getByText(/cannot be reached|reach/i)
    .first()
    .waitFor();
  expect(problems).toEqual([]);
});
