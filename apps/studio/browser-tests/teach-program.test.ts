import { readFile } from "node:fs/promises";
import { palletSlots, unrolled, type Program } from "@twincell/core";
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

const theProgram = (page: Page): Promise<Program> =>
  page.evaluate(() => {
    const { document } = window.twincell.stores.cellStore.getState();
    return document!.programs.find(program => program.name === document!.program) as Program;
  });
async function add(page: Page, item: string): Promise<void> {
  await page.getByRole("button", { name: "Add a step" }).click();
  await page.getByRole("menuitem", { name: item, exact: true }).click();
}
const stand = (page: Page, q: readonly number[]): Promise<void> =>
  page.evaluate(angles => {
    window.twincell.live.showJoints(angles);
  }, q);
const OVER = [0.2, -1.0, 1.7, 0, 0.87, 0.2];

test("M-54 T-70 the palletising job is taught from an empty program: three corners, a point over place 1, a routine", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  await page.evaluate(() => {
    window.twincell.stores.viewStore.setState({ coachDone: true });
    window.twincell.run("file.new");
  });
  await stand(page, OVER);
  await add(page, "Add: at each place of a pallet");
  await stand(page, [0.5, -1.0, 1.7, 0, 0.87, 0.2]);
  await page.getByRole("button", { name: "End of row 1: take where the tool is" }).click();
  await stand(page, [0.2, -0.8, 1.6, 0, 0.77, 0.2]);
  await page.getByRole("button", { name: "End of column 1: take where the tool is" }).click();
  const rows = page.getByRole("textbox", { name: "Rows" });
  await rows.fill("0");
  await page.getByRole("alert").filter({ hasText: "whole number from 1" }).waitFor();
  await rows.fill("2");
  await rows.press("Enter");
  await page.getByText("6 places").waitFor();
  await page.screenshot({ path: picture("editor-pallet") });
  // Recorded while the pallet is selected: it goes into it, and counts from the place.
  await stand(page, OVER);
  await page.getByRole("button", { name: "LIN", exact: true }).first().click();
  await page.getByText("It counts from each place of Pallet 1").waitFor();
  await page.screenshot({ path: picture("editor-move") });
  const program = await theProgram(page);
  expect(palletSlots(program.pallets["Pallet 1"]!)).toHaveLength(6);
  expect(Array.from(unrolled(program), step => step.type)).toEqual(Array.from({ length: 6 }, () => "move"));

  await add(page, "Add: routine");
  await add(page, "Add: close gripper");
  await add(page, "Add: set a signal");
  await page.getByRole("radio", { name: "goes back" }).click();
  expect((await theProgram(page)).routines).toMatchObject({
    Routine: [
      { type: "gripper", closed: true },
      { type: "set", pulse_s: 0.5 },
    ],
  });
  await page.getByRole("button", { name: "Search the steps" }).click();
  await page.getByRole("searchbox", { name: "Search the steps" }).fill("output");
  await page.getByText("1 step is found.").waitFor();
  await page.screenshot({ path: picture("editor-search") });
  expect(problems).toEqual([]);
});

test("L-35 M-61 M-62 L-64 the tool's speed stands under its blocks, and a lesson is taken twice, with a report", async () => {
  const { page, problems } = await studio.open({ width: 1440, height: 900 });
  await drawn(page);
  await page.evaluate(() => {
    window.twincell.stores.viewStore.setState({ coachDone: true });
    window.twincell.run("file.new");
  });
  const record = async (q: readonly number[]): Promise<void> => {
    await stand(page, q);
    await page.getByRole("button", { name: "PTP", exact: true }).first().click();
  };
  const judged = (): Promise<unknown> =>
    page.waitForFunction(() => {
      const { stale, plan } = window.twincell.stores.playStore.getState();
      return !stale && plan !== null;
    });
  const BESIDE = OVER.with(0, -0.4);

  await record(OVER);
  await record(BESIDE);
  await judged();
  await page.getByRole("button", { name: "Plots" }).click();
  await page.getByRole("radio", { name: "TCP speed" }).click();
  await page.evaluate(() => {
    window.twincell.seek(window.twincell.stores.playStore.getState().plan!.duration_s * 0.75);
  });
  // At the playhead, with its unit, without a pointer in the plot.
  await page
    .locator(".u-legend .u-series", { hasText: "TCP speed" })
    .filter({ hasText: /\d mm\/s/ })
    .waitFor();
  const [plot, track] = [(await page.locator(".u-over").boundingBox())!, (await page.locator(".track").boundingBox())!];
  expect(Math.abs(plot.x - track.x)).toBeLessThan(1.5);
  expect(Math.abs(plot.width - track.width)).toBeLessThan(1.5);
  await page.screenshot({ path: picture("tcp-speed") });
  await page.getByRole("button", { name: "Plots" }).click();

  await page.getByRole("button", { name: /^Program · / }).click();
  await page.getByRole("menuitem", { name: "Make a lesson of this program" }).click();
  const card = page.getByRole("complementary", { name: "Lesson" });
  await card.getByText("place 1").waitFor();
  await record(OVER);
  await judged();
  await card.getByText("1 of 2 places").waitFor();
  await page.screenshot({ path: picture("lesson") });
  await card.getByRole("button", { name: "Hand in" }).click();
  await card.getByText("A place is missed.").waitFor();
  await record(BESIDE);
  await judged();
  await card.getByRole("button", { name: "Hand in" }).click();
  await card.getByText(/Attempt 2: \d+ points · passed/).waitFor();
  await page.screenshot({ path: picture("lesson-attempts") });
  const saved = page.waitForEvent("download");
  await card.getByRole("button", { name: "Report" }).click();
  expect(await readFile((await (await saved).path())!, "utf8")).toContain("Attempt 2 is the best.");
  expect(problems).toEqual([]);
});

test("X-45 the error of the drives over the speed is a plot, and grows with the speed", async () => {
  const { page, problems } = await studio.open({ width: 1440, height: 900 });
  await drawn(page);
  await page.evaluate(() => {
    window.twincell.stores.viewStore.setState({ coachDone: true });
    window.twincell.run("file.new");
    window.twincell.document.commit("robot", cell => ({ ...cell, robot: { ...cell.robot, id: "ur10e" } }));
  });
  for (const turn of [0, 0.8]) {
    await stand(page, [turn, -1.2, 1.9, -1.8, -1.4, 0.5]);
    await page.getByRole("button", { name: "PTP", exact: true }).first().click();
  }
  await page.waitForFunction(() => {
    const { stale, plan } = window.twincell.stores.playStore.getState();
    return !stale && (plan?.duration_s ?? 0) > 0;
  });
  await page.getByRole("button", { name: "Plots" }).click();
  await page.getByRole("radio", { name: "Accuracy" }).click();
  const worst = page.locator(".u-legend .u-series", { hasText: "Largest error" }).locator(".u-value");
  await worst.waitFor({ timeout: 60_000 });
  await expect.poll(async () => parseFloat(await worst.innerText())).toBeGreaterThan(1);
  const full_mm = parseFloat(await worst.innerText());
  const plot = (await page.locator(".u-over").boundingBox())!;
  await page.mouse.move(plot.x + (10 / 105) * plot.width, plot.y + plot.height / 2);
  await expect.poll(async () => parseFloat(await worst.innerText())).toBeLessThan(0.2 * full_mm);
  await page.screenshot({ path: picture("accuracy") });
  expect(problems).toEqual([]);
});
