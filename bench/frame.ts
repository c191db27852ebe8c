import { saveDocument, tracedCartonCell } from "@twincell/project";
import { cpuDuring, type CpuReading } from "../apps/studio/browser-tests/support/cpu.ts";
import { ledger, type LedgerReading, quantile } from "../apps/studio/browser-tests/support/ledger.ts";
import { drawn, type Page, Studio } from "../apps/studio/browser-tests/support/studio.ts";
import { figure, type Bench, type Figure } from "./figure.ts";

const ROUNDS = 6;
const ROUND_MS = 4000;
const WARM_UP_MS = 6000;
const LONG_MS = 50;

interface Round {
  readonly cpu: CpuReading;
  readonly wall: LedgerReading;
}

/**
 * Script of the studio per frame on the main thread while the taught example plays (collisions looked at all along, the
 * virtual controller cycling) and while its exported text runs on the twin. Rasterising in software would hide all else
 * and leave two frames a second, so frames are paced at 60 Hz without draw calls where script is measured: processor
 * time of the main thread, with the handing over of WebGL calls in it, and beside it the wall's clock without WebGL
 * calls, which goes on while other processes have the core. Long tasks are counted in frames as they come too.
 */
export const run: Bench = async () => {
  const studio = await Studio.start();
  try {
    const paced = await opened(studio, "paced");
    const play = await playing(paced, ROUNDS);
    const twin = await running(paced, ROUNDS);
    await paced.context().close();
    const whole = await opened(studio, "as they come");
    const rastered = [...(await playing(whole, 2)), ...(await running(whole, 2))];
    const all = [...play, ...twin, ...rastered];
    const ours = all.flatMap(({ cpu }) => cpu.tasks_ms).filter(ms => ms > LONG_MS);
    const seen = all.flatMap(({ wall }) => wall.longTasks);
    return [
      ...figuresOf("frame", "example playing, collisions looked at", play),
      ...figuresOf("frame/run", "exported text running on the twin at 250 Hz and recorded, collisions looked at", twin),
      figure(
        "frame/long-tasks",
        "tasks",
        [ours.length],
        `tasks with more than ${LONG_MS} ms of our script, budget 0; ${seen.length} longer than that by the clock, waiting for the rasteriser or for a core`,
      ),
      figure(
        "frame/fps",
        "1/s",
        rastered.map(({ wall }) => wall.script_ms.length / wall.seconds),
        "everything rasterised in software, 1280 × 800",
      ),
    ];
  } finally {
    await studio.stop();
  }
};

function figuresOf(name: string, what: string, rounds: readonly Round[]): Figure[] {
  const frames = rounds.reduce((sum, { cpu }) => sum + cpu.script_ms.length, 0);
  const cpu = (part: number): number[] => rounds.map(round => quantile(round.cpu.script_ms, part));
  return [
    figure(`${name}/median`, "ms", cpu(0.5), `processor time; ${what}; ${frames} frames in ${rounds.length} rounds`),
    figure(`${name}/p95`, "ms", cpu(0.95), "processor time; budget 3"),
    figure(`${name}/worst`, "ms", cpu(1), "processor time; budget 8"),
    figure(
      `${name}/wall-p95`,
      "ms",
      rounds.map(round => quantile(round.wall.script_ms, 0.95)),
      "by the clock, WebGL calls apart",
    ),
  ];
}

async function opened(studio: Studio, frames: "as they come" | "paced"): Promise<Page> {
  const { page } = await studio.open({ script: ledger(frames) });
  await drawn(page);
  await page.evaluate(text => {
    window.twincell.document.open(text, "example");
  }, saveDocument(tracedCartonCell()));
  await page.waitForFunction(
    name => {
      const { cellStore, playStore } = window.twincell.stores;
      const { verdict, checking } = playStore.getState();
      return cellStore.getState().document?.name === name && verdict !== null && checking === null;
    },
    tracedCartonCell().name,
    { timeout: 60_000, polling: 200 },
  );
  await page.waitForTimeout(2000);
  return page;
}

async function round(page: Page): Promise<Round> {
  const before = await page.evaluate(() => {
    window.twincellLedger.reset();
    return window.twincell.live.now().revision;
  });
  const cpu = await cpuDuring(page, () => page.waitForTimeout(ROUND_MS));
  const { wall, after } = await page.evaluate(() => ({
    wall: window.twincellLedger.read(),
    after: window.twincell.live.now().revision,
  }));
  // Rasterised in software a single frame can take longer than the round.
  if (after === before && wall.script_ms.length > 2)
    throw new Error("The robot on screen did not move while it was to be measured.");
  return { cpu, wall };
}

async function playing(page: Page, rounds: number): Promise<Round[]> {
  const readings: Round[] = [];
  const fromStart = () =>
    page.evaluate(() => {
      window.twincell.seek(0);
      if (!window.twincell.stores.playStore.getState().playing) window.twincell.run("play.toggle");
    });
  await fromStart();
  await page.waitForTimeout(WARM_UP_MS);
  for (let i = 0; i < rounds; i++) {
    readings.push(await round(page));
    await fromStart();
  }
  await page.evaluate(() => {
    window.twincell.run("play.toggle");
  });
  return readings;
}

async function running(page: Page, rounds: number): Promise<Round[]> {
  const readings: Round[] = [];
  await page.evaluate(() => {
    window.twincell.seek(0);
    window.twincell.run("run.start");
  });
  await page.waitForTimeout(WARM_UP_MS);
  for (let i = 0; i < rounds; i++) {
    readings.push(await round(page));
    const { running: on, message } = await page.evaluate(() => window.twincell.stores.controlStore.getState());
    if (!on) throw new Error(`The run ended before the measurement did. ${message}`);
  }
  await page.evaluate(() => {
    window.twincell.run("stop");
  });
  await page.waitForFunction(() => !window.twincell.stores.controlStore.getState().running, null, { polling: 50 });
  return readings;
}
