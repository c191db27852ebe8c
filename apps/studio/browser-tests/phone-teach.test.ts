import { distance, type Vector3 } from "@twincell/core";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { Fingers } from "./support/fingers.ts";
import { drawn, picture, Studio } from "./support/studio.ts";

let studio: Studio;
beforeAll(async () => {
  studio = await Studio.start();
});
afterAll(async () => {
  await studio.stop();
});

const tcp = (page: Page): Promise<Vector3> =>
  page.evaluate(() => {
    const [x, y, z] = window.twincell.live.now().worldFromTcp.position;
    return [x, y, z];
  });
async function middle(page: Page, selector: string): Promise<{ x: number; y: number; rim: number }> {
  const box = (await page.locator(selector).boundingBox())!;
  return { x: box.x + box.width / 2, y: box.y + box.height / 2, rim: 0.46 * box.height };
}
const paths = (page: Page): Promise<string[]> =>
  page.evaluate(() =>
    window.twincell.stores.cellStore
      .getState()
      .document!.programs.flatMap(each => (each.format === "twincell.program" ? each.steps : []))
      .map(step => (step.type === "move" ? step.path : step.type)),
  );
const BENT_DEG = [0, -50, 190, 0, 40, 0];

/** Waits until the page was drawn so often: time enough for a robot that still moves to be seen moving. */
const framesDrawn = (page: Page, count: number): Promise<void> =>
  page.evaluate(async wanted => {
    for (let i = 0; i < wanted; i++)
      await new Promise<void>(resolve => {
        requestAnimationFrame(() => {
          resolve();
        });
      });
  }, count);

describe.each([
  { width: 390, height: 844 },
  { width: 360, height: 740 },
])("L-60 on a phone of $width × $height", ({ width, height }) => {
  test("two thumbs teach: nothing moves without the switch, deflection is speed, letting go of either stops at once", async () => {
    const { page, context, problems } = await studio.open({ width, height, touch: true });
    await drawn(page);
    await page.evaluate(q_deg => {
      window.twincell.stores.viewStore.setState({ coachDone: true });
      window.twincell.live.showJoints(q_deg.map(value => (value * Math.PI) / 180));
    }, BENT_DEG);
    const fingers = new Fingers(await context.newCDPSession(page));
    const pad = await middle(page, ".phone-pad");
    const rocker = await middle(page, ".phone-rocker");
    const enable = await middle(page, ".phone-enable");
    const start = await tcp(page);

    await fingers.put(1, pad.x, pad.y - pad.rim);
    await framesDrawn(page, 20);
    await fingers.lift(1);
    expect(distance(await tcp(page), start), "without the switch").toBe(0);

    await fingers.put(2, enable.x, enable.y);
    expect(await page.locator(".phone-enable").getAttribute("aria-pressed")).toBe("true");
    await page.screenshot({ path: picture(`phone-teach-${width}`) });
    await fingers.put(1, pad.x, pad.y - pad.rim);
    await page.waitForFunction(x => window.twincell.live.now().worldFromTcp.position[0] > x + 0.02, start[0]);
    const forward = await tcp(page);
    expect(Math.abs(forward[1] - start[1]) + Math.abs(forward[2] - start[2]), "along X alone").toBeLessThan(1e-6);
    // The switch let go under a held pad: at once nothing.
    await fingers.lift(2);
    const stopped = await tcp(page);
    await framesDrawn(page, 20);
    expect(distance(await tcp(page), stopped)).toBeLessThan(0.004);
    await fingers.lift(1);

    await fingers.put(2, enable.x, enable.y);
    await fingers.put(1, rocker.x, rocker.y - rocker.rim);
    await page.waitForFunction(z => window.twincell.live.now().worldFromTcp.position[2] > z + 0.01, stopped[2]);
    await fingers.lift(1);
    const up = await tcp(page);
    await framesDrawn(page, 20);
    expect(distance(await tcp(page), up), "the pad let go").toBeLessThan(0.004);
    await fingers.lift(2);

    await page.getByRole("button", { name: "PTP", exact: true }).first().tap();
    await page.getByRole("button", { name: "LIN", exact: true }).first().tap();
    await page.locator(".phone-record .btn").nth(2).tap();
    expect(await paths(page)).toEqual(["ptp", "lin", "gripper"]);
    expect(await page.locator(".phone-chips .btn").count()).toBe(3);
    expect(problems).toEqual([]);
    await context.close();
  });

  test("everything to be touched is 44 px or more, nothing is cut off at the side, and no key is named", async () => {
    const { page, context } = await studio.open({ width, height, touch: true });
    await drawn(page);
    const found = await page.evaluate(() => {
      const teach = document.querySelector(".phone-teach")!;
      const small = [...teach.querySelectorAll("button, .phone-pad, .phone-rocker")]
        .map(each => ({ says: each.textContent ?? "", box: each.getBoundingClientRect() }))
        .filter(({ box }) => box.width < 44 || box.height < 44)
        .map(({ says, box }) => `${says} ${box.width.toFixed(0)} × ${box.height.toFixed(0)}`);
      const switchBox = teach.querySelector(".phone-enable")!.getBoundingClientRect();
      return {
        small,
        wide: document.documentElement.scrollWidth,
        span: switchBox.width,
        inSight: switchBox.bottom <= innerHeight && switchBox.top >= 0,
        keys: teach.querySelectorAll(".kbd").length,
      };
    });
    expect(found.small).toEqual([]);
    expect(found.wide).toBeLessThanOrEqual(width);
    expect(found.span).toBeGreaterThan(0.9 * width);
    expect(found.inSight).toBe(true);
    expect(found.keys).toBe(0);
    await context.close();
  });
});
