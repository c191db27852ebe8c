import { setTimeout as pause } from "node:timers/promises";
import { ledger } from "../apps/studio/browser-tests/support/ledger.ts";
import { drawn, Studio } from "../apps/studio/browser-tests/support/studio.ts";
import { figure, type Bench } from "./figure.ts";
import { clockBehind_ms, clockOf, joined, late, lookAtStations, openAt, virtual } from "./stations.ts";

const SECONDS = Number(process.env["TWINCELL_BENCH_S"] ?? 10);
const HOST = "127.0.0.56";
interface Seen {
  readonly received_ms: number;
  readonly sent_ms: number;
}

/**
 * How late the studio shows what a controller of Universal Robots samples at 500 Hz: the controller, the server with
 * the station and the page are processes of their own on loopback. Age = way from controller to server (over its
 * fastest, by the controller's own clock) + from the server's handing on to the pose in the page, clocks mapped by the
 * quickest of many questions. Frames are paced.
 */
export const stationLate: Bench = async () => {
  const controller = await virtual("ur", HOST);
  const ways_ms = new Map<number, number>();
  const told_ms: number[] = [];
  let studio: Studio | null = null;
  let pong: ((host_ms: number) => void) | null = null;
  let least_ms = Infinity;
  try {
    studio = await Studio.start();
    const { client, socket } = await joined(studio.url, text => {
      if (text.startsWith('{"type":"pong"')) {
        pong?.((JSON.parse(text) as { host_s: number }).host_s * 1000);
        return;
      }
      if (!text.startsWith('{"type":"sample"')) return;
      const { sent_s, time_s } = JSON.parse(text) as { sent_s: number; time_s: number };
      const way_ms = (sent_s - time_s) * 1000;
      least_ms = Math.min(least_ms, way_ms);
      ways_ms.set(sent_s * 1000, way_ms);
      told_ms.push(sent_s * 1000);
    });
    /** How far the server's clock is behind ours [ms]. */
    const serverOffset_ms = await clockBehind_ms(
      () =>
        new Promise<number>(resolve => {
          pong = resolve;
          socket.send(JSON.stringify({ type: "ping", sent_s: 0 }));
        }),
    );
    await openAt(client, "cell", "ur", "ur10e", HOST);
    const { page, context } = await studio.open({ script: ledger("paced") });
    await drawn(page);
    await lookAtStations(page);
    await page.waitForFunction(() => window.twincell.live.station("cell") !== undefined, null, {
      timeout: 20_000,
      polling: 100,
    });
    await pause(2000);
    const pageOffset_ms = await clockOf(page);
    ways_ms.clear();
    await page.evaluate(() => {
      const live = window.twincell.live.station("cell")!;
      const seen: Seen[] = [];
      const frames: Seen[] = [];
      let revision = live.revision;
      let drawnRevision = revision;
      // The last thing that is written of a sample.
      Object.defineProperty(live, "revision", {
        get: () => revision,
        set(to: number) {
          revision = to;
          seen.push({ received_ms: live.received_s * 1000, sent_ms: live.sent_s * 1000 });
        },
      });
      const frame = (): void => {
        if (revision !== drawnRevision) {
          drawnRevision = revision;
          frames.push({ received_ms: performance.now(), sent_ms: live.sent_s * 1000 });
        }
        requestAnimationFrame(frame);
      };
      requestAnimationFrame(frame);
      Object.assign(window, { benchSeen: { seen, frames } });
    });
    await pause(SECONDS * 1000);
    const { seen, frames } = await page.evaluate(
      () => (window as unknown as { benchSeen: { seen: Seen[]; frames: Seen[] } }).benchSeen,
    );
    const missing = await page.evaluate(() => window.twincell.stores.stationStore.getState().stations[0]!.link.missing);
    // What is still under way to this process is waited for.
    await pause(500);
    await context.close();
    const ages = (of: readonly Seen[]): number[] =>
      of.map(
        ({ received_ms, sent_ms }) =>
          (ways_ms.get(sent_ms) ?? least_ms) - least_ms + (received_ms + pageOffset_ms) - (sent_ms + serverOffset_ms),
      );
    const told = told_ms.filter(sent_ms => sent_ms >= seen[0]!.sent_ms && sent_ms <= seen.at(-1)!.sent_ms).length;
    return [
      late(
        "twin/station-p99",
        ages(seen),
        `controller's sample to the studio's pose, UR at 500 Hz, controller, server and page each a process, ${SECONDS} s; budget 10`,
      ),
      late(
        "twin/station-frame-p99",
        ages(frames),
        "the same until the next paced frame takes the pose; a frame is up to 16.7 ms away by itself",
      ),
      late(
        "twin/station-way-p99",
        [...ways_ms.values()].map(way_ms => way_ms - least_ms),
        "of these: controller to server, over the fastest",
      ),
      late(
        "twin/station-page-p99",
        seen.map(({ received_ms, sent_ms }) => received_ms + pageOffset_ms - sent_ms - serverOffset_ms),
        "of these: server to page",
      ),
      figure(
        "twin/station-lost",
        "samples",
        [told - seen.length + missing],
        `${seen.length} samples, ${told} told by the server, ${missing} missing at the server; budget 0`,
      ),
      figure("twin/station-rate", "Hz", [(seen.length - 1) / ((seen.at(-1)!.sent_ms - seen[0]!.sent_ms) / 1000)]),
    ];
  } finally {
    controller.kill("SIGTERM");
    await studio?.stop();
  }
};
