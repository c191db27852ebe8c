import "./know-robots.ts";
import {
  driverKindById,
  DRIVER_KINDS,
  createSharedCell,
  openRobotConnection,
  startSynchronized,
} from "@twincell/controllers";
import { manualScheduler, robotById, type Refusal } from "@twincell/core";
import { dialectById } from "@twincell/languages";
import { readConnectionCell } from "@twincell/project";
import { createRobotServer, type OpenedConnection } from "@twincell/protocol";

/** How often the world of the page goes on, and the most it goes on by at once [s]. */
const TICK_S = 0.004;
const MOST_S = 0.02;

/**
 * The clock of the virtual controllers, their wires, drivers and guards. A worker that was kept from running is no link
 * that was lost: all of them stand still together, and go on together.
 */
const scheduler = manualScheduler();
let last_s = performance.now() / 1000;
setInterval(() => {
  const now_s = performance.now() / 1000;
  scheduler.advance(Math.min(MOST_S, now_s - last_s));
  last_s = now_s;
}, TICK_S * 1000);

/** All robots of the page that stand in the cell. */
const cell = createSharedCell();
const refused = (why: Refusal): OpenedConnection => ({ kind: "refused", why });

const host = createRobotServer({
  scheduler,
  version: "",
  brands: DRIVER_KINDS.map(({ id, name, vendor, dialect, ports }) => ({
    id,
    name,
    vendor,
    dialect,
    ports: { ...ports },
  })),
  together: (members, onStarted) => startSynchronized(members, scheduler, onStarted),
  async open(ask): Promise<OpenedConnection> {
    const brand = driverKindById(ask.brand);
    const robot = robotById(ask.robot);
    const dialect = brand && dialectById(brand.dialect);
    if (!brand || !dialect || !robot)
      return refused({
        code: "station.none",
        sentence: `There is no virtual controller “${ask.brand}” for “${ask.robot}”.`,
        hint: "Choose another robot.",
      });
    if (ask.address)
      return refused({
        code: "station.no-network",
        sentence: "A page has no network of its own: real controllers are reached through the server.",
        hint: "Start Twincell with npx twincell serve and open its address.",
      });
    return openRobotConnection({
      id: ask.station,
      brand,
      robot,
      scheduler,
      dialect,
      readCell: readConnectionCell,
      ...(ask.cell === undefined ? {} : { cell: ask.cell }),
      ...(ask.stand ? { shared: { cell, stand: ask.stand } } : {}),
      ...(ask.watch === undefined ? {} : { watching: ask.watch }),
      ...(ask.name === undefined ? {} : { name: ask.name }),
      ...(ask.worldFromBase ? { worldFromBase: ask.worldFromBase } : {}),
    });
  },
});

const seat = host.join("you", {
  send(text) {
    postMessage(text);
  },
  close() {
    /* A page's worker ends with the page. */
  },
});
addEventListener("message", ({ data }: MessageEvent<string>) => {
  seat.hear(data);
});
