import { saveDocument, tracedCartonCell } from "@twincell/project";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import type {} from "../src/console.ts";
import type { StudioMode } from "../src/stores/view.ts";
import { picture, Studio, type OpenOptions } from "./support/studio.ts";

const TRACED = saveDocument(tracedCartonCell());
const MODES: readonly StudioMode[] = ["cell", "teach", "check", "run", "history"];
const THEMES = ["dark", "light"] as const;
const SIZES: readonly (OpenOptions & {
  readonly name: string;
  readonly width: number;
  readonly height: number;
  readonly dialogs?: boolean;
})[] = [
  { name: "1280x800", width: 1280, height: 800, dialogs: true },
  { name: "1920x1080", width: 1920, height: 1080 },
  { name: "1024x768", width: 1024, height: 768 },
  { name: "390x844", width: 390, height: 844, touch: true, dialogs: true },
  { name: "844x390", width: 844, height: 390, touch: true, dialogs: true },
  { name: "820x1180", width: 820, height: 1180, touch: true },
];
/** What floats over the view, each at a place of its own. */
const FLOATING = [
  ".view-cube",
  ".view-fit",
  ".hint",
  ".readout",
  ".readout-frame",
  ".picture",
  ".trace-toggle",
  ".build-bar",
  ".coach",
  ".notice",
  ".topbar > *",
];
/** Shown whole or not at all. */
const WHOLE = ".topbar *, .hint, .hint *, .sheet-tabs *, .btn, .seg-item, .readout dd";
/** For a thumb. */
const TARGETS =
  "button, input:not([hidden]), select, textarea, summary, a[href], [role=slider], [role=tab], [role=menuitem]";
const LEAST_TARGET_PX = 44;

let studio: Studio;
beforeAll(async () => {
  studio = await Studio.start();
});
afterAll(async () => {
  await studio?.stop();
});

