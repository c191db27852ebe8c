import { saveDocument, tracedCartonCell } from "@twincell/project";
import type { AxeResults } from "axe-core";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import type {} from "../src/console.ts";
import type { StudioMode } from "../src/stores/view.ts";
import { Studio, type StudioPage } from "./support/studio.ts";

const AXE = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const TRACED = saveDocument(tracedCartonCell());
const MODES: readonly StudioMode[] = ["teach", "check", "run", "history"];
const DIALOGS = ["palette", "shortcuts", "controls", "export", "import", "robots"] as const;
/** The picture costs most where the processor draws it. */
const SMALL = { width: 1000, height: 600 };
declare global {
  interface Window {
    axe: { run(root: Document, options: object): Promise<AxeResults> };
  }
}

let studio: Studio;
beforeAll(async () => {
  studio = await Studio.start();
});
afterAll(async () => {
  await studio?.stop();
});

async function ready(page: Page): Promise<void> {
  await page.waitForFunction(
    () =>
      window.twincell !== undefined &&
      window.twincell.stores.cellStore.getState().document !== null &&
      (window.twincellScene?.frames ?? 0) > 0,
  );
}
const frames = (page: Page, count: number): Promise<void> =>
  page.evaluate(
    left =>
      new Promise<void>(done => {
        const next = (): void => {
          if (left-- <= 0) done();
          else requestAnimationFrame(next);
        };
        next();
      }),
    count,
  );
/** Serious and critical findings, each with the places it is found at. Colours are judged at rest. */
async function findings(page: Page): Promise<readonly string[]> {
  await frames(page, 2);
  await page.evaluate(() => Promise.allSettled(document.getAnimations().map(each => each.finished)));
  const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
  return violations
    .filter(({ impact }) => impact === "serious" || impact === "critical")
    .map(
      ({ id, help, nodes }) =>
        `${id}: ${help} ${nodes
          .slice(0, 6)
          .map(node => `${node.target.join(" ")} ${node.any[0]?.message ?? ""}`)
          .join(" | ")}`,
    );
}

describe.each([{ theme: "dark" }, { theme: "light" }] as const)("axe finds nothing serious, $theme", ({ theme }) => {
  let open: StudioPage;
  beforeAll(async () => {
    open = await studio.open({ ...SMALL, theme, script: AXE });
    await ready(open.page);
    await open.page.evaluate(text => window.twincell.document.open(text, "traced-carton.json"), TRACED);
    await open.page.waitForFunction(() => window.twincell.stores.playStore.getState().verdict !== null);
  });
  afterAll(async () => {
    await open?.context.close();
  });

  test.each(MODES)("in %s", async mode => {
    await open.page.evaluate(to => window.twincell.run(`view.${to}`), mode);
    expect(await findings(open.page)).toEqual([]);
  });
  test("in Teach while tracing, with a step selected", async () => {
    await open.page.evaluate(() => {
      window.twincell.run("view.teach");
      window.twincell.run("trace.toggle");
      window.twincell.stores.selectionStore.setState({ selected: { kind: "step", id: "s1" } });
    });
    expect(await findings(open.page)).toEqual([]);
    await open.page.evaluate(() => window.twincell.run("trace.toggle"));
  });
  test.each(DIALOGS)("in the dialog %s", async dialog => {
    await open.page.evaluate(name => window.twincell.stores.dialogStore.setState({ open: name }), dialog);
    await open.page.getByRole("dialog").waitFor();
    expect(await findings(open.page)).toEqual([]);
    await open.page.keyboard.press("Escape");
    await open.page.getByRole("dialog").waitFor({ state: "detached" });
  });
  test("on a phone", async () => {
    await open.page.setViewportSize({ width: 390, height: 844 });
    await open.page.locator(".area-sheet").waitFor();
    expect(await findings(open.page)).toEqual([]);
  });
});

