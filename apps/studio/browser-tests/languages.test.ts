import { ALL_DRIVER_KINDS } from "@twincell/controllers";
import { LIBRARY } from "@twincell/core";
import { CATALOGUE } from "@twincell/core/catalogue";
import { DIALECTS } from "@twincell/languages";
import { saveDocument, tracedCartonCell } from "@twincell/project";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import type {} from "../src/console.ts";
import { drawn, picture, Studio, type StudioPage } from "./support/studio.ts";

let studio: Studio;
beforeAll(async () => {
  studio = await Studio.start();
});
afterAll(async () => {
  await studio?.stop();
});

const MODES = ["cell", "teach", "check", "run", "history"] as const;
const DIALOGS = [
  "palette",
  "shortcuts",
  "controls",
  "export",
  "import",
  "robots",
  "cells",
  "station",
  "collision",
] as const;
const CELL = tracedCartonCell();
/** Names of things are data: they are the same in every language. */
const NAMES = [
  ...JSON.stringify(CELL).matchAll(/"(?:name|id|tool|frame)":"([^"]+)"/g),
  ...JSON.stringify([LIBRARY, CATALOGUE]).matchAll(/"(?:name|vendor|model)":"([^"]+)"/g),
  ...JSON.stringify(ALL_DRIVER_KINDS.map(({ name }) => ({ name }))).matchAll(/"name":"([^"]+)"/g),
  ...JSON.stringify(DIALECTS.map(({ name, brand }) => ({ name, brand }))).matchAll(/"(?:name|brand)":"([^"]+)"/g),
]
  .map(([, name]) => name!)
  .flatMap(name => [name, name.replace(/^\S+ /, ""), name.split(" ").at(-1)!])
  .filter(name => name.length > 1)
  .sort((a, b) => b.length - a.length);

/** Every text that a person sees or hears: text, names, hints, placeholders; not what is marked as data. */
const texts = (page: Page): Promise<readonly string[]> =>
  page.evaluate(() => {
    const found = new Set<string>();
    const isData = (element: Element): boolean => element.closest("[translate=no], .cm-editor, pre, textarea") !== null;
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_ELEMENT | NodeFilter.SHOW_TEXT);
    for (let node: Node | null = walker.nextNode(); node; node = walker.nextNode()) {
      if (node instanceof Element) {
        if (isData(node)) continue;
        for (const name of ["aria-label", "title", "placeholder", "alt", "aria-valuetext", "aria-roledescription"]) {
          const text = node.getAttribute(name);
          if (text) found.add(`${name} of ${node.tagName.toLowerCase()}: ${text}`);
        }
        continue;
      }
      const parent = node.parentElement;
      if (!parent || isData(parent) || ["SCRIPT", "STYLE"].includes(parent.tagName) || !parent.checkVisibility())
        continue;
      const text = (node.textContent ?? "").trim();
      if (text) found.add(`${parent.tagName.toLowerCase()}.${parent.className}: ${text}`);
    }
    return [...found];
  });

/** Labels of controls whose text stands out of the control, out of the page, or is cut off without a sign of it. */
const clipped = (page: Page): Promise<readonly string[]> =>
  page.evaluate(() => {
    const found = new Set<string>();
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    for (let node: Node | null = walker.nextNode(); node; node = walker.nextNode()) {
      const parent = node.parentElement;
      if (!parent?.checkVisibility() || !(node.textContent ?? "").trim()) continue;
      if (parent.closest(".visually-hidden, .cm-editor, .skip, canvas") !== null) continue;
      const box = parent.closest("button, [role=button], [role=tab], [role=radio], .seg, .chip, .btn");
      if (!box) continue;
      // An ellipsis is a sign.
      let isEllipsed = false;
      for (let up: Element | null = parent; up && box.contains(up); up = up.parentElement)
        if (getComputedStyle(up).textOverflow === "ellipsis") isEllipsed = true;
      if (isEllipsed) continue;
      const range = document.createRange();
      range.selectNodeContents(node);
      const text = range.getBoundingClientRect();
      const around = box.getBoundingClientRect();
      if (text.width === 0 || around.width === 0) continue;
      if (text.left < around.left - 1 || text.right > around.right + 1)
        found.add(
          `${box.className}: “${(node.textContent ?? "").trim()}” is ${Math.round(text.width)} px wide in ${Math.round(around.width)}`,
        );
    }
    return [...found];
  });

