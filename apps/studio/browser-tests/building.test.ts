import { readFileSync } from "node:fs";
import { edgeTraceCell, pickAndPlaceCell, saveDocument } from "@twincell/project";
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

/** Where the handle along that axis of the world is, and a spot farther along it, on the page. */
const handle = (page: Page, pivot: Vector3, axis: 0 | 1 | 2, way_m: number) =>
  page.evaluate(
    ([at, k, way]) => {
      const scene = window.twincellScene!;
      const camera = scene.camera as unknown as { fov: number; position: { x: number; y: number; z: number } };
      const eye = camera.position;
      const distance = Math.hypot(eye.x - at[0], eye.y - at[2], eye.z + at[1]);
      const reach = (distance * 1.9 * Math.tan((Math.PI * camera.fov) / 360) * 0.85) / 4;
      const on: [number, number, number] = [at[0], at[1], at[2]];
      on[k] += reach * 0.45;
      const to: [number, number, number] = [on[0], on[1], on[2]];
      to[k] += way;
      return { from: scene.project(on), to: scene.project(to) };
    },
    [pivot, axis, way_m] as const,
  );
const placeOf = (page: Page, id: string): Promise<Vector3> =>
  page.evaluate(
    which =>
      [
        ...window.twincell.stores.cellStore.getState().document!.objects.find(object => object.id === which)!
          .worldFromObject.position,
      ] as [number, number, number],
    id,
  );
async function drag(page: Page, { from, to }: Awaited<ReturnType<typeof handle>>, during?: () => Promise<void>) {
  await page.mouse.move(from.x - 2, from.y);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  for (let i = 1; i <= 8; i++)
    await page.mouse.move(from.x + ((to.x - from.x) * i) / 8, from.y + ((to.y - from.y) * i) / 8);
  await during?.();
  await page.mouse.up();
}

test("the carton is moved by its handle on the grid, by a typed number and back with one undo each; locked it has none", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  await page
    .getByRole("radio", { name: "Cell", exact: true })
    .or(page.getByRole("tab", { name: "Cell" }))
    .first()
    .click();
  await page.getByTitle("work piece").first().click();
  const start = await placeOf(page, "carton");
  await page.waitForFunction(() =>
    window.twincellScene!.scene.children.some(child => child.userData["unpickable"] === true),
  );
  await page.screenshot({ path: picture("building-gizmo") });

  await drag(page, await handle(page, start, 1, 0.12));
  const moved = await placeOf(page, "carton");
  expect(moved[0]).toBeCloseTo(start[0], 9);
  expect(moved[2]).toBeCloseTo(start[2], 9);
  expect(moved[1] - start[1]).toBeGreaterThan(0.05);
  // On the grid of 10 mm, or flush with something.
  await page.keyboard.press("Control+z");
  expect(await placeOf(page, "carton")).toEqual(start);

  await drag(page, await handle(page, start, 1, 0.05), async () => {
    await page.keyboard.type("-123.5");
    await page.screenshot({ path: picture("building-typed") });
  });
  expect((await placeOf(page, "carton"))[1]).toBeCloseTo(-0.1235, 9);
  await page.keyboard.press("Control+z");

  await drag(page, await handle(page, start, 1, 0.05), async () => {
    await page.keyboard.press("Escape");
  });
  expect(await placeOf(page, "carton")).toEqual(start);
  expect(await page.evaluate(() => window.twincell.stores.cellStore.getState().undo.length)).toBe(0);

  await page.getByTitle("work piece").first().click({ button: "right" });
  await page.getByRole("menuitem", { name: "Lock" }).click();
  await drag(page, await handle(page, start, 1, 0.05));
  expect(await placeOf(page, "carton")).toEqual(start);
  expect(problems).toEqual([]);
}, 120_000);

