import { edgeTraceCell } from "@twincell/project";
import type { Vector3 } from "@twincell/core";
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

const carton = edgeTraceCell().objects.find(object => object.id === "carton")!;
const [cx, cy, cz] = carton.worldFromObject.position;

/** The verdict of the program as it is now: of the check that was asked for last. */
const judged = async (page: Page): Promise<void> => {
  await page.waitForFunction(
    () =>
      window.twincell.stores.playStore.getState().verdict !== null &&
      window.twincell.stores.playStore.getState().checking === null,
    null,
    { timeout: 60_000 },
  );
};
const pathEnds = (page: Page): Promise<Vector3[]> =>
  page.evaluate(() =>
    window.twincell.stores.playStore
      .getState()
      .path.filter(({ points }) => points.length > 0)
      .map(({ points }) => [...points.at(-1)!] as [number, number, number]),
  );
const offEdge = (page: Page): Promise<number[]> =>
  page.evaluate(() =>
    window.twincell.stores.playStore
      .getState()
      .verdict!.steps.flatMap(({ findings }) =>
        findings.flatMap(({ code, value }) => (code === "edge.off" ? [value] : [])),
      ),
  );

test("a traced path follows the carton that is moved in the inspector; the check finds none of it off its edge", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  await page.getByRole("button", { name: /^Trace/ }).click();
  const edge: Vector3 = [cx - 0.15, cy + 0.07, cz + 0.1];
  const at = await page.evaluate(where => window.twincellScene!.project(where), edge);
  await page.mouse.move(at.x - 3, at.y - 2);
  await page.mouse.move(at.x, at.y);
  await page.waitForFunction(() => window.twincell.stores.traceStore.getState().hovered !== null);
  await page.mouse.click(at.x, at.y);
  await page.waitForFunction(() => window.twincell.stores.traceStore.getState().chosen.length === 1);
  await page.getByRole("button", { name: "Make points" }).click();
  await judged(page);
  const before = await pathEnds(page);
  expect(await offEdge(page)).toEqual([]);
  await page.getByRole("button", { name: "Done tracing" }).click();

  await page.getByRole("button", { name: "Carton", exact: true }).click();
  const field = page.getByRole("textbox", { name: "Position X" }).first();
  await field.fill(String((cx + 0.02) * 1000));
  const old = await page.evaluate(() => window.twincell.stores.playStore.getState().verdict!.duration_s);
  await field.press("Enter");
  await page.waitForFunction(
    was => {
      const { verdict, checking } = window.twincell.stores.playStore.getState();
      return checking === null && verdict !== null && verdict.duration_s !== was;
    },
    old,
    { timeout: 60_000 },
  );
  const after = await pathEnds(page);
  expect(after.length).toBe(before.length);
  const moved = after.filter((point, i) => Math.abs(point[0] - before[i]![0] - 0.02) < 1e-4).length;
  // All but the home positions before and after.
  expect(moved).toBeGreaterThanOrEqual(after.length - 2);
  expect(await offEdge(page)).toEqual([]);
  await page.screenshot({ path: picture("building-path-followed") });
  expect(problems).toEqual([]);
}, 120_000);
