import { createTwin, createVirtualController } from "@twincell/controllers";
import { robotById } from "@twincell/core";
import { saveDocument, tracedCartonCell } from "@twincell/project";
import { ledger, quantile } from "../apps/studio/browser-tests/support/ledger.ts";
import { drawn, Studio } from "../apps/studio/browser-tests/support/studio.ts";
import { figure, type Bench, type Figure } from "./figure.ts";
import { stationLate } from "./twin-station.ts";
import { stopLate } from "./twin-stop.ts";

const SECONDS = Number(process.env["TWINCELL_BENCH_S"] ?? 10);

/**
 * How late the twin shows what the controller samples, in real time: with timers of this process, at 500 samples a
 * second, in the page while its exported text runs, over a server between processes, and how long a stop is under way.
 * A sample is due at its own time; its age is taken where the pose is shown, so a timer that comes late counts.
 */
export const run: Bench = async () => [
  ...(await inProcess()),
  ...(await inPage()),
  ...(await stationLate()),
  ...(await stopLate()),
];

async function inProcess(): Promise<Figure[]> {
  const robot = robotById("staubli_rx90l");
  if (!robot) throw new Error("The library has no staubli_rx90l.");
  const scheduler = {
    now_s: () => performance.now() / 1000,
    every(period_s: number, tick: () => void) {
      const timer = setInterval(tick, period_s * 1000);
      return () => {
        clearInterval(timer);
      };
    },
  };
  const ages_ms: number[] = [];
  const shown_rad = Float64Array.from(robot.home_rad);
  let last = 0;
  let lost = 0;
  let worst_rad = 0;
  const began_s = scheduler.now_s();
  const real = createVirtualController({ robot, scheduler, cycle_s: 0.002 });
  const twin = createTwin({
    real,
    scheduler,
    mirror: {
      show(sample) {
        shown_rad.set(sample.q_rad);
        ages_ms.push(Math.max(0, (scheduler.now_s() - began_s - sample.time_s) * 1000));
        if (last > 0 && sample.sequence !== last + 1) lost += sample.sequence - last - 1;
        last = sample.sequence;
      },
      read(out) {
        out.set(shown_rad);
        return out;
      },
    },
  });
  const there = Float64Array.from(robot.home_rad, (angle, joint) => angle + (joint === 0 ? 1 : 0.3));
  for (const until_s = scheduler.now_s() + SECONDS; scheduler.now_s() < until_s; ) {
    for (const target of [there, robot.home_rad]) {
      const outcome = await twin.moveJoints(target);
      if (outcome.kind !== "done") throw new Error(outcome.why.sentence);
    }
  }
  worst_rad = Math.max(twin.accuracy.mirror_rad, twin.accuracy.command_rad);
  twin.close();
  real.close();
  return [
    ages("twin/p99", ages_ms, "virtual controller at 500 Hz, timers of one process; budget 10"),
    figure("twin/lost", "samples", [lost], `${ages_ms.length} samples; budget 0`),
    figure(
      "twin/difference",
      "rad",
      [worst_rad],
      "largest of any joint between controller, twin and command; budget 0.001°",
    ),
  ];
}

async function inPage(): Promise<Figure[]> {
  const studio = await Studio.start();
  try {
    const paced = await pageRun(studio, "paced");
    const rastered = await pageRun(studio, "as they come");
    return [
      ages(
        "twin/page-p99",
        paced.ages_ms,
        "in the page at 250 Hz, frames at 60 Hz without draw calls; controller and picture share one thread, so that whatever holds it makes samples late; aim 10",
      ),
      figure(
        "twin/page-lost",
        "samples",
        [paced.lost + rastered.lost],
        `${paced.samples + rastered.samples} samples; budget 0`,
      ),
      ages(
        "twin/page-rasterised-p99",
        rastered.ages_ms,
        "the same with everything rasterised in software: a frame that waits for the rasteriser delays the samples behind it",
      ),
      figure("twin/page-difference", "rad", [paced.difference_rad, rastered.difference_rad], "budget 0.001°"),
    ];
  } finally {
    await studio.stop();
  }
}

async function pageRun(studio: Studio, frames: "as they come" | "paced") {
  const { page, context } = await studio.open({ script: ledger(frames) });
  await drawn(page);
  await page.evaluate(text => {
    window.twincell.document.open(text, "example");
  }, saveDocument(tracedCartonCell()));
  await page.waitForFunction(() => window.twincell.stores.playStore.getState().verdict !== null, null, {
    timeout: 60_000,
    polling: 200,
  });
  await page.evaluate(() => {
    window.twincell.run("run.start");
  });
  await page.waitForFunction(() => window.twincell.stores.controlStore.getState().running, null, { polling: 50 });
  // Showing the run panel for the first time is not what is measured.
  await page.waitForTimeout(2000);
  await page.evaluate(() => {
    window.twincell.live.link.reset();
  });
  await page.waitForTimeout(SECONDS * 1000);
  const measured = await page.evaluate(() => {
    const { ages_ms, samples, lost } = window.twincell.live.link;
    return { ages_ms, samples, lost, difference_rad: window.twincell.stores.controlStore.getState().twinError_rad };
  });
  await context.close();
  return measured;
}

const ages = (name: string, values: readonly number[], note: string): Figure => ({
  name,
  unit: "ms",
  median: quantile(values, 0.99),
  min: quantile(values, 0.5),
  max: quantile(values, 1),
  n: values.length,
  note: `99th percentile; min is the median, max the oldest; ${note}`,
});
