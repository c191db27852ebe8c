import { gzipSync } from "node:zlib";
import type { Response } from "playwright-core";
import { drawn, Studio } from "../apps/studio/browser-tests/support/studio.ts";
import { figure, type Bench } from "./figure.ts";

const ROUNDS = 5;

/**
 * A first visit, everything from this machine: how long until the page can be used (tree, pendant and timeline answer,
 * the program is there) and until the cell is drawn, and what has been loaded by then, gzipped. Nothing is cached
 * between rounds.
 */
export const run: Bench = async () => {
  const studio = await Studio.start();
  const usable_ms: number[] = [];
  const picture_ms: number[] = [];
  const usable_bytes: number[] = [];
  const picture_bytes: number[] = [];
  try {
    for (let round = 0; round < ROUNDS; round++) {
      const bodies = new Map<string, Promise<number>>();
      const { page, context } = await studio.open({
        script: WATCH,
        before: fresh => {
          fresh.on("response", response => {
            if (!bodies.has(response.url())) bodies.set(response.url(), zipped(response));
          });
        },
      });
      const loaded = async (until_ms: number): Promise<number> => {
        const before = new Set(
          await page.evaluate(
            limit =>
              performance
                .getEntriesByType("resource")
                .filter(({ startTime }) => startTime <= limit)
                .map(({ name }) => name),
            until_ms,
          ),
        );
        const sizes = await Promise.all(
          [...bodies].filter(([url]) => url === page.url() || before.has(url)).map(([, size]) => size),
        );
        return sizes.reduce((sum, size) => sum + size, 0);
      };
      await drawn(page);
      const { usable, picture } = await page.evaluate(() => ({
        usable: window.twincellUsable_ms,
        picture: performance.now(),
      }));
      usable_ms.push(usable);
      picture_ms.push(picture);
      usable_bytes.push((await loaded(usable)) / 1e6);
      picture_bytes.push((await loaded(picture)) / 1e6);
      await context.close();
    }
  } finally {
    await studio.stop();
  }
  return [
    figure("load/first", "ms", usable_ms, "until tree, pendant and timeline answer; budget 3000"),
    figure("load/picture", "ms", picture_ms, "until the cell is drawn, rasterised in software"),
    figure("load/gzip", "MB", usable_bytes, "all files asked for until then; budget 1.5"),
    figure("load/gzip-picture", "MB", picture_bytes, "all files asked for until the cell is drawn"),
  ];
};

declare global {
  interface Window {
    twincellUsable_ms: number;
  }
}
/** Runs in the page: notes when a person could do the first thing. */
const WATCH = `{
  const look = () => {
    const ready = document.querySelector(".area-left .row") && document.querySelector(".area-right button:enabled") && document.querySelector(".transport .btn.primary");
    if (ready) window.twincellUsable_ms = performance.now(); else setTimeout(look, 5);
  };
  look();
}`;

async function zipped(response: Response): Promise<number> {
  return response.ok() ? gzipSync(await response.body()).length : 0;
}