test("a part is dragged from the library onto the floor, another onto the table; its length is typed; one undo each", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  await page.getByRole("radio", { name: "Cell", exact: true }).click();
  await page.getByRole("button", { name: /^Pallet EUR 1/ }).hover();
  // The drawer takes room from the view.
  await page.waitForFunction(
    () =>
      document.querySelector("canvas")!.getBoundingClientRect().bottom <=
      document.querySelector(".parts")!.getBoundingClientRect().top + 1,
  );
  const floor = await page.evaluate(() => window.twincellScene!.project([0.3, 0.75, 0]));
  await page.mouse.down();
  await page.mouse.move(floor.x - 20, floor.y - 20);
  await page.mouse.move(floor.x, floor.y, { steps: 4 });
  await page.screenshot({ path: picture("building-drop") });
  await page.mouse.up();
  await page.waitForFunction(() =>
    window.twincell.stores.cellStore.getState().document!.objects.some(object => object.id === "pallet-1"),
  );
  const pallet = await placeOf(page, "pallet-1");
  expect(pallet[0]).toBeCloseTo(0.3, 1);
  expect(pallet[1]).toBeCloseTo(0.75, 1);
  expect(pallet[2]).toBe(0);
  const top = await page.evaluate(() => window.twincellScene!.project([0.3, 0.75, 0.144]));
  await page
    .getByRole("button", { name: /^Carton/ })
    .last()
    .dragTo(page.locator("canvas").first(), {
      targetPosition: await page
        .locator("canvas")
        .first()
        .boundingBox()
        .then(box => ({ x: top.x - box!.x, y: top.y - box!.y })),
    });
  await page.waitForFunction(() =>
    window.twincell.stores.cellStore.getState().document!.objects.some(object => object.id === "carton-2"),
  );
  expect((await placeOf(page, "carton-2"))[2]).toBeCloseTo(0.144, 3);

  await page.getByRole("button", { name: /^Roller conveyor/ }).click();
  const field = page.getByRole("textbox", { name: "Length", exact: false }).first();
  await field.fill("2400");
  await field.press("Enter");
  const conveyor = () =>
    page.evaluate(() => {
      const object = window.twincell.stores.cellStore
        .getState()
        .document!.objects.find(each => each.id === "roller-conveyor-1")!;
      return object.shape.kind === "part" ? object.shape.parameters["length"] : undefined;
    });
  expect(await conveyor()).toBeCloseTo(2.4, 9);
  await page.getByRole("button", { name: /^Work table/ }).click();
  await page.getByRole("button", { name: /^Person/ }).click();
  await page.getByRole("button", { name: /^Fence/ }).click();
  await page.evaluate(() => window.twincell.run("view.fit"));
  // The flight to the new view has ended when no frame follows any more.
  await page.waitForFunction(async () => {
    const before = window.twincellScene!.frames;
    await new Promise(resolve => setTimeout(resolve, 400));
    return window.twincellScene!.frames === before;
  });
  await page.screenshot({ path: picture("building-parts") });
  await page.evaluate(() => {
    for (let i = 0; i < 4; i++) window.twincell.run("edit.undo");
  });
  expect(await conveyor()).toBe(1.6);
  expect(problems).toEqual([]);
}, 120_000);

test("M-07 two corners of the carton are measured by two clicks: 400.0 mm apart; carton and table interfere or not, with the number", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  await page.getByRole("radio", { name: "Cell", exact: true }).click();
  await page.getByRole("button", { name: /^Pallet EUR 1/ }).waitFor();
  await page.waitForFunction(
    () =>
      document.querySelector("canvas")!.getBoundingClientRect().bottom <=
      document.querySelector(".parts")!.getBoundingClientRect().top + 1,
  );
  await page.getByRole("button", { name: "Measure" }).click();
  const click = async (point: Vector3): Promise<void> => {
    const at = await page.evaluate(where => window.twincellScene!.project(where), point);
    await page.mouse.click(at.x, at.y);
  };
  // A little inside the two corners of the top's front edge.
  await click([cx + 0.148, cy - 0.198, cz + 0.1]);
  await click([cx + 0.148, cy + 0.198, cz + 0.1]);
  const card = page.getByRole("region", { name: "Measure" });
  await card.getByText("400.0").first().waitFor();
  expect(await card.innerText()).not.toContain("interfere");
  await page.screenshot({ path: picture("building-measure") });
  await page.keyboard.press("Escape");
  await card.getByText("Pick a corner").waitFor();
  expect(problems).toEqual([]);
}, 120_000);

