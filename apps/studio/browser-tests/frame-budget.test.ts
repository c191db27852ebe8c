import { saveDocument, tracedCartonCell } from "@twincell/project";
import type { Vector3 } from "@twincell/core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { cpuDuring } from "./support/cpu.ts";
import { ledger, quantile } from "./support/ledger.ts";
import { drawn, type Page, picture, Studio } from "./support/studio.ts";

/** bench/frame.ts measures; this holds the line. Processor time: other processes do not count. */
const P95_MS = 3;
const WORST_MS = 25;
const LONG_MS = 50;
const ROUNDS = 8;

let studio: Studio;
let page: Page;
let problems: readonly string[];
beforeAll(async () => {
  studio = await Studio.start();
  ({ page, problems } = await studio.open({ script: ledger("paced") }));
  await drawn(page);
  await page.evaluate(text => {
    window.twincell.document.open(text, "example");
  }, saveDocument(tracedCartonCell()));
  await judged();
});
afterAll(async () => {
  await studio.stop();
});

const judged = () =>
  page.waitForFunction(
    name => {
      const { cellStore, playStore } = window.twincell.stores;
      const { verdict, checking } = playStore.getState();
      return cellStore.getState().document?.name === name && verdict !== null && checking === null;
    },
    tracedCartonCell().name,
    { timeout: 60_000, polling: 100 },
  );

/** The least busy of some rounds: what our script costs it costs in every round. */
async function rounds(): Promise<{ readonly p95_ms: number; readonly worst_ms: number; readonly frames: number }> {
  const all: (readonly number[])[] = [];
  for (let i = 0; i < ROUNDS; i++) all.push((await cpuDuring(page, () => page.waitForTimeout(2000))).script_ms);
  const least = (part: number): number => Math.min(...all.map(script_ms => quantile(script_ms, part)));
  return { p95_ms: least(0.95), worst_ms: least(1), frames: all.flat().length };
}

/** A budget is held at the first try or not at all. */
const ONCE = { retry: 0 } as const;

test("script per frame stays within 3 ms while the program plays and collisions are looked at", ONCE, async () => {
  await page.evaluate(() => {
    window.twincell.seek(0);
    window.twincell.run("play.toggle");
  });
  await page.waitForTimeout(3000);
  const before = await page.evaluate(() => window.twincell.live.now().revision);
  const { p95_ms, worst_ms, frames } = await rounds();
  expect(await page.evaluate(() => window.twincell.live.now().revision)).toBeGreaterThan(before + 20);
  expect(await page.evaluate(() => window.twincell.stores.watchStore.getState().took_ms)).toBeGreaterThan(0);
  expect(frames).toBeGreaterThan(40);
  expect(p95_ms).toBeLessThanOrEqual(P95_MS);
  expect(worst_ms).toBeLessThanOrEqual(WORST_MS);
  await page.evaluate(() => {
    window.twincell.run("play.toggle");
  });
});

test(
  "script per frame stays within 3 ms while the exported text runs on the twin and is recorded; no sample is lost",
  ONCE,
  async () => {
    await page.evaluate(() => {
      window.twincell.seek(0);
      window.twincell.run("run.start");
    });
    await page.waitForFunction(() => window.twincell.stores.controlStore.getState().running, null, { polling: 50 });
    await page.waitForTimeout(3000);
    const { p95_ms, worst_ms } = await rounds();
    expect(p95_ms).toBeLessThanOrEqual(P95_MS);
    expect(worst_ms).toBeLessThanOrEqual(WORST_MS);
    const { samples, lost, ages_ms } = await page.evaluate(() => {
      const { samples: count, lost: missing, ages_ms: ages } = window.twincell.live.link;
      return { samples: count, lost: missing, ages_ms: ages };
    });
    expect(samples).toBeGreaterThan(1000);
    expect(lost).toBe(0);
    expect(quantile(ages_ms, 0.5)).toBeLessThan(10);
    await page.evaluate(() => {
      window.twincell.run("stop");
    });
    await page.waitForFunction(() => !window.twincell.stores.controlStore.getState().running, null, { polling: 50 });
    await page.waitForFunction(
      () => window.twincell.stores.historyStore.getState().runs.some(run => run.ending !== "running"),
      null,
      { polling: 50 },
    );
  },
);

/** Tasks with more than 50 ms of our script [ms]; the least of five: what our script does it does every time. */
async function long(act: () => Promise<unknown>, undo: () => Promise<unknown>): Promise<readonly number[]> {
  let least: readonly number[] = [];
  for (let i = 0; i < 5; i++) {
    const { tasks_ms } = await cpuDuring(page, async () => {
      await act();
      await page.waitForTimeout(200);
    });
    const ours = tasks_ms.filter(ms => ms > LONG_MS);
    if (i === 0 || ours.length < least.length) least = ours;
    if (least.length === 0) break;
    await undo();
  }
  return least;
}