/** What is left of a text when marked parts, names, units and numbers are taken out. */
function bare(text: string): string {
  let left = text.slice(text.indexOf(": ") + 2).replace(/⟦[^⟧]*⟧/g, " ");
  for (const name of NAMES) left = left.replaceAll(name, " ");
  return left.replace(/[\w-]+\.(txt|v2|pg|json)\b|\b(mm|kg|ms|Hz|kB|MB|GB|min|cm|rad|deg|English|Deutsch)\b/g, " ");
}

async function settle(page: Page): Promise<void> {
  await page.evaluate(
    () =>
      new Promise<void>(done => {
        requestAnimationFrame(() => requestAnimationFrame(() => done()));
      }),
  );
  await page.evaluate(() => Promise.allSettled(document.getAnimations().map(each => each.finished)));
}

/** Goes through the five modes and the main dialogs, and looks at each. */
async function walk({ page }: StudioPage, name: string, look: (where: string) => Promise<void>): Promise<void> {
  await drawn(page);
  await page.evaluate(text => window.twincell.document.open(text, "cell"), saveDocument(CELL));
  for (const mode of MODES) {
    await page.evaluate(wanted => window.twincell.run(`view.${wanted}`), mode);
    await settle(page);
    await look(mode);
    await page.screenshot({ path: picture(`${name}-${mode}`) });
  }
  await page.evaluate(() => window.twincell.run("view.teach"));
  for (const dialog of DIALOGS) {
    await page.evaluate(wanted => window.twincell.stores.dialogStore.setState({ open: wanted }), dialog);
    await page.locator("[role=dialog]").first().waitFor();
    await settle(page);
    await look(dialog);
    await page.screenshot({ path: picture(`${name}-${dialog}`) });
    await page.evaluate(() => window.twincell.stores.dialogStore.setState({ open: null }));
  }
}

describe("the studio in another language", () => {
  test("in the pseudo-language every text of the five modes and the main dialogs comes from a catalogue and has room", async () => {
    const opened = await studio.open({ query: "?lang=en-XA" });
    const outside = new Set<string>();
    const cut = new Set<string>();
    await walk(opened, "pseudo", async where => {
      for (const text of await texts(opened.page)) if (/\p{L}{2,}/u.test(bare(text))) outside.add(`${where}, ${text}`);
      for (const label of await clipped(opened.page)) cut.add(`${where}, ${label}`);
    });
    expect(await opened.page.evaluate(() => document.documentElement.lang)).toBe("en-XA");
    expect([[...outside], [...cut], opened.problems]).toEqual([[], [], []]);
  }, 600_000);

  test("German is spoken when the browser prefers it, labels have room, numbers have a comma and a typed comma is taken", async () => {
    const opened = await studio.open({ locale: "de-AT" });
    const { page } = opened;
    const cut = new Set<string>();
    await walk(opened, "german", async where => {
      for (const label of await clipped(page)) cut.add(`${where}, ${label}`);
    });
    expect(await page.evaluate(() => document.documentElement.lang)).toBe("de");
    expect([[...cut], opened.problems]).toEqual([[], []]);
    await page.evaluate(() => {
      window.twincell.run("view.cell");
      window.twincell.stores.selectionStore.setState({ selected: { kind: "object", id: "carton" } });
    });
    const field = page.getByRole("textbox", { name: /^entlang x/ });
    expect(await field.inputValue()).toMatch(/^\d+,\d\d$/);
    await field.fill("312,5");
    await field.press("Enter");
    expect(await field.inputValue()).toBe("312,50");
    const size_m = await page.evaluate(
      () => window.twincell.stores.cellStore.getState().document?.objects.find(({ id }) => id === "carton")?.shape,
    );
    expect(size_m).toMatchObject({ kind: "box", size_m: [0.3125, expect.any(Number), expect.any(Number)] });
  }, 600_000);
});
