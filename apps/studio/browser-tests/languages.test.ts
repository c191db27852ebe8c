import type { Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import type {} from "../src/console.ts";
import { drawn, picture, Studio } from "./support/studio.ts";

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
  "collision",
  "cameras",
] as const;

/** Every text that a person sees or hears and that is not marked as data: text, names, hints, placeholders. */
const texts = (page: Page): Promise<readonly string[]> =>
  page.evaluate(() => {
    const found = new Set<string>();
    const isData = (element: Element | null): boolean => element?.closest("[translate=no]") !== null;
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_ELEMENT | NodeFilter.SHOW_TEXT);
    for (let node: Node | null = walker.nextNode(); node; node = walker.nextNode()) {
      if (node instanceof Element) {
        if (isData(node)) continue;
        for (const name of ["aria-label", "title", "placeholder", "alt", "aria-valuetext", "aria-roledescription"]) {
          const text = node.getAttribute(name);
          if (text) found.add(`${name}: ${text}`);
        }
        continue;
      }
      const parent = node.parentElement;
      if (!parent || isData(parent) || ["SCRIPT", "STYLE"].includes(parent.tagName)) continue;
      if (!parent.checkVisibility()) continue;
      const text = (node.textContent ?? "").trim();
      if (text) found.add(`${parent.tagName.toLowerCase()}.${parent.className}: ${text}`);
    }
    return [...found];
  });

/** What is left of a text when the marked parts, numbers and units are taken out. */
const bare = (text: string): string =>
  text
    .replace(/^[^:]*: /, "")
    .replace(/⟦[^⟧]*⟧/g, " ")
    .replace(/\b(mm|kg|s|ms|Hz|kB|MB|GB|min|h|cm|m|in|rad|J\d|R?[xyz]|R?[XYZ])\b/g, " ");

test("in the pseudo-language every visible text of the five modes and the main dialogs comes from a catalogue", async () => {
  const { page, problems } = await studio.open({ query: "?lang=en-XA" });
  await drawn(page);
  expect(await page.evaluate(() => document.documentElement.lang)).toBe("en-XA");
  const unmarked = new Map<string, string>();
  const look = async (where: string): Promise<void> => {
    for (const text of await texts(page)) if (/\p{L}{2,}/u.test(bare(text))) unmarked.set(text, where);
  };
  for (const mode of MODES) {
    await page.evaluate(wanted => window.twincell.stores.viewStore.setState({ mode: wanted }), mode);
    await page.waitForTimeout(500);
    await look(mode);
    await page.screenshot({ path: picture(`pseudo-${mode}`) });
  }
  for (const dialog of DIALOGS) {
    await page.evaluate(wanted => window.twincell.stores.dialogStore.setState({ open: wanted }), dialog);
    await page.waitForTimeout(800);
    await look(dialog);
    await page.screenshot({ path: picture(`pseudo-${dialog}`) });
  }
  console.log([...unmarked].map(([text, where]) => `${where} | ${text}`).join("\n"));
  expect(problems).toEqual([]);
}, 240_000);
