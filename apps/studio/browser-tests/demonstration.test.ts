import { robotById } from "@twincell/core";
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

/**
 * A hand over the carton with a tremor of 1 mm: a rest, a straight, a quarter of a circle, a rest; 50 samples a second.
 */
function table(): string {
  const lines = ["t_s,x_m,y_m,z_m,rx_deg,ry_deg,rz_deg,closed"];
  let state = 7;
  const tremor = (): number => {
    state = (state * 1_103_515_245 + 12_345) % 2_147_483_648;
    return 0.001 * (state / 1_073_741_824 - 1);
  };
  for (let i = 0; i <= 300; i++) {
    const t = i / 50;
    const angle = (Math.max(0, Math.min(2, t - 3)) / 2) * (Math.PI / 2);
    const x = t < 1 ? 0.55 : t < 3 ? 0.55 + 0.1 * (t - 1) : 0.75 + 0.1 * Math.sin(angle);
    const y = t < 3 ? -0.15 : -0.05 - 0.1 * Math.cos(angle);
    lines.push([t, x + tremor(), y + tremor(), 0.75 + tremor(), 180, 0, 0, t > 5.5 ? 1 : 0].join(","));
  }
  return lines.join("\n");
}

test("M-38 M-39 M-40 M-45 M-46 M-47 L-34 X-47 a dropped demonstration is filtered, laid over the hand with its deviation, becomes steps, and is replayed at will from any side", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  await page.evaluate(() => window.twincell.stores.viewStore.setState({ coachDone: true }));
  await page
    .locator("[data-file-input]")
    .setInputFiles({ name: "hand.csv", mimeType: "text/csv", buffer: Buffer.from(table()) });
  const dialog = page.getByRole("dialog", { name: "hand.csv" });
  await dialog.waitFor();
  const fact = (name: string): Promise<string> =>
    dialog.locator("dl.facts > div", { hasText: name }).locator("dd").innerText();
  expect([await fact("Samples"), await fact("Rate")]).toEqual(["301", "50 a second"]);
  await expect.poll(() => fact("Stops")).toBe("2");
  expect([await fact("Stops"), await fact("Straights"), await fact("Curves")]).toEqual(["2", "1", "1"]);
  expect(Number(await fact("Points left"))).toBeLessThan(20);
  const deviation_mm = parseFloat(await fact("Largest deviation"));
  expect(deviation_mm).toBeGreaterThan(0.5);
  expect(deviation_mm).toBeLessThan(4);
  const rms_mm = parseFloat(await fact("Mean deviation"));
  expect(rms_mm).toBeLessThan(deviation_mm);
  const drawnLines = (): Promise<readonly number[]> =>
    page.evaluate(() =>
      ["demonstration-original", "demonstration-filtered"].map(name => {
        const line = window.twincellScene!.scene.getObjectByName(name) as unknown as
          | { geometry: { getAttribute(of: string): { count: number } } }
          | undefined;
        return line?.geometry.getAttribute("position").count ?? 0;
      }),
    );
  const [original, filtered] = await drawnLines();
  expect(original).toBe(301);
  expect(filtered).toBeGreaterThan(5);
  expect(filtered).toBeLessThan(60);
  await page.screenshot({ path: picture("demonstration") });
  await dialog.getByRole("radio", { name: "Averages" }).click();
  await expect.poll(async () => parseFloat(await fact("Mean deviation"))).not.toBe(rms_mm);
  await dialog.getByRole("radio", { name: "Least squares" }).click();
  await page.setViewportSize({ width: 390, height: 844 });
  await page.screenshot({ path: picture("demonstration-phone") });
  await page.setViewportSize({ width: 1280, height: 800 });
  await dialog.getByRole("button", { name: "Make steps" }).click();
  await dialog.waitFor({ state: "hidden" });
  expect(await drawnLines()).toEqual([0, 0]);
  const kinds = await page.evaluate(() => {
    const [program] = window.twincell.stores.cellStore.getState().document!.programs;
    return program?.format === "twincell.program"
      ? program.steps.map(step => (step.type === "move" ? step.path : step.type))
      : [];
  });
  expect(kinds.slice(0, 2)).toEqual(["ptp", "lin"]);
  expect(kinds.filter(kind => kind === "spline").length).toBeGreaterThanOrEqual(6);
  expect(kinds.at(-1)).toBe("gripper");
  await page.waitForFunction(
    () => {
      const { verdict, stale } = window.twincell.stores.playStore.getState();
      return verdict !== null && !stale;
    },
    null,
    { timeout: 60_000, polling: 100 },
  );
  expect(await page.evaluate(() => window.twincell.stores.playStore.getState().verdict!.ok)).toBe(true);
  await replays(page);
  expect(problems).toEqual([]);
});