test("checking happens away from the page", ONCE, async () => {
  await page.evaluate(() => {
    window.twincell.stores.viewStore.setState({ mode: "check" });
  });
  const check = async (): Promise<void> => {
    await page.evaluate(() => {
      window.twincell.run("check.now");
    });
    await judged();
  };
  expect(
    await long(check, async () => {
      /* The next check begins anew by itself. */
    }),
  ).toEqual([]);
});

test("exporting happens away from the page", ONCE, async () => {
  const exporting = async (): Promise<void> => {
    await page.evaluate(() => {
      window.twincell.run("export.open");
    });
    await page.waitForFunction(() => window.twincell.stores.postStore.getState().emitted !== null, null, {
      polling: 50,
      timeout: 30_000,
    });
  };
  const close = () => page.keyboard.press("Escape");
  expect(await long(exporting, close)).toEqual([]);
  await close();
});

test("opening a recording happens away from the page", ONCE, async () => {
  await page.evaluate(() => {
    window.twincell.stores.viewStore.setState({ mode: "history" });
  });
  const { runs } = await page.evaluate(() => window.twincell.stores.historyStore.getState());
  const open = async (): Promise<void> => {
    await page.locator(".history-open").first().click();
    await page.waitForFunction(
      () => {
        const { open: id, opening, duration_s } = window.twincell.stores.historyStore.getState();
        return id !== null && !opening && duration_s > 0;
      },
      null,
      { polling: 50, timeout: 30_000 },
    );
  };
  expect(runs.length).toBeGreaterThan(0);
  const reader = page.waitForEvent("worker", worker => worker.url().includes("recording.worker"));
  expect(
    await long(open, async () => {
      /* The run is opened once more. */
    }),
  ).toEqual([]);
  await reader;
});

test("making points from edges happens away from the page", ONCE, async () => {
  await page.evaluate(() => {
    window.twincell.stores.viewStore.setState({ mode: "teach" });
    window.twincell.seek(0);
    window.twincell.run("trace.toggle");
  });
  const carton = tracedCartonCell().objects.find(object => object.id === "carton")!;
  const size_m = carton.shape.kind === "box" ? carton.shape.size_m : [0, 0, 0];
  const [x, y, z] = carton.worldFromObject.position;
  // On the near top edge, a third along.
  const point: Vector3 = [x - size_m[0]! / 2, y - size_m[1]! / 6, z + size_m[2]! / 2];
  // The view may still be on its way when the mode changes: pointed at anew until the edge answers.
  const hover = async (): Promise<{ readonly x: number; readonly y: number }> => {
    for (let i = 0; i < 40; i++) {
      const at = await page.evaluate(where => window.twincellScene!.project(where), point);
      await page.mouse.move(at.x - 3, at.y - 2);
      await page.mouse.move(at.x, at.y);
      await page.waitForTimeout(250);
      const now = await page.evaluate(where => window.twincellScene!.project(where), point);
      const still = Math.hypot(now.x - at.x, now.y - at.y) < 0.5;
      if (still && (await page.evaluate(() => window.twincell.stores.traceStore.getState().hovered !== null)))
        return at;
    }
    await page.screenshot({ path: picture("frame-budget-no-edge") });
    throw new Error("The edge does not answer to the pointer.");
  };
  const make = async (): Promise<void> => {
    const at = await hover();
    await page.mouse.click(at.x, at.y);
    try {
      await page.waitForFunction(() => window.twincell.stores.traceStore.getState().chosen.length === 1, null, {
        polling: 50,
      });
    } catch (cause) {
      await page.screenshot({ path: picture("frame-budget-not-chosen") });
      throw new Error(
        `The click chose nothing: ${JSON.stringify(await page.evaluate(() => window.twincell.stores.traceStore.getState()))}`,
        { cause },
      );
    }
    const before = await page.evaluate(() => window.twincell.stores.traceStore.getState().last);
    expect(before).toBeNull();
    await page.getByRole("button", { name: "Make points" }).click();
    await page.waitForFunction(() => window.twincell.stores.traceStore.getState().last !== null, null, {
      polling: 50,
      timeout: 60_000,
    });
    await judged();
  };
  expect(
    await long(make, () =>
      page.evaluate(() => {
        window.twincell.stores.traceStore.setState({ chosen: [], last: null });
        window.twincell.document.undo();
      }),
    ),
  ).toEqual([]);
  expect(problems).toEqual([]);
});

test("the measure sees script that takes too long", ONCE, async () => {
  await page.evaluate(() => {
    // So much work, not so much time: a busy machine does not shorten it.
    let sum = 0;
    const work = (sines: number): void => {
      for (let i = 0; i < sines; i++) sum += Math.sin(i);
    };
    const everyFrame = (): void => {
      work(400_000);
      requestAnimationFrame(everyFrame);
    };
    requestAnimationFrame(everyFrame);
    setInterval(() => {
      work(8_000_000);
      document.title = String(sum);
    }, 500);
  });
  const { script_ms, tasks_ms } = await cpuDuring(page, () => page.waitForTimeout(3000));
  expect(quantile(script_ms, 0.95)).toBeGreaterThan(P95_MS);
  expect(tasks_ms.filter(ms => ms > LONG_MS).length).toBeGreaterThan(0);
});
