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

/** Points in front of any arm of 0.7 m and more, the flange looking down. */
const to = (id: string, x: number, y: number, z: number): MoveStep => ({
  id,
  type: "move",
  path: "ptp",
  speed: { ratio: 0.3 },
  blend_m: 0,
  target: {
    pose: { position: [x, y, z], quaternion: [0, 1, 0, 0] } as unknown as Pose<"frame", "tcp">,
    frame: "world",
    tool: "flange",
  },
});
/** So often that the quickest of three robots still moves when the slowest has begun. */
const TO_AND_FRO = Array.from({ length: 16 }, (_, i) => to(`s${i + 1}`, 0.42, i % 2 === 0 ? -0.12 : 0.12, 0.4));
const carton = tracedCartonCell();
const cell: CellDocument = {
  ...carton,
  name: "Three brands",
  robot: { ...carton.robot, worldFromBase: identity() },
  objects: [],
  frames: [],
  program: "To and fro",
  programs: [{ ...carton.programs[0]!, name: "To and fro", tools: {}, frames: {}, groups: {}, steps: TO_AND_FRO }],
};

async function add(page: Page, kind: string, robot: string): Promise<void> {
  await page.getByRole("button", { name: "Add a controller" }).first().click();
  const dialog = page.getByRole("dialog", { name: "Add a controller to the cell" });
  await dialog.getByRole("combobox", { name: "Manufacturer" }).click();
  await page.getByRole("option", { name: kind }).click();
  if (!(await dialog.getByRole("combobox", { name: "Robot" }).innerText()).includes(robot)) {
    await dialog.getByRole("combobox", { name: "Robot" }).click();
    await page.getByRole("option", { name: robot }).click();
  }
  await dialog.getByRole("button", { name: "Add and connect" }).click();
  await dialog.waitFor({ state: "detached", timeout: 30_000 });
}
const stations = (page: Page) =>
  page.evaluate(() =>
    window.twincell.stores.stationStore
      .getState()
      .stations.map(({ id, brand: kind, link, guard, moving, running, notice, safety }) => ({
        id,
        brand: kind,
        link: link.state,
        guard: guard.link,
        moving,
        running,
        notice,
        safety,
      })),
  );
const until = (page: Page, id: string, so: string): Promise<unknown> =>
  page.waitForFunction(
    ([of, what]) => {
      const station = window.twincell.stores.stationStore.getState().stations.find(each => each.brand === of);
      return (
        station !== undefined &&
        (what === "moving" ? station.moving : what === "at rest" ? !station.running : station.link.state === what)
      );
    },
    [id, so] as const,
    { timeout: 60_000, polling: 50 },
  );

/** In the page: every arm of another controller is inside the picture, the one that came last as well. */
function allInside(): boolean {
  const { scene, gl, project } = window.twincellScene!;
  const picture = gl.domElement.getBoundingClientRect();
  let parts = 0;
  let outside = 0;
  scene.traverse(object => {
    if (object.userData["station"] !== true) return;
    object.traverse(part => {
      if (!("isMesh" in part)) return;
      const { geometry } = part as unknown as {
        readonly geometry: {
          computeBoundingBox(): void;
          readonly boundingBox: {
            clone(): {
              applyMatrix4(matrix: unknown): {
                readonly min: { x: number; y: number; z: number };
                readonly max: { x: number; y: number; z: number };
              };
            };
          };
        };
      };
      geometry.computeBoundingBox();
      const { min, max } = geometry.boundingBox.clone().applyMatrix4(part.matrixWorld);
      // The scene's y is up; the world's z is.
      const at = project([(min.x + max.x) / 2, -(min.z + max.z) / 2, (min.y + max.y) / 2]);
      parts++;
      if (!at.visible || at.x < picture.left || at.x > picture.right || at.y < picture.top || at.y > picture.bottom)
        outside++;
    });
  });
  return parts > 10 && outside === 0;
}

test("T-24 T-54 X-41 three makers' controllers at once: one program on all, the plug of one is pulled, and that moment comes back", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  await page.evaluate(text => {
    window.twincell.stores.viewStore.setState({ coachDone: true });
    return window.twincell.document.open(text, "cell.json");
  }, saveDocument(cell));
  await page.getByRole("radio", { name: "Run" }).click();
  await add(page, "Universal Robots", "UR10e");
  await add(page, "Yaskawa", "GP8");
  await add(page, "KUKA", "KR 6 R900");
  for (const kind of ["ur", "yaskawa", "kuka"]) await until(page, kind, "open");
  await page.waitForFunction(allInside, null, { timeout: 10_000, polling: 100 });
  await page.screenshot({ path: picture("controllers-connected") });

  await page.getByRole("button", { name: "Run on all" }).click();
  for (const kind of ["ur", "yaskawa", "kuka"]) await until(page, kind, "moving");
  const yaskawa = page.getByRole("article", { name: /Controller .*GP8/ });
  await yaskawa.getByRole("button", { name: "Disconnect (simulate)" }).click();
  await until(page, "yaskawa", "lost");
  await yaskawa
    .getByText(/Nothing (came from|was heard of) .* for \d+ ms|is not connected|did not answer/)
    .first()
    .waitFor();
  await page.screenshot({ path: picture("controllers-unplugged") });
  for (const kind of ["ur", "kuka", "yaskawa"]) await until(page, kind, "at rest");
  expect((await stations(page)).map(({ brand: kind, link, notice }) => [kind, link === "open", notice === ""])).toEqual(
    [
      ["ur", true, true],
      ["yaskawa", false, false],
      ["kuka", true, true],
    ],
  );

  // The plug goes back: the link comes by itself, motion only after a person's word.
  await yaskawa.getByRole("button", { name: "Put the plug back" }).click();
  await until(page, "yaskawa", "open");
  expect((await stations(page)).find(({ brand: kind }) => kind === "yaskawa")).toMatchObject({
    guard: "unconfirmed",
    moving: false,
  });
  expect(await yaskawa.getByRole("button", { name: "Run here" }).isDisabled()).toBe(true);
  await yaskawa.getByRole("button", { name: "Resume" }).click();
  await page.waitForFunction(
    () =>
      window.twincell.stores.stationStore.getState().stations.find(({ brand: kind }) => kind === "yaskawa")?.guard
        .link === "up",
    null,
    { timeout: 10_000 },
  );

  await page.getByRole("radio", { name: "History" }).click();
  await page
    .getByRole("button", { name: /GP8.*To and fro/ })
    .first()
    .click();
  await page.waitForFunction(() => window.twincell.stores.historyStore.getState().duration_s > 0.2, null, {
    timeout: 30_000,
  });
  const lost = page
    .locator(".history-events li")
    .filter({ hasText: /Nothing (came from|was heard of)|is not connected|did not answer/ })
    .first();
  await lost.getByRole("button").click();
  await page.waitForFunction(() => window.twincell.stores.historyStore.getState().t_s > 0.2, null, { timeout: 10_000 });
  await page.screenshot({ path: picture("controllers-travelled-back") });
  expect(problems).toEqual([]);
}, 240_000);
