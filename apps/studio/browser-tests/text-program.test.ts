import { readFileSync } from "node:fs";
import { distance, flangePose, robotById, compose, type Pose, type Vector3 } from "@twincell/core";
import { emptyCell, saveDocument } from "@twincell/project";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import type {} from "../src/console.ts";
import { drawn, picture, Studio } from "./support/studio.ts";

let studio: Studio;
beforeAll(async () => {
  studio = await Studio.start();
});
afterAll(async () => {
  await studio.stop();
});

const SRC = [
  "&ACCESS RVP",
  "&REL 14",
  "DEF weld_bracket( )",
  ";FOLD INI",
  "  BAS(#INITMOV,0)",
  ";ENDFOLD (INI)",
  "",
  "PTP XHOME",
  ";FOLD PTP P1 CONT Vel=60 % PDAT1 Tool[2]:torch Base[1]",
  "  $TOOL={X 0.0,Y 0.0,Z 95.5,A 0.0,B 30.0,C 0.0}",
  "  $BASE={X 800.0,Y 0.0,Z 400.0,A 0.0,B 0.0,C 0.0}",
  "  BAS(#VEL_PTP,60)",
  "  PTP XP1 C_PTP",
  ";ENDFOLD",
  "; Naht 1 f\u00fcr Halter",
  "  $VEL.CP=0.4",
  "  LIN XP2 C_DIS",
  "  LIN XP3",
  "  LIN XP1",
  "PTP XHOME",
  "END",
  "",
].join("\r\n");
const DAT = [
  "&ACCESS RVP",
  "DEFDAT  weld_bracket",
  "DECL E6AXIS XHOME={A1 0.0,A2 -90.0,A3 90.0,A4 0.0,A5 20.0,A6 0.0,E1 0.0,E2 0.0,E3 0.0,E4 0.0,E5 0.0,E6 0.0}",
  "DECL E6POS XP1={X 120.5,Y 35.50,Z 310.125,A 180.0,B 0.0,C 180.0,S 2,T 35,E1 0.0,E2 0.0,E3 0.0,E4 0.0,E5 0.0,E6 0.0}",
  "DECL E6POS XP2={Z 210.0,Y 35.50,X 120.5,C 180.0,B 0.0,A 180.0,S 2,T 35,E1 12.75,E2 0.0,E3 0.0,E4 0.0,E5 0.0,E6 0.0} ; \u00fcber der Naht",
  "  decl  pos   xp3 = {X 180,Y -20,Z 210,A 175.0,B 2.5,C 180.0,S 2,T 34}",
  "ENDDAT",
  "",
].join("\r\n");
/** Latin-1, as the controller writes it. */
const bytes = (text: string): Buffer => Buffer.from(text, "latin1");
const robot = robotById("kuka_kr6_2")!;

async function withProject(page: Page): Promise<void> {
  await drawn(page);
  await page.evaluate(
    text => {
      window.twincell.stores.viewStore.setState({ coachDone: true });
      return window.twincell.document.open(text, "cell.json");
    },
    saveDocument(emptyCell("kuka_kr6_2", "Bracket weld")),
  );
  await page.locator("[data-file-input]").setInputFiles([
    { name: "weld_bracket.src", mimeType: "application/octet-stream", buffer: bytes(SRC) },
    { name: "weld_bracket.dat", mimeType: "application/octet-stream", buffer: bytes(DAT) },
  ]);
  await judged(page);
}
const judged = (page: Page) =>
  page.waitForFunction(
    () => {
      const { verdict, checking, plan } = window.twincell.stores.playStore.getState();
      return verdict !== null && checking === null && plan !== null && plan.segments.length > 0;
    },
    null,
    { timeout: 60_000, polling: 100 },
  );
const standing = (page: Page): Promise<number[]> => page.evaluate(() => [...window.twincell.live.now().q_rad]);
/** Where the torch of the text is in the robot's base [m]. */
function torchAt(q_rad: readonly number[]): Vector3 {
  const half = (15 * Math.PI) / 180;
  const torch: Pose<"flange", "tcp"> = { position: [0, 0, 0.0955], quaternion: [0, Math.sin(half), 0, Math.cos(half)] };
  const { position } = compose(flangePose(robot.arm, q_rad), torch);
  return [position[0], position[1], position[2]];
}
async function saved(page: Page, name: string): Promise<Buffer> {
  await page.getByRole("tab", { name }).click();
  const download = page.waitForEvent("download");
  await page.getByRole("button", { name: `Save ${name}` }).click();
  return readFileSync(await (await download).path());
}