describe("by keyboard alone", () => {
  test("the main job: trace tool, jog, record, check, play, export, run and look back", async () => {
    const { page, problems } = await studio.open(SMALL);
    await ready(page);
    const command = async (name: string): Promise<void> => {
      await page.keyboard.press("Control+k");
      await page.getByRole("dialog").waitFor();
      await page.keyboard.type(name);
      await page.keyboard.press("Enter");
      await page.getByRole("dialog").waitFor({ state: "detached" });
    };
    const jog = async (key: string): Promise<void> => {
      const before = await page.evaluate(() => window.twincell.live.now().revision);
      await page.keyboard.down(key);
      await page.waitForFunction(from => window.twincell.live.now().revision > from + 4, before);
      await page.keyboard.up(key);
    };
    const steps = (): Promise<number> =>
      page.evaluate(
        () =>
          window.twincell.stores.cellStore
            .getState()
            .document!.programs.filter(program => program.format === "twincell.program")[0]!.steps.length,
      );

    await page.keyboard.press("t");
    await page.getByRole("region", { name: "Trace edges" }).waitFor();
    await page.keyboard.press("t");
    await page.getByRole("region", { name: "Trace edges" }).waitFor({ state: "detached" });
    await command("Jog in Joint");
    expect(await page.evaluate(() => window.twincell.stores.jogStore.getState().frame)).toBe("joint");
    await jog("w");
    await jog("l");
    await page.keyboard.press("p");
    await jog("d");
    await page.keyboard.press("Shift+P");
    expect(await steps()).toBe(2);
    await page.keyboard.press("Control+z");
    expect(await steps()).toBe(1);
    await page.keyboard.press("Control+Shift+Z");
    expect(await steps()).toBe(2);

    await page.keyboard.press("3");
    await page.waitForFunction(
      () =>
        window.twincell.stores.playStore.getState().verdict?.steps.length === 2 &&
        window.twincell.stores.playStore.getState().checking === null,
    );
    await page.keyboard.press("Space");
    await page.waitForFunction(
      () => window.twincell.stores.playStore.getState().playing || window.twincell.stores.playStore.getState().t_s > 0,
    );
    await page.keyboard.press("Control+e");
    await page.getByRole("region", { name: /edge_trace/ }).waitFor();
    expect(await page.evaluate(() => document.activeElement?.closest("[role=dialog]") !== null)).toBe(true);
    await page.keyboard.press("Escape");
    await page.getByRole("dialog").waitFor({ state: "detached" });
    // Two points by hand over a stretched elbow: the check is red, and asks; the answer is given by keys too.
    await page.keyboard.press("Control+k");
    await page.keyboard.type("Run on the virtual controller");
    await page.keyboard.press("Enter");
    const question = page.getByRole("dialog", { name: "The check is red" });
    await question.waitFor();
    const anyway = question.getByRole("button", { name: "Run all the same" });
    for (let n = 0; n < 8 && !(await anyway.evaluate(button => button === document.activeElement)); n++)
      await page.keyboard.press("Tab");
    await page.keyboard.press("Enter");
    await question.waitFor({ state: "detached" });
    await page.waitForFunction(
      () =>
        window.twincell.stores.historyStore.getState().runs.length === 1 &&
        !window.twincell.stores.controlStore.getState().running,
    );
    await page.keyboard.press("5");
    expect(await page.evaluate(() => window.twincell.stores.viewStore.getState().mode)).toBe("history");
    await page.keyboard.press("Pause");
    await page.waitForFunction(() =>
      window.twincell.stores.noticeStore
        .getState()
        .notices.some(notice => notice.sentence === "Everything was stopped."),
    );
    expect(problems).toEqual([]);
    await page.context().close();
  });

  test("whatever has the focus shows it, and Tab comes round to everything on the page", async () => {
    const { page } = await studio.open(SMALL);
    await ready(page);
    const seen = new Set<string>();
    const unseen: string[] = [];
    for (let i = 0; i < 90; i++) {
      await page.keyboard.press("Tab");
      const stop = await page.evaluate(() => {
        const element = document.activeElement;
        if (!(element instanceof HTMLElement) || element === document.body) return null;
        const look = (): string =>
          [element, element.parentElement, element.parentElement?.parentElement]
            .map(each => {
              if (!each) return "";
              const { outlineStyle, outlineWidth, outlineColor, borderColor, boxShadow, backgroundColor } =
                getComputedStyle(each);
              return outlineStyle === "none"
                ? [borderColor, boxShadow, backgroundColor].join()
                : [outlineStyle, outlineWidth, outlineColor].join();
            })
            .join(" / ");
        for (const each of element.ownerDocument.getAnimations()) each.finish();
        const focused = look();
        element.blur();
        for (const each of element.ownerDocument.getAnimations()) each.finish();
        const plain = look();
        element.focus();
        return {
          name: (element.getAttribute("aria-label") ?? element.textContent ?? "").trim().slice(0, 40),
          shows: focused !== plain,
        };
      });
      if (stop === null) continue;
      if (!stop.shows) unseen.push(stop.name);
      seen.add(stop.name);
    }
    expect(unseen).toEqual([]);
    for (const name of [
      "Skip to the program",
      "Twincell: Cell menu",
      "Name of the cell",
      "STOP",
      "Export V+",
      "Jog X up",
    ])
      expect([...seen]).toContain(name);
    await page.context().close();
  });
});

test("who asked for less motion gets none: dialogs appear at once, and the camera does not fly", async () => {
  const { page } = await studio.open(SMALL);
  await page.emulateMedia({ reducedMotion: "reduce" });
  await ready(page);
  await page.keyboard.press("Control+k");
  await page.getByRole("dialog").waitFor();
  expect(
    await page.evaluate(
      () => document.getAnimations().filter(each => Number(each.effect?.getComputedTiming().duration ?? 0) > 0).length,
    ),
  ).toBe(0);
  await page.keyboard.press("Escape");
  const camera = (): Promise<readonly number[]> => page.evaluate(() => window.twincellScene!.camera.position.toArray());
  const before = await camera();
  await page.getByRole("button", { name: "View from top" }).dispatchEvent("click");
  await frames(page, 3);
  const at = await camera();
  expect(at).not.toEqual(before);
  await frames(page, 5);
  expect(await camera()).toEqual(at);
  await page.context().close();
});