/** Waits until so many frames are drawn and what moves has come to rest. */
async function frames(page: Page, count: number): Promise<void> {
  await page.evaluate(
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
  await page.evaluate(() =>
    Promise.allSettled(
      document
        .getAnimations()
        .filter(each => each.effect?.getComputedTiming().iterations !== Infinity)
        .map(each => each.finished),
    ),
  );
}

describe.each(SIZES)("the studio at $name", size => {
  let page: Page;
  let problems: string[];
  beforeAll(async () => {
    ({ page, problems } = await studio.open(size));
    await page.waitForFunction(
      () => window.twincell?.stores.cellStore.getState().document !== null && (window.twincellScene?.frames ?? 0) > 0,
    );
    await page.evaluate(text => window.twincell.document.open(text, "traced-carton.json"), TRACED);
    await page.waitForFunction(() => window.twincell.stores.playStore.getState().verdict !== null);
    await page.evaluate(() => {
      const { noticeStore } = window.twincell.stores;
      noticeStore.setState({ notices: [] });
    });
  });
  afterAll(async () => {
    await page?.context().close();
  });

  test.each(MODES)("looks as it should in %s", async mode => {
    await page.evaluate(to => {
      window.twincell.run(`view.${to}`);
      window.twincell.stores.viewStore.setState({ sheet: to === "check" ? "why" : to === "teach" ? "jog" : "run" });
    }, mode);
    for (const theme of THEMES) {
      await page.evaluate(wanted => {
        window.twincell.stores.viewStore.setState({ theme: wanted });
      }, theme);
      await frames(page, 4);
      await page.screenshot({ path: picture(`${size.name}-${mode}-${theme}`) });
    }
    await page.evaluate(() =>
      window.twincell.stores.noticeStore.setState({
        notices: [
          {
            id: -1,
            tone: "bad",
            sentence: "A sentence of the usual length, which says what is and what to do.",
            hint: "And the way out of it.",
          },
        ],
      }),
    );
    await frames(page, 2);
    expect(await overlapping(page)).toEqual([]);
    await page.evaluate(() => window.twincell.stores.noticeStore.setState({ notices: [] }));
    expect(await overflowing(page)).toEqual([]);
    expect(await overlapping(page)).toEqual([]);
    expect(await truncated(page)).toEqual([]);
    expect(await stopIsOnTop(page)).toBe(true);
    if (size.touch) expect(await smallTargets(page)).toEqual([]);
    expect(problems).toEqual([]);
  });

  test.runIf(size.dialogs)("STOP works while a dialog is open", async () => {
    for (const dialog of ["palette", "shortcuts", "controls", "export", "import", "robots", "station"] as const) {
      await page.evaluate(name => window.twincell.stores.dialogStore.setState({ open: name }), dialog);
      await page.getByRole("dialog").waitFor();
      await frames(page, 3);
      await page.screenshot({ path: picture(`${size.name}-${dialog}`) });
      expect(await stopIsOnTop(page), dialog).toBe(true);
      expect(await overflowing(page), dialog).toEqual([]);
      expect(await truncated(page), dialog).toEqual([]);
      if (size.touch) expect(await smallTargets(page), dialog).toEqual([]);
      await page.evaluate(() => window.twincell.stores.noticeStore.setState({ notices: [] }));
      const { x, y, width, height } = (await page.locator("button.stop").boundingBox())!;
      await page.mouse.click(x + width / 2, y + height / 2);
      await page.waitForFunction(() =>
        window.twincell.stores.noticeStore
          .getState()
          .notices.some(notice => notice.sentence === "Everything was stopped."),
      );
      await page.evaluate(() => window.twincell.stores.dialogStore.setState({ open: null }));
      await page.getByRole("dialog").waitFor({ state: "detached" });
    }
  });
});

/** Whatever is wider than the page, by its class. */
const overflowing = (page: Page): Promise<string[]> =>
  page.evaluate(() => {
    const found = document.documentElement.scrollWidth > innerWidth ? ["the page"] : [];
    for (const element of document.querySelectorAll("body *")) {
      const { left, right, width, height } = element.getBoundingClientRect();
      const clipped =
        element.closest(".scroll, .timeline, .visually-hidden, .slider, svg, .area-view, .code, .coach") !== null;
      if (width > 0 && height > 0 && !clipped && (right > innerWidth + 1 || left < -1))
        found.push(`${element.tagName} ${element.className}`);
    }
    return found;
  });

const overlapping = (page: Page): Promise<string[]> =>
  page.evaluate(selectors => {
    const boxes = selectors.flatMap(name =>
      [...document.querySelectorAll(name)].flatMap(element => {
        const { left, top, right, bottom } = element.getBoundingClientRect();
        return right > left && bottom > top && getComputedStyle(element).visibility !== "hidden"
          ? [{ name, element, left, top, right, bottom }]
          : [];
      }),
    );
    return boxes.flatMap((a, i) =>
      boxes
        .slice(i + 1)
        .flatMap(b =>
          !a.element.contains(b.element) &&
          !b.element.contains(a.element) &&
          a.left < b.right - 1 &&
          b.left < a.right - 1 &&
          a.top < b.bottom - 1 &&
          b.top < a.bottom - 1
            ? [`${a.name} and ${b.name}`]
            : [],
        ),
    );
  }, FLOATING);

const truncated = (page: Page): Promise<string[]> =>
  page.evaluate(
    selector =>
      [...document.querySelectorAll<HTMLElement>(selector)].flatMap(element => {
        const style = getComputedStyle(element);
        const cuts = style.overflowX !== "visible" && style.display !== "inline";
        return element.offsetWidth > 1 &&
          cuts &&
          element.scrollWidth > element.clientWidth + 1 &&
          element.closest(".visually-hidden") === null
          ? [
              `${element.className} “${element.textContent?.slice(0, 40)}” ${element.scrollWidth} > ${element.clientWidth}`,
            ]
          : [];
      }),
    WHOLE,
  );

const stopIsOnTop = (page: Page): Promise<boolean> =>
  page.evaluate(() => {
    const button = document.querySelector("button.stop");
    const box = button?.getBoundingClientRect();
    return (
      box !== undefined &&
      box.width > 0 &&
      [0.1, 0.5, 0.9].every(
        part => document.elementFromPoint(box.left + box.width * part, box.top + box.height / 2) === button,
      )
    );
  });

const smallTargets = (page: Page): Promise<string[]> =>
  page.evaluate(
    ([selector, least]) =>
      [...document.querySelectorAll<HTMLElement>(selector)].flatMap(element => {
        const { width, height, top, left } = element.getBoundingClientRect();
        const shown =
          width > 1 &&
          height > 1 &&
          element.checkVisibility({ visibilityProperty: true }) &&
          element.closest(".visually-hidden, .skip-link") === null;
        // A field and a slider take a touch anywhere; the faces of the cube are a shortcut for two fingers.
        const whole = element.closest(".field, .slider, .track, label")?.getBoundingClientRect() ?? { width, height };
        if (!shown || element.closest(".view-cube-body") || Math.min(whole.width, whole.height) >= least - 0.5)
          return [];
        return Math.min(width, height) < least - 0.5
          ? [
              `${element.className || element.tagName} “${(element.getAttribute("aria-label") ?? element.textContent ?? "").slice(0, 30)}” ${width.toFixed(0)} × ${height.toFixed(0)} at ${left.toFixed(0)}, ${top.toFixed(0)}`,
            ]
          : [];
      }),
    [TARGETS, LEAST_TARGET_PX] as const,
  );