/** Played three times to its end; one animation at a time; the view is turned and zoomed while the robot moves. */
async function replays(page: Page): Promise<void> {
  const state = () =>
    page.evaluate(() => {
      const { playing, t_s, plan } = window.twincell.stores.playStore.getState();
      return { playing, t_s, duration_s: plan!.duration_s, q: Array.from(window.twincell.live.now().q_rad) };
    });
  const playing = (is: boolean): Promise<unknown> =>
    page.waitForFunction(wanted => window.twincell.stores.playStore.getState().playing === wanted, is, { polling: 50 });
  const { duration_s } = await state();
  const ends: number[][] = [];
  for (let round = 0; round < 3; round++) {
    await page.evaluate(to => window.twincell.seek(to), duration_s - 0.6);
    await page.getByRole("button", { name: "Play", exact: true }).click();
    await playing(false);
    const now = await state();
    expect(now.t_s).toBeCloseTo(duration_s, 9);
    ends.push(now.q);
  }
  expect(ends[1]).toEqual(ends[0]);
  expect(ends[2]).toEqual(ends[0]);

  // From the start again: the view is turned and zoomed towards the pointer while it plays.
  await page.getByRole("button", { name: "Play", exact: true }).click();
  await playing(true);
  const camera = () =>
    page.evaluate(() => {
      const { x, y, z } = window.twincellScene!.camera.position;
      return [x, y, z];
    });
  const before = await camera();
  const view = (await page.locator(".viewport canvas").boundingBox())!;
  const at = { x: view.x + 0.12 * view.width, y: view.y + 0.7 * view.height };
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await page.mouse.move(at.x + 160, at.y - 60, { steps: 4 });
  await page.mouse.up();
  const turned = await camera();
  const apart = (a: readonly number[], b: readonly number[]): number =>
    Math.hypot(...a.map((value, i) => value - b[i]!));
  expect(apart(turned, before)).toBeGreaterThan(0.2);
  await page.mouse.wheel(0, -400);
  await expect.poll(async () => apart(await camera(), turned)).toBeGreaterThan(0.1);
  expect((await state()).playing).toBe(true);

  // Paused it stands; resumed it goes on from there; another animation ends this one.
  await page.getByRole("button", { name: "Pause", exact: true }).click();
  const held = await state();
  await page.mouse.move(at.x, at.y);
  expect((await state()).q).toEqual(held.q);
  await page.getByRole("button", { name: "Play", exact: true }).click();
  await page.waitForFunction(from => window.twincell.stores.playStore.getState().t_s > from, held.t_s, { polling: 50 });
  await page.getByRole("button", { name: "Home", exact: true }).first().click();
  await playing(false);
  const home = [...robotById("staubli_rx90l")!.home_rad];
  await page.waitForFunction(
    goal => goal.every((angle, j) => Math.abs(angle - window.twincell.live.now().q_rad[j]!) < 1e-9),
    home,
    { polling: 100 },
  );
}

test("a table that is no demonstration is refused with its line, and nothing changes", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  await page
    .locator("[data-file-input]")
    .setInputFiles({ name: "bad.csv", mimeType: "text/csv", buffer: Buffer.from("a,b\n1,2\n") });
  await page.getByText("bad.csv, line 1: The column of times, t_s or t_ms, is missing.").waitFor();
  expect(problems).toEqual([]);
});
