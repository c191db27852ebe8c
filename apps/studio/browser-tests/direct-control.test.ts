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

async function connect(page: Page, kind: string): Promise<void> {
  await page.getByRole("radio", { name: "Run" }).click();
  await page.getByRole("button", { name: "Add a controller" }).first().click();
  const dialog = page.getByRole("dialog", { name: "Add a controller to the cell" });
  await dialog.getByRole("combobox", { name: "Manufacturer" }).click();
  await page.getByRole("option", { name: kind }).click();
  await dialog.getByRole("button", { name: "Add and connect" }).click();
  await dialog.waitFor({ state: "detached", timeout: 30_000 });
  await page.waitForFunction(
    () => window.twincell.stores.stationStore.getState().stations[0]?.link.state === "open",
    null,
    { timeout: 30_000 },
  );
  await page.getByRole("button", { name: /^More: / }).click();
}
/** What the Tester prints, in degrees. */
async function printJoints(page: Page): Promise<number[]> {
  const tester = page.getByRole("region", { name: "Tester" });
  await choose(page, "Print Joints");
  await tester.getByRole("button", { name: "Test", exact: true }).click();
  const text = await tester.getByLabel("Result").innerText();
  return text.split(/\s+/).map(each => Number.parseFloat(each));
}
async function choose(page: Page, action: string): Promise<void> {
  const tester = page.getByRole("region", { name: "Tester" });
  await tester.getByRole("combobox", { name: "Action" }).click();
  await page.getByRole("option", { name: action, exact: true }).click();
}
async function type(page: Page, label: string, value: string): Promise<void> {
  const field = page.getByRole("region", { name: "Tester" }).getByLabel(label);
  await field.fill(value);
  await field.press("Enter");
}
/** Tries the chosen action while Space holds the enabling switch, and waits until the controller has answered. */
async function tryEnabled(page: Page): Promise<string> {
  const tester = page.getByRole("region", { name: "Tester" });
  await page.getByRole("region", { name: "Direct control" }).focus();
  await page.keyboard.down("Space");
  await tester.getByRole("button", { name: "Test", exact: true }).click();
  const result = tester.getByLabel("Result");
  await result.filter({ hasText: /\S/ }).waitFor({ timeout: 60_000 });
  await page.keyboard.up("Space");
  return result.innerText();
}
const stands = (page: Page): Promise<unknown> =>
  page.waitForFunction(() => window.twincell.stores.stationStore.getState().stations[0]?.moving === false, null, {
    timeout: 20_000,
  });

for (const brand of ["Universal Robots"])
  test(`T-10 T-35 ${brand}: jogged while held, the four Tester actions, drives off and reset`, async () => {
    const { page, problems } = await studio.open();
    await drawn(page);
    await page.evaluate(() => window.twincell.stores.viewStore.setState({ coachDone: true }));
    await connect(page, brand);
    const panel = page.getByRole("region", { name: "Direct control" });

    // Nothing moves before the switch is held.
    expect(await panel.getByRole("button", { name: "Move to zero" }).isDisabled()).toBe(true);
    const before = await printJoints(page);
    await panel.getByRole("button", { name: "J1 plus" }).click();
    await page.waitForFunction(() => window.twincell.stores.stationStore.getState().stations[0]?.moving === false);
    expect(await printJoints(page)).toEqual(before);

    // Held: joint 1 turns, and only it; letting the switch go ends it.
    await panel.focus();
    await page.keyboard.down("Space");
    await panel.getByRole("button", { name: "Hold to enable" }).and(page.locator("[aria-pressed=true]")).waitFor();
    const plus = panel.getByRole("button", { name: "J1 plus" });
    await plus.hover();
    await page.mouse.down();
    await page.waitForFunction(() => window.twincell.stores.stationStore.getState().stations[0]?.moving, null, {
      timeout: 20_000,
    });
    await page.screenshot({ path: picture(`direct-control-${brand.slice(0, 3).toLowerCase()}`) });
    await page.keyboard.up("Space");
    await page.mouse.up();
    await stands(page);
    const jogged = await printJoints(page);
    expect(jogged[0]! - before[0]!).toBeGreaterThan(0.05);
    expect(jogged[0]!).toBeLessThan(160);
    for (const j of [1, 2, 3, 4, 5]) expect(jogged[j]! - before[j]!).toBeCloseTo(0, 1);

    await choose(page, "Move Joint");
    await type(page, "Angle J1, °", "5");
    expect(await tryEnabled(page)).toBe("Done.");
    expect((await printJoints(page))[0]).toBeCloseTo(5, 1);

    await choose(page, "Move Joints");
    await type(page, "Angle J1, °", "0");
    await type(page, "Angle J6, °", "10");
    expect(await tryEnabled(page)).toBe("Done.");
    const both = await printJoints(page);
    expect(both[0]).toBeCloseTo(0, 1);
    expect(both[5]).toBeCloseTo(10, 1);

    await choose(page, "Move To Endpoint");
    const z_mm = Number.parseFloat(await page.getByRole("region", { name: "Tester" }).getByLabel("Z, mm").inputValue());
    await type(page, "Z, mm", "+=20");
    expect(await tryEnabled(page)).toBe("Done.");
    await choose(page, "Print Joints");
    await choose(page, "Move To Endpoint");
    const reached = await page.getByRole("region", { name: "Tester" }).getByLabel("Z, mm").inputValue();
    expect(Number.parseFloat(reached) - z_mm).toBeCloseTo(20, 0);

    // T-10: the drives are off, motion is refused until reset.
    await panel.getByRole("button", { name: "Drives off" }).click();
    await panel.getByRole("button", { name: "Reset" }).waitFor();
    expect(await panel.getByRole("button", { name: "Hold to enable" }).isDisabled()).toBe(true);
    await panel.getByRole("button", { name: "Reset" }).click();
    await panel.getByRole("button", { name: "Drives off" }).waitFor();
    expect(problems).toEqual([]);
  }, 240_000);