test("a KRL project of two files runs in the cell; a point touched up in 3D changes that point alone in the exported text", async () => {
  const { page, problems } = await studio.open();
  await withProject(page);
  const panel = page.getByRole("region", { name: "Program text" }).last();
  await panel.waitFor();

  // A line is a point in 3D: the robot goes there.
  await page.getByRole("option", { name: /LIN XP2 C_DIS/ }).click();
  await page.waitForFunction(
    () => {
      const { selected } = window.twincell.stores.selectionStore.getState();
      return selected?.kind === "step" && selected.id === "line 17";
    },
    null,
    { polling: 100 },
  );
  await expect.poll(async () => distance(torchAt(await standing(page)), [0.9205, 0.0355, 0.61])).toBeLessThan(1e-4);
  expect(await page.locator(".text-lines mark").allTextContents()).toEqual(["XP2"]);
  await page.screenshot({ path: picture("text-program") });

  // The text itself runs on the virtual controller, through every point.
  await page.evaluate(() => window.twincell.run("run.start"));
  await page.getByRole("button", { name: "Run the text" }).click();
  await page.waitForFunction(
    () =>
      window.twincell.stores.noticeStore
        .getState()
        .notices.some(notice => notice.tone === "done" && /text/i.test(notice.sentence)),
    null,
    { timeout: 60_000, polling: 100 },
  );
  expect(await page.evaluate(() => window.twincell.stores.controlStore.getState().running)).toBe(false);

  // Back to the point, the tool is dragged by its ring, and the point touched up.
  await page.evaluate(() => window.twincell.stores.viewStore.setState({ mode: "teach" }));
  await page.getByRole("option", { name: "XP2 1 motion" }).click();
  await expect.poll(async () => distance(torchAt(await standing(page)), [0.9205, 0.0355, 0.61])).toBeLessThan(1e-4);
  const before = await standing(page);
  await dragRing(page);
  await expect.poll(async () => distance(torchAt(await standing(page)), torchAt(before))).toBeGreaterThan(0.005);
  const there = torchAt(await standing(page));
  await page.getByRole("button", { name: "Touch up" }).click();
  await page.waitForFunction(
    () => window.twincell.stores.cellStore.getState().undo[0]?.includes("XP2") === true,
    null,
    { polling: 100 },
  );
  await judged(page);
  await page.screenshot({ path: picture("text-touched-up") });

  const dat = (await saved(page, "weld_bracket.dat")).toString("latin1");
  expect((await saved(page, "weld_bracket.src")).equals(bytes(SRC))).toBe(true);
  const lines = dat.split("\r\n");
  const original = DAT.split("\r\n");
  expect(lines.filter((line, i) => line !== original[i])).toHaveLength(1);
  expect(lines).toHaveLength(original.length);
  const changed = lines[4]!;
  const numbers = /[-+]?\d+\.?\d*/g;
  expect(changed.replace(numbers, "#")).toBe(original[4]!.replace(numbers, "#"));
  // External axes are not touched, and the new numbers are where the robot stands, in the base of the text.
  expect(changed).toContain("E1 12.75,E2 0.0");
  const value = (key: string): number => Number(new RegExp(`\\b${key} (-?[0-9.]+)`).exec(changed)![1]) / 1000;
  expect(distance([0.8 + value("X"), value("Y"), 0.4 + value("Z")], there)).toBeLessThan(2e-5);

  // One undo brings the original back, byte for byte.
  await page.keyboard.press("Control+z");
  await page.waitForFunction(
    () => window.twincell.stores.cellStore.getState().undo[0]?.includes("XP2") !== true,
    null,
    {
      polling: 100,
    },
  );
  expect((await saved(page, "weld_bracket.dat")).equals(bytes(DAT))).toBe(true);
  expect(problems).toEqual([]);
}, 240_000);

test("what is wrong with a text stands at its line, and a click goes there", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  await page.evaluate(
    text => {
      window.twincell.stores.viewStore.setState({ coachDone: true });
      return window.twincell.document.open(text, "cell.json");
    },
    saveDocument(emptyCell("kuka_kr6_2", "Bracket weld")),
  );
  await page.locator("[data-file-input]").setInputFiles([
    { name: "weld_bracket.src", mimeType: "application/octet-stream", buffer: bytes(SRC) },
    { name: "weld_bracket.dat", mimeType: "application/octet-stream", buffer: bytes(DAT.replace("X 180,", "X 2180,")) },
  ]);
  const problem = page.getByRole("region", { name: "Problems" }).getByRole("button").first();
  await problem.waitFor({ timeout: 60_000 });
  expect(await problem.textContent()).toMatch(/weld_bracket\.src · line 18$/);
  await problem.click();
  expect(await page.evaluate(() => window.twincell.stores.textStore.getState().cursor)).toEqual({ file: 0, line: 18 });
  await page.screenshot({ path: picture("text-problem") });
  expect(problems).toEqual([]);
}, 120_000);

/** So many pictures were drawn meanwhile. */
const frames = (page: Page, count: number) =>
  page.evaluate(
    wanted =>
      new Promise<void>(resolve => {
        const next = (left: number): void => {
          if (left === 0) resolve();
          else requestAnimationFrame(() => next(left - 1));
        };
        next(wanted);
      }),
    count,
  );

/** Drags the ring at the flange, the tool of the cell, as a hand does. */
async function dragRing(page: Page): Promise<void> {
  await page.evaluate(() => window.twincell.run("view.fit"));
  await frames(page, 30);
  const { position } = flangePose(robot.arm, await standing(page));
  const flange: Vector3 = [position[0], position[1], position[2]];
  const at = await page.evaluate(point => window.twincellScene!.project(point), flange);
  await page.mouse.move(at.x, at.y);
  await frames(page, 3);
  await page.mouse.down();
  for (let i = 1; i <= 8; i++) {
    await page.mouse.move(at.x + 4 * i, at.y - 3 * i);
    await frames(page, 2);
  }
  await page.mouse.up();
}
