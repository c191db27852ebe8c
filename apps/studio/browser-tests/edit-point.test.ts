import { saveDocument } from "@twincell/project";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { cellWithBadPoint, fifthJoint, verdictOfBad } from "./support/bad-point.ts";
import { drawn, picture, Studio } from "./support/studio.ts";

let studio: Studio;
beforeAll(async () => {
  studio = await Studio.start();
});
afterAll(async () => {
  await studio.stop();
});

async function openBroken(page: Page): Promise<void> {
  await drawn(page);
  await page.evaluate(text => {
    window.twincell.stores.viewStore.setState({ coachDone: true });
    return window.twincell.document.open(text, "cell.json");
  }, saveDocument(cellWithBadPoint()));
  await expect.poll(() => verdictOfBad(page), { timeout: 60_000 }).toBe("bad");
  // To the end of the step that is bad: the tool stands near it, as far as the timeline goes.
  await page.evaluate(() => {
    const { plan } = window.twincell.stores.playStore.getState();
    window.twincell.seek(plan!.duration_s - 0.3);
  });
  await page.evaluate(() => window.twincell.stores.jogStore.setState({ frame: "joint" }));
}

test("L-42 L-43 mouse and keys: EDIT held snaps to the bad pose, the keys move it, letting go stores it, and the path turns blue", async () => {
  const { page, problems } = await studio.open();
  await openBroken(page);
  await page.keyboard.down("x");
  const says = page.getByRole("status").filter({ hasText: "Bad point" });
  await says.waitFor();
  await expect.poll(() => fifthJoint(page), { timeout: 15_000 }).toBeGreaterThan(115);
  const number = page.locator(".axis", { hasText: "J5" }).locator(".num");
  const before = await number.innerText();
  await page.keyboard.down("j");
  await expect.poll(() => fifthJoint(page), { timeout: 15_000 }).toBeLessThan(108);
  // Row L-43: the angles are there to be read while it is edited.
  expect(await number.innerText()).not.toBe(before);
  await page.screenshot({ path: picture("edit-point") });
  await page.keyboard.up("j");
  const brought = await fifthJoint(page);
  await page.keyboard.up("x");
  await expect.poll(() => verdictOfBad(page), { timeout: 60_000 }).toBe("ok");
  const colours = await page.evaluate(() =>
    window.twincell.stores.playStore
      .getState()
      .path.filter(({ step }) => step === "bad")
      .map(({ verdict }) => verdict),
  );
  expect(colours).toEqual(["ok"]);
  expect(await fifthJoint(page)).toBeCloseTo(brought, 1);
  await page.keyboard.press("Control+z");
  await expect.poll(() => verdictOfBad(page), { timeout: 60_000 }).toBe("bad");
  expect(problems).toEqual([]);
});

test("L-42 touch: a tap on EDIT keeps the point, the jog keys of the screen move it, a second tap stores it", async () => {
  const { page, problems } = await studio.open({ width: 390, height: 844, touch: true });
  await openBroken(page);
  const edit = page.getByRole("button", { name: "Hold to edit" });
  await edit.scrollIntoViewIfNeeded();
  await edit.tap();
  await page.getByRole("status").filter({ hasText: "Bad point" }).waitFor();
  await page.screenshot({ path: picture("edit-point-phone") });
  await expect.poll(() => fifthJoint(page), { timeout: 15_000 }).toBeGreaterThan(115);
  const less = page.locator(".axis", { hasText: "J5" }).getByRole("button").first();
  await less.scrollIntoViewIfNeeded();
  const box = (await less.boundingBox())!;
  const client = await page.context().newCDPSession(page);
  const touchPoints = [{ x: box.x + box.width / 2, y: box.y + box.height / 2 }];
  await client.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints });
  await expect.poll(() => fifthJoint(page), { timeout: 15_000 }).toBeLessThan(108);
  await client.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
  await edit.scrollIntoViewIfNeeded();
  await edit.tap();
  await expect.poll(() => verdictOfBad(page), { timeout: 60_000 }).toBe("ok");
  expect(problems).toEqual([]);
});
