import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { Display, isMissing, type OtherBrowser, startFirefox, startWebKit } from "./support/other-browsers.ts";
import { picture, Studio } from "./support/studio.ts";

let studio: Studio;
beforeAll(async () => {
  studio = await Studio.start();
});
afterAll(async () => {
  await studio.stop();
});

const PROBLEMS = `(window.problems ??= (() => { const all = []; addEventListener("error", event => all.push(event.message)); addEventListener("unhandledrejection", event => all.push(String(event.reason))); return all; })())`;
const button = (name: string): string =>
  `[...document.querySelectorAll("button")].find(each => (each.getAttribute("aria-label") ?? each.textContent).trim() === ${JSON.stringify(name)} && each.getBoundingClientRect().width > 0)`;
const joints = (degrees: readonly number[]): string =>
  `window.twincell.live.showJoints(${JSON.stringify(degrees.map(value => (value * Math.PI) / 180))}) ?? null`;
const until = (browser: OtherBrowser, condition: string): Promise<void> =>
  expect.poll(() => browser.evaluate<boolean>(condition), { timeout: 90_000, interval: 200 }).toBe(true);
const steps = `(window.twincell.stores.cellStore.getState().document.programs.flatMap(each => (each.format === "twincell.program" ? each.steps.map(step => step.path ?? step.type) : [])))`;

/** What a person does first, the same in every browser and without a headset: open, teach, check, export. */
async function firstProgram(browser: OtherBrowser, name: string): Promise<void> {
  await browser.goto(studio.url);
  await until(
    browser,
    `!!window.twincell?.stores.cellStore.getState().document && (window.twincellScene?.frames ?? 0) > 1`,
  );
  await browser.evaluate(PROBLEMS);
  await browser.evaluate(`window.twincell.stores.viewStore.setState({ coachDone: true }) ?? null`);

  await browser.evaluate(joints([0, -50, 190, 0, 40, 0]));
  await browser.press(button("PTP"));
  await browser.evaluate(joints([12, -46, 184, 0, 42, 12]));
  await browser.press(button("LIN"));
  await until(browser, `${steps}.join() === "ptp,lin"`);

  await browser.press(`document.querySelector(".topbar .seg [role=radio]:nth-child(3)")`);
  await until(browser, `window.twincell.stores.viewStore.getState().mode === "check"`);
  await until(browser, `window.twincell.stores.playStore.getState().verdict !== null`);
  await browser.screenshot(picture(`other-${name}`));

  await browser.evaluate(`window.twincell.run("export.open")`);
  await until(browser, `window.twincell.stores.postStore.getState().proof?.kind === "proven"`);
  expect(await browser.evaluate(`document.querySelector(".export").textContent.length > 100`)).toBe(true);
  await browser.screenshot(picture(`other-${name}-export`));

  const drawing = await browser.evaluate<{ colours: number; calls: number }>(
    `(() => { const probe = window.twincellScene; const { gl, scene, camera } = probe; gl.render(scene, camera); const view = gl.getContext(); const { drawingBufferWidth: w, drawingBufferHeight: h } = view; const data = new Uint8Array(4 * w * h); view.readPixels(0, 0, w, h, view.RGBA, view.UNSIGNED_BYTE, data); const colours = new Set(); for (let i = 0; i < data.length; i += 404) colours.add(data[i] >> 3 << 10 | data[i + 1] >> 3 << 5 | data[i + 2] >> 3); return { colours: colours.size, calls: probe.drawn().calls }; })()`,
  );
  expect(drawing.calls).toBeGreaterThan(5);
  expect(drawing.colours, "the cell is drawn").toBeGreaterThan(20);
  expect(await browser.evaluate(PROBLEMS)).toEqual([]);
}

describe("L-03 the same build in other browsers, without a headset", () => {
  let display: Display | undefined;
  let browser: OtherBrowser | undefined;
  afterAll(async () => {
    await browser?.close();
    display?.stop();
  });
  test.skipIf(isMissing("firefox"))(
    "L-03 Firefox ESR: opens a cell, teaches two points, checks them and exports a proven text",
    async () => {
      display ??= await Display.start();
      browser = await startFirefox(display);
      expect(browser.version).toMatch(/^Firefox \d+/);
      await firstProgram(browser, "firefox");
      await browser.close();
      browser = undefined;
    },
  );
  test.skipIf(isMissing("webkit"))(
    "L-03 WebKitGTK: opens a cell, teaches two points, checks them and exports a proven text",
    async () => {
      display ??= await Display.start();
      browser = await startWebKit(display);
      expect(browser.version).toMatch(/^WebKitGTK \d+/);
      await firstProgram(browser, "webkit");
      await browser.close();
      browser = undefined;
    },
  );
});
