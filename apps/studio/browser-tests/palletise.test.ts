import { unrolled, type Program } from "@twincell/core";
import { readFile } from "node:fs/promises";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { Fingers } from "./support/fingers.ts";
import { Pad, PAD_SCRIPT } from "./support/pad.ts";
import { drawn, picture, Studio } from "./support/studio.ts";

/*
 * The palletising job from an empty program, taught, debugged, repaired and exported by what a person holds: three
 * corners, a routine that picks, a place that counts from each of nine, one move that is far too fast.
 */

let studio: Studio;
beforeAll(async () => {
  studio = await Studio.start();
});
afterAll(async () => {
  await studio.stop();
});

type Axis = "x" | "y";
/** What a person has in hand: everything that moves the robot, and what records. */
interface Hands {
  press(button: string): Promise<void>;
  /** Moves the tool along an axis until it is past that coordinate [m]. */
  jog(axis: Axis, to_m: number): Promise<void>;
  record(path: "PTP" | "LIN"): Promise<void>;
  grip(closed: boolean): Promise<void>;
  /** Where steps are listed and changed; the jog keys; findings and the time line. */
  show(tab: "Program" | "Jog" | "Why"): Promise<void>;
  type(field: string, text: string): Promise<void>;
}

async function emptyCell(page: Page): Promise<void> {
  await drawn(page);
  const file = new URL("../../../examples/05-pallet-of-nine/cell.json", import.meta.url);
  const cell = JSON.parse(await readFile(file, "utf8")) as { programs: object[] };
  cell.programs = cell.programs.map(program => ({ ...program, pallets: {}, steps: [] }));
  await page.evaluate(text => {
    window.twincell.stores.viewStore.setState({ coachDone: true });
    window.twincell.document.open(text, "cell.json");
    window.twincell.stores.jogStore.setState({ frame: "world", speed: 1 });
  }, JSON.stringify(cell));
}
const past = (page: Page, axis: Axis, to_m: number, rising: boolean): Promise<unknown> =>
  page.waitForFunction(
    ([at, to, up]) => {
      const value = window.twincell.live.now().worldFromTcp.position[at === "x" ? 0 : 1];
      return up ? value > to : value < to;
    },
    [axis, to_m, rising] as const,
    { polling: 30, timeout: 60_000 },
  );
const rises = async (page: Page, axis: Axis, to_m: number): Promise<boolean> =>
  to_m > (await page.evaluate(at => window.twincell.live.now().worldFromTcp.position[at === "x" ? 0 : 1], axis));

async function palletise(page: Page, hands: Hands, name: string): Promise<void> {
  const step = async (item: string): Promise<void> => {
    await hands.show("Program");
    await hands.press("Add a step");
    await hands.press(item);
  };
  const corner = async (which: string): Promise<void> => {
    await hands.show("Program");
    await hands.press(`${which}: take where the tool is`);
  };
  await step("Add: at each place of a pallet");
  await hands.show("Jog");
  await hands.jog("x", 0.8);
  await corner("End of row 1");
  await hands.show("Jog");
  await hands.jog("y", 0.15);
  await corner("End of column 1");
  await hands.show("Jog");
  await hands.jog("y", 0.35);
  await step("Add: routine");
  await hands.show("Jog");
  await hands.record("PTP");
  await hands.grip(true);
  await hands.show("Program");
  await hands.press("At each place of Pallet 1");
  await step("Add: call a routine");
  await hands.show("Jog");
  await hands.jog("y", 0);
  await hands.record("LIN");
  // Far too fast, to be found.
  await hands.show("Program");
  await hands.type("Speed", "9000");
  await hands.show("Jog");
  await hands.grip(false);

  await hands.show("Why");
  const judged = (ok: boolean): Promise<unknown> =>
    page.waitForFunction(
      wanted => {
        const { stale, verdict } = window.twincell.stores.playStore.getState();
        return !stale && verdict?.ok === wanted;
      },
      ok,
      { polling: 100, timeout: 60_000 },
    );
  await judged(false);
  await page
    .getByText(/joint \d/i)
    .first()
    .waitFor();
  await page.screenshot({ path: picture(`palletise-${name}-red`) });
  await hands.press("Repair all (1)");
  await judged(true);
  const program = await page.evaluate(() => {
    const { document } = window.twincell.stores.cellStore.getState();
    return document!.programs.find(each => each.name === document!.program) as Program;
  });
  expect(Array.from(unrolled(program), each => each.type)).toEqual(
    Array.from({ length: 9 }, () => ["move", "gripper", "move", "gripper"]).flat(),
  );
  await hands.press("Export KRL");
  const dialog = page.getByRole("dialog");
  await dialog.locator(".export-proof[data-good=true]").waitFor({ timeout: 60_000 });
  expect(await dialog.innerText()).toMatch(/LIN /);
  await page.screenshot({ path: picture(`palletise-${name}`) });
}

