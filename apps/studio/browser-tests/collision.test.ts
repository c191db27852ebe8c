import type { MoveStep, Vector3 } from "@twincell/core";
import { edgeTraceCell, saveDocument } from "@twincell/project";
import { afterAll, beforeAll, expect, test } from "vitest";
import { drawn, picture, Studio } from "./support/studio.ts";

let studio: Studio;
beforeAll(async () => {
  studio = await Studio.start();
});
afterAll(async () => {
  await studio.stop();
});

const cell = edgeTraceCell();
const [x, y, z] = cell.objects.find(({ id }) => id === "carton")!.worldFromObject.position;
const at = (id: string, path: MoveStep["path"], position: Vector3): MoveStep => ({
  id,
  type: "move",
  path,
  speed: path === "ptp" ? { ratio: 0.4 } : { mps: 0.2 },
  blend_m: 0,
  target: { pose: { position, quaternion: [0, 1, 0, 0] }, frame: "world", tool: cell.tool },
});
/** A straight move through the carton. */
const program = {
  ...cell.programs[0]!,
  tools: Object.fromEntries(cell.tools.map(tool => [tool.name, tool.flangeFromTcp])),
  steps: [
    at("p1", "ptp", [x, y - 0.4, z + 0.05]),
    at("p2", "lin", [x, y + 0.4, z + 0.05]),
    at("p3", "ptp", [x, y + 0.35, z + 0.4]),
  ],
};

test.each([
  ["desktop", 1280, 800],
  ["phone", 390, 844],
] as const)(
  "a step through the carton goes round it with one click; the matrix is learnt and edited; %s",
  async (name, width, height) => {
    const { page, problems } = await studio.open({ width, height });
    page.setDefaultTimeout(120_000);
    await drawn(page);
    await page.evaluate(
      text => {
        window.twincell.stores.viewStore.setState({ coachDone: true, mode: "check", sheet: "why" });
        return window.twincell.document.open(text, "cell.json");
      },
      saveDocument({ ...cell, programs: [program], program: program.name }),
    );
    await page.getByRole("button", { name: "Find a way round" }).click();
    await page.waitForFunction(() => window.twincell.stores.playStore.getState().verdict?.ok === true, null, {
      polling: 200,
    });
    expect(
      await page.evaluate(
        () =>
          window.twincell.stores.cellStore
            .getState()
            .document!.programs.filter(program => program.format === "twincell.program")[0]!.steps.length,
      ),
    ).toBeGreaterThan(3);
    await page.screenshot({ path: picture(`way-round-${name}`), timeout: 120_000 });

    await page.locator(".clearance").click();
    await page.getByRole("radio", { name: /^Stop and go back/ }).check();
    await page.getByRole("button", { name: "Learn", exact: true }).click();
    const pair = page.getByRole("button", { name: /^link 0 and link 2: checked/ });
    await pair.click();
    await page.getByRole("button", { name: /^link 0 and link 2: left out/ }).waitFor();
    await page.screenshot({ path: picture(`collision-${name}`), timeout: 120_000 });
    expect(
      await page.evaluate(
        () =>
          window.twincell.stores.cellStore
            .getState()
            .document!.pairs!.entries.find(({ a, b }) => a === "link 0" && b === "link 2")!.watched,
      ),
    ).toBe(false);
    expect(await page.evaluate(() => localStorage.getItem("twincell.preferences"))).toContain('"collision":"stop"');
    expect(problems).toEqual([]);
  },
);

test("T-64 registration and twin error are typed in Collision, added to the shape error in sight, and taken back by undo", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  await page.evaluate(() => {
    window.twincell.stores.viewStore.setState({ coachDone: true });
    window.twincell.run("view.collision");
  });
  const dialog = page.getByRole("dialog", { name: "Collision" });
  await dialog.getByText(/^With the shape error 20\.0 mm are kept/).waitFor();
  for (const [name, mm] of [
    ["Registration", "3.5"],
    ["Twin", "1.5"],
  ] as const) {
    // What the field is about stands beside it, not only in the name that is read aloud.
    await dialog.getByText(name, { exact: true }).waitFor();
    await dialog.getByLabel(name).fill(mm);
    await dialog.getByLabel(name).press("Enter");
  }
  await dialog.getByText(/^With the shape error 25\.0 mm are kept/).waitFor();
  await page.screenshot({ path: picture("collision-errors") });
  const errors = () => page.evaluate(() => window.twincell.stores.cellStore.getState().document?.errors);
  expect(await errors()).toEqual({ registration_m: 0.0035, twin_m: 0.0015 });
  await dialog.getByRole("button", { name: "Close" }).click();
  await dialog.waitFor({ state: "hidden" });
  await page.keyboard.press("Control+z");
  expect((await errors())?.twin_m ?? 0).toBe(0);
  expect(problems).toEqual([]);
});
