import { identity, type MoveStep, type Pose } from "@twincell/core";
import { saveDocument, tracedCartonCell, type CellDocument } from "@twincell/project";
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

/** Far in front of the robot, the flange looking down: two robots that face each other at 1.4 m meet there. */
const to = (id: string, y: number): MoveStep => ({
  id,
  type: "move",
  path: "ptp",
  speed: { ratio: 0.3 },
  blend_m: 0,
  target: {
    pose: { position: [0.65, y, 0.4], quaternion: [0, 1, 0, 0] } as unknown as Pose<"frame", "tcp">,
    frame: "world",
    tool: "flange",
  },
});
const carton = tracedCartonCell();
const cell: CellDocument = {
  ...carton,
  name: "Face to face",
  robot: { ...carton.robot, worldFromBase: identity() },
  objects: [],
  frames: [],
  program: "To and fro",
  programs: [
    {
      ...carton.programs[0]!,
      name: "To and fro",
      tools: {},
      frames: {},
      groups: {},
      steps: Array.from({ length: 16 }, (_, i) => to(`p${i}`, i % 2 ? 0.12 : -0.12)),
    },
  ],
};

async function add(
  page: Page,
  kind: string,
  at: { readonly x: number; readonly turned: number; readonly watch?: boolean },
): Promise<void> {
  await page.getByRole("button", { name: "Add a controller" }).first().click();
  const dialog = page.getByRole("dialog", { name: "Add a controller to the cell" });
  await dialog.getByRole("combobox", { name: "Manufacturer" }).click();
  await page.getByRole("option", { name: kind }).click();
  for (const [label, value] of [
    ["x", at.x],
    ["y", 1600],
    ["Rotation", at.turned],
  ] as const) {
    const field = dialog.getByRole("textbox", { name: new RegExp(`^${label}, `) });
    await field.fill(String(value));
    await field.blur();
  }
  if (at.watch === true) await dialog.getByRole("radio", { name: "to watch only" }).click();
  await dialog.getByRole("button", { name: "Add and connect" }).click();
  await dialog.waitFor({ state: "detached", timeout: 30_000 });
}
const state = (page: Page, kind: string) =>
  page.evaluate(
    of => window.twincell.stores.stationStore.getState().stations.find(station => station.brand === of),
    kind,
  );
const until = (page: Page, kind: string, so: string): Promise<unknown> =>
  page
    .waitForFunction(
      ([of, what]) => {
        const station = window.twincell.stores.stationStore.getState().stations.find(each => each.brand === of);
        if (!station) return false;
        switch (what) {
          case "told why":
            return !station.running && !station.moving && station.notice !== "";
          case "ghost":
            return station.ghost !== "none";
          case "no ghost":
            return station.ghost === "none";
          default:
            return station.link.state === what;
        }
      },
      [kind, so] as const,
      { timeout: 30_000, polling: 50 },
    )
    .catch(async () => {
      throw new Error(`${kind} is not ${so}: ${JSON.stringify(await state(page, kind))}`);
    });
const card = (page: Page, name: RegExp) => page.getByRole("article", { name });

test("T-24 T-26 T-63 two robots that face each other: the ghost runs ahead, a blocked way is not sent, a common start is stopped before contact, and watched only nothing is commanded", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  await page.evaluate(text => {
    window.twincell.stores.viewStore.setState({ coachDone: true });
    return window.twincell.document.open(text, "cell.json");
  }, saveDocument(cell));
  await page.getByRole("radio", { name: "Run" }).click();
  await add(page, "Universal Robots", { x: 0, turned: 0 });
  await add(page, "KUKA", { x: 1400, turned: 180 });
  for (const kind of ["ur", "kuka"]) await until(page, kind, "open");
  const ur = card(page, /Controller .*UR10e/);

  // Simulate ahead: the ghost goes through the program, and the robot stays.
  await ur.getByRole("button", { name: "Look ahead" }).click();
  await until(page, "ur", "ghost");
  // Until it can be told from the robot in the picture.
  await page.waitForFunction(
    () => {
      const station = window.twincell.stores.stationStore.getState().stations.find(({ brand: kind }) => kind === "ur");
      const live = station && window.twincell.live.station(station.id);
      return live !== undefined && live.q_rad.some((q, i) => Math.abs(q - live.ahead.q_rad[i]!) > 0.2);
    },
    null,
    { timeout: 30_000, polling: 50 },
  );
  await page.screenshot({ path: picture("twin-ghost") });
  expect((await state(page, "ur"))?.moving).toBe(false);
  await until(page, "ur", "no ghost");

  // Started together they would meet: all are stopped before they do.
  await page.getByRole("button", { name: "Start together" }).click();
  await until(page, "ur", "told why");
  await until(page, "kuka", "told why");
  const said = [(await state(page, "ur"))!.notice, (await state(page, "kuka"))!.notice].join(" ");
  expect(said).toMatch(/would have come within \d+ mm of .*(are kept)/);
  expect(said).toMatch(/was stopped with .*, with which it was started/);
  await page.screenshot({ path: picture("twin-stopped-together") });

  await ur.getByRole("button", { name: /^More: / }).click();
  await page.screenshot({ path: picture("twin-details") });

  // Watched only.
  await ur.getByRole("button", { name: "Only watch" }).click();
  await ur.getByText("Watched only. Nothing is commanded from here; STOP still stops it.").waitFor();
  expect(await ur.getByRole("button", { name: "Run here" }).count()).toBe(0);
  await page.getByRole("button", { name: "Run on all" }).waitFor();
  await page.screenshot({ path: picture("twin-watched") });
  await page.setViewportSize({ width: 390, height: 844 });
  await page.screenshot({ path: picture("twin-watched-phone") });
  await page.setViewportSize({ width: 1440, height: 900 });
  await ur.getByRole("button", { name: "Take control" }).click();
  await ur.getByRole("button", { name: "Run here" }).waitFor();
  expect((await state(page, "ur"))?.guard).toMatchObject({ watching: false, holder: "you" });
  expect(problems).toEqual([]);
}, 240_000);