test("M-10 a palletising cell is built from an empty one by clicks and typed numbers alone, saved, and drawn in four ways", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  await page.getByRole("button", { name: /Cell menu/ }).click();
  await page.getByRole("menuitem", { name: "New empty cell" }).click();
  await page.waitForFunction(() => window.twincell.stores.cellStore.getState().document!.objects.length === 0);
  await page.getByRole("radio", { name: "Cell", exact: true }).click();
  const type = async (name: string, value: string): Promise<void> => {
    const field = page.getByRole("textbox", { name }).first();
    await field.fill(value);
    await field.press("Enter");
  };
  const place = async (
    part: RegExp,
    x: string,
    y: string,
    z: string,
    numbers: readonly (readonly [string, string])[] = [],
  ) => {
    await page.getByRole("region", { name: "Part library" }).getByRole("button", { name: part }).click();
    for (const [name, value] of numbers) await type(name, value);
    await type("Position X", x);
    await type("Position Y", y);
    await type("Position Z", z);
  };
  await place(/^Robot stand/, "0", "0", "0", [["Height", "300"]]);
  await page.getByRole("button", { name: /^RX90L/ }).click();
  await type("Position Z", "300");
  await place(/^Roller conveyor/, "200", "-900", "0", [
    ["Length", "2000"],
    ["Height", "600"],
  ]);
  await place(/^Pallet EUR 1/, "900", "200", "0");
  await place(/^Carton/, "200", "-900", "600", [
    ["Length", "300"],
    ["Width", "200"],
    ["Height", "200"],
  ]);
  await place(/^Fence/, "0", "-1600", "0", [["Length", "4000"]]);
  await place(/^Person/, "-1500", "-2200", "0");
  const cell = await page.evaluate(() => window.twincell.stores.cellStore.getState().document!);
  expect(cell.objects.map(({ id }) => id)).toEqual([
    "robot-stand-1",
    "roller-conveyor-1",
    "pallet-1",
    "carton-1",
    "fence-1",
    "person-1",
  ]);
  expect(cell.robot.worldFromBase.position[2]).toBeCloseTo(0.3, 9);
  expect(cell.objects[1]!.belt).toMatchObject({ speed_mps: 0.25 });
  expect(cell.objects[3]!.worldFromObject.position).toEqual([0.2, -0.9, 0.6]);
  await page.evaluate(() => window.twincell.run("view.fit"));
  await page.waitForFunction(() => window.twincell.stores.cellStore.getState().saving.kind === "saved");
  await page.screenshot({ path: picture("building-palletising") });
  expect(await page.evaluate(() => window.twincellScene!.drawn().calls)).toBeLessThanOrEqual(150);

  // M-10: drawn as wire, as points, flat, and smooth again, which is what it was.
  const materials = () =>
    page.evaluate(() => {
      const kinds: string[] = [];
      window.twincellScene!.scene.getObjectByName("pallet-1")!.traverse(each => {
        const { material, isPoints } = each as unknown as {
          material?: { wireframe?: boolean; flatShading?: boolean };
          isPoints?: boolean;
        };
        if (material)
          kinds.push(isPoints ? "points" : material.wireframe ? "wire" : material.flatShading ? "flat" : "plain");
      });
      return kinds;
    });
  const choose = async (name: string): Promise<void> => {
    await page.getByRole("combobox", { name: "Drawn as" }).click();
    await page.getByRole("option", { name, exact: true }).click();
  };
  expect(await materials()).toEqual(["plain"]);
  await choose("Wire");
  await expect.poll(materials).toEqual(["wire"]);
  await page.screenshot({ path: picture("building-wire") });
  await choose("Points");
  await expect.poll(materials).toEqual(["plain", "points"]);
  await choose("Flat");
  await expect.poll(materials).toEqual(["flat"]);
  await choose("Smooth");
  await expect.poll(materials).toEqual(["plain"]);
  expect(problems).toEqual([]);
}, 180_000);

test("another robot is chosen by its picture: painted when it comes into view, and the cell gets it", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  await page.evaluate(() => {
    window.twincell.stores.viewStore.setState({ coachDone: true });
    window.twincell.run("cell.robot");
  });
  const dialog = page.getByRole("dialog", { name: "Another robot" });
  const card = dialog.locator("label.robot-card:has(input[value=yaskawa_gp8])");
  await card.locator("canvas[data-painted=yaskawa_gp8]").waitFor({ timeout: 60_000 });
  /** Share of its pixels that show something. */
  const covered = await card.locator("canvas").evaluate(each => {
    const { width, height } = each as HTMLCanvasElement;
    const { data } = (each as HTMLCanvasElement).getContext("2d")!.getImageData(0, 0, width, height);
    let shown = 0;
    for (let i = 3; i < data.length; i += 4) if (data[i]! > 127) shown++;
    return shown / (width * height);
  });
  expect(covered).toBeGreaterThan(0.05);
  // The last of the list is far below: it is not painted before it is seen.
  expect(await dialog.locator("label.robot-card").count()).toBeGreaterThan(100);
  expect(await dialog.locator("label.robot-card canvas[data-painted]").count()).toBeLessThan(30);
  await dialog.getByRole("searchbox").fill("ur10");
  await dialog.locator("label.robot-card:has(input[value=ur10e])").click();
  await dialog.locator(".robots-details canvas[data-painted=ur10e]").waitFor();
  await page.screenshot({ path: picture("building-robots") });
  await dialog.getByRole("button", { name: /^Use the .*UR10e/ }).click();
  await page.waitForFunction(() => window.twincell.stores.cellStore.getState().document?.robot.id === "ur10e");
  expect(problems).toEqual([]);
}, 120_000);

