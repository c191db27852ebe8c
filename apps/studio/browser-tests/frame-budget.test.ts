import { saveDocument, tracedCartonCell } from "@twincell/project";
import { afterAll, beforeAll, expect, test } from "vitest";
import { ledger, type LedgerReading, quantile } from "./support/ledger.ts";
import { drawn, Studio, type Page } from "./support/studio.ts";

/** bench/frame.ts measures; this holds the line. */
const P95_MS = 3, LONG_MS = 50, ROUNDS = 8;

let studio: Studio, page: Page, problems: readonly string[];
beforeAll(async () => {
  studio = await Studio.start();
  ({ page, problems } = await studio.open({ script: ledger("paced") }));
  await drawn(page);
  await page.evaluate(text => { window.twincell.document.open(text, "example"); }, saveDocument(tracedCartonCell()));
  await judged();
});
afterAll(async () => { await studio.stop(); });

const judged = () => page.waitForFunction(name => {
  const { cellStore, playStore } = window.twincell.stores, { verdict, checking } = playStore.getState();
  return cellStore.getState().document?.name === name && verdict !== null && checking === null;
}, tracedCartonCell().name, { timeout: 60_000, polling: 100 });

async function during(act: () => Promise<unknown>): Promise<LedgerReading> {
  await page.evaluate(() => { window.twincellLedger.reset(); });
  await act();
  await page.waitForTimeout(300);
  return page.evaluate(() => window.twincellLedger.read());
}

/** The least busy of some rounds: other processes may take the core for a while, our own script is there in every round. */
async function leastP95(): Promise<{ readonly p95_ms: number; readonly frames: number }> {
  const rounds: LedgerReading[] = [];
  for (let i = 0; i < ROUNDS; i++) rounds.push(await during(() => page.waitForTimeout(1200)));
  return { p95_ms: Math.min(...rounds.map(({ script_ms }) => quantile(script_ms, 0.95))), frames: rounds.reduce((sum, { script_ms }) => sum + script_ms.length, 0) };
}

test("script per frame stays within 3 ms while the program plays and collisions are looked at", async () => {
  await page.evaluate(() => { window.twincell.seek(0); window.twincell.run("play.toggle"); });
  await page.waitForTimeout(3000);
  const before = await page.evaluate(() => window.twincell.live.now().revision), { p95_ms, frames } = await leastP95();
  expect(await page.evaluate(() => window.twincell.live.now().revision)).toBeGreaterThan(before + 20);
  expect(await page.evaluate(() => window.twincell.stores.watchStore.getState().took_ms)).toBeGreaterThan(0);
  expect(frames).toBeGreaterThan(40);
  expect(p95_ms).toBeLessThanOrEqual(P95_MS);
  await page.evaluate(() => { window.twincell.run("play.toggle"); });
});

test("script per frame stays within 3 ms while the exported text runs on the twin and is recorded; no sample is lost", async () => {
  await page.evaluate(() => { window.twincell.seek(0); window.twincell.run("run.start"); });
  await page.waitForFunction(() => window.twincell.stores.controlStore.getState().running, null, { polling: 50 });
  await page.waitForTimeout(3000);
  const { p95_ms } = await leastP95();
  expect(p95_ms).toBeLessThanOrEqual(P95_MS);
  const { samples, lost, ages_ms } = await page.evaluate(() => { const { samples: count, lost: missing, ages_ms: ages } = window.twincell.live.link; return { samples: count, lost: missing, ages_ms: ages }; });
  expect(samples).toBeGreaterThan(1000);
  expect(lost).toBe(0);
  expect(quantile(ages_ms, 0.5)).toBeLessThan(10);
  await page.evaluate(() => { window.twincell.run("stop"); });
  await page.waitForFunction(() => !window.twincell.stores.controlStore.getState().running, null, { polling: 50 });
  await page.waitForFunction(() => window.twincell.stores.historyStore.getState().runs.some(run => run.ending !== "running"), null, { polling: 50 });
});

/** The least of three: what our script does it does every time. */
async function longest(act: () => Promise<unknown>, undo: () => Promise<unknown>): Promise<readonly string[]> {
  let least: readonly string[] | null = null;
  for (let i = 0; i < 3; i++) {
    const { longTasks } = await during(act), ours = longTasks.filter(task => task.script_ms > LONG_MS).map(task => `${task.what}: ${task.script_ms.toFixed(0)} ms of ${task.took_ms.toFixed(0)} ms`);
    if (least === null || ours.length < least.length) least = ours;
    if (least.length === 0) break;
    await undo();
  }
  return least ?? [];
}

test("checking happens away from the page", async () => {
  await page.evaluate(() => { window.twincell.stores.viewStore.setState({ mode: "check" }); });
  const check = async (): Promise<void> => { await page.evaluate(() => { window.twincell.run("check.now"); }); await judged(); };
  expect(await longest(check, async () => { /* The next check begins anew by itself. */ })).toEqual([]);
});

test("exporting happens away from the page", async () => {
  const exporting = async (): Promise<void> => {
    await page.evaluate(() => { window.twincell.run("export.open"); });
    await page.waitForFunction(() => window.twincell.stores.postStore.getState().emitted !== null, null, { polling: 50, timeout: 30_000 });
  };
  const close = () => page.keyboard.press("Escape");
  expect(await longest(exporting, close)).toEqual([]);
  await close();
});

test("opening a recording happens away from the page", async () => {
  const { runs } = await page.evaluate(() => window.twincell.stores.historyStore.getState());
  await page.evaluate(() => { window.twincell.stores.viewStore.setState({ mode: "history" }); });
  const open = async (): Promise<void> => {
    await page.getByRole("button", { name: runs[0]!.name }).first().click();
    await page.waitForFunction(() => { const { open: id, opening, duration_s } = window.twincell.stores.historyStore.getState(); return id !== null && !opening && duration_s > 0; }, null, { polling: 50, timeout: 30_000 });
  };
  expect(await longest(open, async () => { /* The run is opened once more. */ })).toEqual([]);
});

test("making points from edges happens away from the page", async () => {
  await page.evaluate(() => { window.twincell.stores.viewStore.setState({ mode: "teach" }); window.twincell.run("trace.toggle"); });
  const carton = tracedCartonCell().objects.find(object => object.id === "carton")!, size_m = carton.shape.kind === "box" ? carton.shape.size_m : [0, 0, 0];
  const [x, y, z] = carton.worldFromObject.position;
  // On the near top edge, a third along.
  const point = [x - size_m[0]! / 2, y - size_m[1]! / 6, z + size_m[2]! / 2] as const;
  const make = async (): Promise<void> => {
    const at = await page.evaluate(where => window.twincellScene!.project(where), point);
    await page.mouse.move(at.x - 3, at.y - 2);
    await page.mouse.move(at.x, at.y);
    await page.waitForFunction(() => window.twincell.stores.traceStore.getState().hovered !== null, null, { polling: 50 });
    await page.mouse.click(at.x, at.y);
    await page.waitForFunction(() => window.twincell.stores.traceStore.getState().chosen.length === 1, null, { polling: 50 });
    const before = await page.evaluate(() => window.twincell.stores.traceStore.getState().last);
    expect(before).toBeNull();
    await page.getByRole("button", { name: "Make points" }).click();
    await page.waitForFunction(() => window.twincell.stores.traceStore.getState().last !== null, null, { polling: 50, timeout: 60_000 });
    await judged();
  };
  expect(await longest(make, () => page.evaluate(() => { window.twincell.stores.traceStore.setState({ last: null }); window.twincell.document.undo(); }))).toEqual([]);
  expect(problems).toEqual([]);
});
