import { saveDocument, tracedCartonCell } from "@twincell/project";
import { type LedgerReading, ledger, quantile } from "../apps/studio/browser-tests/support/ledger.ts";
import { drawn, type Page, Studio } from "../apps/studio/browser-tests/support/studio.ts";
import { figure, type Bench, type Figure } from "./figure.ts";

const ROUNDS = 12, ROUND_MS = 2000, WARM_UP_MS = 6000, LONG_MS = 50;

/**
 * Script of the studio per frame on the main thread, WebGL calls apart, while the taught example plays (collisions looked at
 * all along, the virtual controller cycling) and while its exported text runs on the twin. Rasterising in software would hide
 * all else and leave two frames a second, so frames are paced at 60 Hz without draw calls where script is measured; long tasks
 * are counted in frames as they come too, and ours are those in which our own script took more than 50 ms. It is the wall's
 * clock: a process that takes the core for a while counts as ours, and the least of the rounds is the nearest to a quiet machine.
 */
export const run: Bench = async () => {
  const studio = await Studio.start();
  try {
    const free = await opened(studio, "paced");
    const play = await playing(free), twin = await running(free);
    await free.context().close();
    const whole = await opened(studio, "as they come");
    const rastered = [...await playing(whole, 1), ...await running(whole, 1)];
    const long = [...play, ...twin, ...rastered].flatMap(({ longTasks }) => longTasks), ours = long.filter(task => task.script_ms > LONG_MS);
    return [
      ...figuresOf("frame", "example playing, collisions looked at", play),
      ...figuresOf("frame/run", "exported text running on the twin at 250 Hz and recorded, collisions looked at", twin),
      figure("frame/long-tasks", "tasks", [ours.length], `budget 0 with more than ${LONG_MS} ms of our script; ${long.length} in all, the others wait for the software rasteriser`),
      figure("frame/fps", "1/s", rastered.map(fps), "everything rasterised in software, 1280 × 800"),
    ];
  } finally {
    await studio.stop();
  }
};

const fps = (reading: LedgerReading): number => reading.script_ms.length / reading.seconds;

function figuresOf(name: string, what: string, rounds: readonly LedgerReading[]): Figure[] {
  const frames = rounds.reduce((sum, { script_ms }) => sum + script_ms.length, 0);
  const of = (part: number): number[] => rounds.map(({ script_ms }) => quantile(script_ms, part));
  return [
    figure(`${name}/median`, "ms", of(0.5), `${what}; ${frames} frames in ${rounds.length} rounds`),
    figure(`${name}/p95`, "ms", of(0.95), "budget 3"),
    figure(`${name}/worst`, "ms", of(1), "budget 8; the clock goes on while other processes have the core"),
  ];
}

async function opened(studio: Studio, frames: "as they come" | "paced"): Promise<Page> {
  const { page } = await studio.open({ script: ledger(frames) });
  await drawn(page);
  await page.evaluate(text => { window.twincell.document.open(text, "example"); }, saveDocument(tracedCartonCell()));
  await page.waitForFunction(name => {
    const { cellStore, playStore } = window.twincell.stores, { verdict, checking } = playStore.getState();
    return cellStore.getState().document?.name === name && verdict !== null && checking === null;
  }, tracedCartonCell().name, { timeout: 60_000, polling: 200 });
  await page.waitForTimeout(2000);
  return page;
}

async function round(page: Page): Promise<LedgerReading> {
  await page.evaluate(() => { window.twincellLedger.reset(); });
  await page.waitForTimeout(ROUND_MS);
  return page.evaluate(() => window.twincellLedger.read());
}

async function playing(page: Page, rounds = ROUNDS): Promise<LedgerReading[]> {
  const readings: LedgerReading[] = [];
  const fromStart = async (): Promise<void> => { await page.evaluate(() => { window.twincell.seek(0); if (!window.twincell.stores.playStore.getState().playing) window.twincell.run("play.toggle"); }); };
  await fromStart();
  await page.waitForTimeout(WARM_UP_MS);
  for (let i = 0; i < rounds; i++) {
    const looks = await page.evaluate(() => window.twincell.live.now().revision);
    readings.push(await round(page));
    if (await page.evaluate(() => window.twincell.live.now().revision) === looks) throw new Error("The robot on screen did not move while the program was to play.");
    await fromStart();
  }
  await page.evaluate(() => { window.twincell.run("play.toggle"); });
  return readings;
}

async function running(page: Page, rounds = ROUNDS): Promise<LedgerReading[]> {
  const readings: LedgerReading[] = [];
  await page.evaluate(() => { window.twincell.seek(0); window.twincell.run("run.start"); });
  await page.waitForTimeout(WARM_UP_MS);
  for (let i = 0; i < rounds; i++) {
    readings.push(await round(page));
    const { running: on, message } = await page.evaluate(() => window.twincell.stores.controlStore.getState());
    if (!on) throw new Error(`The run ended before the measurement did. ${message}`);
  }
  await page.evaluate(() => { window.twincell.run("stop"); });
  await page.waitForFunction(() => !window.twincell.stores.controlStore.getState().running);
  return readings;
}