test("N-01, M-56, M-66 the six steps of a cell are told with what is done; a carried work piece has its whole path drawn, which is that of its file; a move goes as fast as the belt", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  const belt = { direction: [1, 0, 0] as Vector3, speed_mps: 0.15 };
  const cell = pickAndPlaceCell();
  const conveyor = { ...cell.objects[0]!, id: "conveyor", name: "Conveyor", belt };
  const { position } = conveyor.worldFromObject;
  await page.evaluate(
    text => window.twincell.document.open(text, "pick.json"),
    saveDocument({
      ...cell,
      objects: [
        ...cell.objects,
        {
          ...conveyor,
          worldFromObject: { ...conveyor.worldFromObject, position: [position[0], position[1] + 3, position[2]] },
        },
      ],
    }),
  );
  await page.getByRole("radio", { name: "Cell", exact: true }).click();
  const process = page.getByRole("region", { name: "Six steps to a cell" });
  expect(await process.getByRole("listitem").locator("b").allTextContents()).toEqual(
    ["Objects", "Kinematics", "Interactions", "Scenario", "Run", "Execute and correct"].map((name, i) =>
      expect.stringContaining(name + (i < 4 ? " done" : "")),
    ),
  );
  await judged(page);
  expect(await process.locator('[aria-current="step"]').innerText()).toContain("Run");
  await page.screenshot({ path: picture("building-six-steps") });
  await process.getByRole("button", { name: "Play" }).click();
  await process.getByText("5 of 6").waitFor({ timeout: 60_000 });
  expect(await process.locator('[aria-current="step"]').innerText()).toContain("Execute and correct");
  await page.evaluate(() => window.twincell.run("play.toggle"));

  const [hold] = await page.evaluate(() => window.twincell.stores.playStore.getState().carried);
  await page.evaluate(
    id => window.twincell.stores.selectionStore.setState({ selected: { kind: "object", id } }),
    hold!.id,
  );
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: "Save the path" }).click(),
  ]);
  const rows = readFileSync(await download.path(), "utf8")
    .split("\n")
    .slice(1);
  const line = await page.evaluate(() => {
    const found = window.twincellScene!.scene.getObjectByName("work piece path") as unknown as {
      geometry: { attributes: { position: { array: ArrayLike<number> } } };
    };
    return Array.from(found.geometry.attributes.position.array);
  });
  expect(line.length).toBe(3 * rows.length);
  expect(rows.length).toBeGreaterThan(100);
  rows.forEach((row, i) =>
    row
      .split(",")
      .slice(1)
      .forEach((mm, k) => expect(Number(mm) / 1000).toBeCloseTo(line[3 * i + k]!, 5)),
  );
  await page.screenshot({ path: picture("building-work-piece-path") });

  const step = await page.evaluate(() => {
    const { document } = window.twincell.stores.cellStore.getState();
    const [program] = document!.programs;
    const found = "steps" in program! ? program.steps.find(each => each.type === "move" && each.path === "lin") : null;
    window.twincell.stores.selectionStore.setState({ selected: { kind: "step", id: found!.id } });
    return found!.id;
  });
  await page.getByRole("button", { name: "As fast as Conveyor: 150 mm/s" }).click();
  const speed = await page.evaluate(id => {
    const [program] = window.twincell.stores.cellStore.getState().document!.programs;
    const found = "steps" in program! ? program.steps.find(each => each.id === id) : undefined;
    return found?.type === "move" ? found.speed : null;
  }, step);
  expect(speed).toEqual({ mps: 0.15 });
  expect(problems).toEqual([]);
}, 120_000);