/** What is not moved by the thing in hand is clicked. */
const byMouse = (page: Page): Omit<Hands, "jog" | "record"> => ({
  press: name =>
    page
      .getByRole("button", { name, exact: true })
      .or(page.getByRole("menuitem", { name, exact: true }))
      .or(page.locator(".program-row button", { hasText: name }))
      .first()
      .click(),
  grip: closed =>
    page
      .getByRole("button", { name: closed ? "Close" : "Open", exact: true })
      .first()
      .click(),
  show: () => Promise.resolve(),
  async type(field, text) {
    const box = page.getByRole("textbox", { name: new RegExp(`^${field}`) }).first();
    await box.fill(text);
    await box.press("Enter");
  },
});

test("M-54 T-70 X-31 X-32 X-33 by gamepad: sticks move robot and view, A grips, a button records, the rest is clicked; repaired and exported", async () => {
  const { page, problems } = await studio.open({ width: 1440, height: 900, script: PAD_SCRIPT });
  await emptyCell(page);
  const pad = new Pad(page);
  await pad.plug();
  const RECORD = 5;
  await page.evaluate(() => {
    window.twincell.run("help.controls");
  });
  await page.getByRole("button", { name: "Table: target and gripper" }).click();
  await page.keyboard.press("Escape");
  const view = (): Promise<number[]> =>
    page.evaluate(() => {
      const { x, y, z } = window.twincellScene!.camera.position;
      return [x, y, z];
    });
  const [before, stood] = [await view(), await page.evaluate(() => Array.from(window.twincell.live.now().q_rad))];
  await pad.stick(2, 1);
  await expect
    .poll(async () => Math.hypot(...(await view()).map((value, i) => value - before[i]!)))
    .toBeGreaterThan(0.2);
  await pad.stick(2, 0);
  expect(await page.evaluate(() => Array.from(window.twincell.live.now().q_rad))).toEqual(stood);
  await palletise(
    page,
    {
      ...byMouse(page),
      // A closes the gripper while it is held, and letting go opens it.
      grip: closed => pad.button(0, closed ? 1 : 0),
      jog: (axis, to_m) => pad.steerTip({ [axis]: to_m }, 0.002),
      async record(path) {
        await pad.press(RECORD);
        if (path === "PTP") return;
        await page.getByRole("radio", { name: "LIN", exact: true }).first().click();
        await page.getByRole("radio", { name: "mm/s", exact: true }).first().click();
      },
    },
    "gamepad",
  );
  expect(problems).toEqual([]);
});

test("M-54 T-70 by touch on a phone: two thumbs teach the palletising job, find the mistake, repair and export it", async () => {
  const { page, context, problems } = await studio.open({ width: 390, height: 844, touch: true });
  await emptyCell(page);
  const fingers = new Fingers(await context.newCDPSession(page));
  const middle = async (selector: string): Promise<{ x: number; y: number; rim: number }> => {
    const box = (await page.locator(selector).boundingBox())!;
    return { x: box.x + box.width / 2, y: box.y + box.height / 2, rim: 0.46 * box.height };
  };
  await palletise(
    page,
    {
      ...byMouse(page),
      press: name =>
        page
          .getByRole("button", { name, exact: true })
          .or(page.getByRole("menuitem", { name, exact: true }))
          .or(page.locator(".program-row button", { hasText: name }))
          .first()
          .tap(),
      show: tab => page.getByRole("tab", { name: tab, exact: true }).tap(),
      grip: () => page.locator(".phone-record .btn").nth(2).tap(),
      record: path => page.locator(".phone-record").getByRole("button", { name: path, exact: true }).tap(),
      async jog(axis, to_m) {
        const rising = await rises(page, axis, to_m);
        const pad = await middle(".phone-pad");
        const enable = await middle(".phone-enable");
        const way = rising ? pad.rim : -pad.rim;
        await fingers.put(2, enable.x, enable.y);
        // Up is +X, left is +Y.
        await fingers.put(1, axis === "x" ? pad.x : pad.x - way, axis === "x" ? pad.y - way : pad.y);
        await past(page, axis, to_m, rising);
        await fingers.lift(1);
        await fingers.lift(2);
      },
    },
    "touch",
  );
  expect(problems).toEqual([]);
});
