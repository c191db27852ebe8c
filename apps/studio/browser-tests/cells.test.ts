import { openDocument } from "@twincell/project";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { drawn, picture, Studio } from "./support/studio.ts";

let studio: Studio;
beforeAll(async () => {
  studio = await Studio.start();
});
afterAll(async () => {
  await studio?.stop();
});

const nameOf = (page: Page): Promise<string> =>
  page.evaluate(() => window.twincell.stores.cellStore.getState().document?.name ?? "");
const saved = async (page: Page): Promise<void> => {
  await page.waitForFunction(() => window.twincell.stores.cellStore.getState().saving.kind === "saved");
};
const rename = async (page: Page, name: string): Promise<void> => {
  const field = page.getByRole("textbox", { name: "Name of the cell" });
  await field.fill(name);
  await field.press("Enter");
  await page.waitForFunction(wanted => window.twincell.stores.cellStore.getState().document?.name === wanted, name);
};
const menu = async (page: Page, item: string): Promise<void> => {
  await page.getByRole("button", { name: "Twincell: Cell menu" }).click();
  await page.getByRole("menuitem", { name: item }).click();
};
const card = (page: Page, name: string) => page.locator(".start-card").filter({ hasText: name });

test("M-18 by clicks alone: a new cell keeps the one before, which is found by name and by properties of its models, opened, put into the trash and back, with its picture", async () => {
  const { page, context, problems } = await studio.open({ width: 1280, height: 720 });
  await drawn(page);
  await rename(page, "Bracket weld");
  await menu(page, "New empty cell");
  await page.waitForFunction(() => window.twincell.stores.cellStore.getState().document?.name === "New cell");
  await rename(page, "Assembly bench");
  await menu(page, "All cells");
  await card(page, "Assembly bench").waitFor();
  await card(page, "Bracket weld").waitFor();
  expect(await card(page, "Bracket weld").locator("img").getAttribute("src")).toMatch(/^data:image\/webp/);
  expect(await card(page, "Assembly bench").textContent()).toContain("Open now");
  await page.screenshot({ path: picture("cells-1280x720") });

  const search = page.getByRole("searchbox", { name: "Search cells, robots, programs and points" });
  await search.fill("carton");
  expect(await page.locator(".start-card").count()).toBe(1);
  expect(await card(page, "Bracket weld").textContent()).toContain("in: Carton");
  // M-18: geometry and physical properties are asked for as well.
  await search.fill("carton length > 250 height < 300");
  await card(page, "Bracket weld").getByText("in: Carton").waitFor();
  expect(await page.locator(".start-card").count()).toBe(1);
  await search.fill("carton length > 900");
  await page.getByText("Nothing is called “carton length > 900”.").waitFor();
  await search.fill("no such thing");
  await page.getByText("Nothing is called “no such thing”.").waitFor();
  await page.getByRole("button", { name: "Clear search" }).click();

  await page.getByRole("button", { name: "Duplicate Bracket weld" }).click();
  await card(page, "Bracket weld copy").waitFor();
  await page.getByRole("button", { name: "Move Bracket weld copy to the trash" }).click();
  await page.getByText("“Bracket weld copy” is in the trash.").waitFor();
  expect(await card(page, "Bracket weld copy").count()).toBe(0);
  await page.getByRole("button", { name: "Put back" }).click();
  await card(page, "Bracket weld copy").waitFor();

  await page.getByRole("button", { name: "Open Bracket weld", exact: true }).click();
  await page.waitForFunction(() => window.twincell.stores.cellStore.getState().document?.name === "Bracket weld");
  await saved(page);
  await page.reload();
  await drawn(page);
  expect(await nameOf(page)).toBe("Bracket weld");
  expect(problems).toEqual([]);
  await context.close();
});

test("an object is renamed, duplicated, hidden and locked from the tree", async () => {
  const { page, context, problems } = await studio.open({ width: 920, height: 420 });
  await drawn(page);
  const object = (name: string) =>
    page.evaluate(
      wanted => window.twincell.stores.cellStore.getState().document?.objects.find(each => each.name === wanted),
      name,
    );
  const row = (name: string) => page.locator(".cell-tree .row").filter({ has: page.getByText(name, { exact: true }) });
  await row("Carton").focus();
  await page.keyboard.press("F2");
  await page.getByLabel("Name of the object").fill("Large carton");
  await page.keyboard.press("Enter");
  await row("Large carton").click({ button: "right" });
  await page.getByRole("menuitem", { name: "Duplicate" }).click();
  await row("Large carton 2").click({ button: "right" });
  await page.getByRole("menuitem", { name: "Hide" }).click();
  await row("Large carton 2").click({ button: "right" });
  await page.getByRole("menuitem", { name: "Lock in the 3D view" }).click();
  expect(await object("Large carton 2")).toMatchObject({ hidden: true, locked: true });
  expect(await object("Large carton")).not.toHaveProperty("hidden");
  expect(await row("Large carton 2").textContent()).toContain("hidden");
  expect(problems).toEqual([]);
  await context.close();
});

test("on a phone the cells stand one below the other and nothing is cut off", async () => {
  const { page, context } = await studio.open({ width: 390, height: 844, touch: true });
  await drawn(page);
  await menu(page, "All cells");
  await page.getByRole("searchbox").waitFor();
  await page.screenshot({ path: picture("cells-390x844") });
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
  await context.close();
});

test("60 random actions with reloads in between lose no cell that was said to be saved", async () => {
  const { page, context } = await studio.open({ width: 920, height: 420 });
  await drawn(page);
  let state = 14;
  const random = (): number => (state = (state * 48_271) % 2_147_483_647) / 2_147_483_647;
  const promised = new Set<string>();
  for (let i = 0; i < 60; i++) {
    const at = random();
    if (at < 0.45) {
      await rename(page, `Cell ${i}`);
      await saved(page);
      promised.add(`Cell ${i}`);
      // The next one is another cell: each name is of one cell only.
      await menu(page, random() < 0.5 ? "New empty cell" : "Open the edge-trace example");
    } else if (at < 0.6) await menu(page, "New empty cell");
    else if (at < 0.75) await menu(page, "Open the edge-trace example");
    else if (at < 0.85) {
      await page.reload();
      await drawn(page);
    } else await page.keyboard.press("Control+z");
  }
  await page.reload();
  await drawn(page);
  const kept = await page.evaluate(
    () =>
      new Promise<string[]>((done, lost) => {
        const opening = indexedDB.open("keyval-store");
        opening.onerror = () => lost(opening.error ?? new Error("no database"));
        opening.onsuccess = () => {
          const all = opening.result.transaction("keyval").objectStore("keyval");
          const range = IDBKeyRange.bound("twincell.library.cell.", "twincell.library.cell.~");
          const reading = all.getAll(range);
          reading.onsuccess = () => done(reading.result.map(String));
        };
      }),
  );
  const names = kept.map(text => {
    const opened = openDocument(text);
    return opened.kind === "opened" ? opened.document.name : opened.kind;
  });
  expect(promised.size).toBeGreaterThan(10);
  for (const name of promised) expect(names).toContain(name);
  await context.close();
});
