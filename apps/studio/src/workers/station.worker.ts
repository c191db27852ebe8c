import { brandById, BRANDS, openStation } from "@twincell/controllers";
import { robotById, type Refusal, type Scheduler } from "@twincell/core";
import { dialectById } from "@twincell/languages";
import { createHost, type OpenedStation } from "@twincell/messages";

/** A worker's timers are not slowed down while the page is out of sight; whoever asked looks at the clock, not at the count. */
const scheduler: Scheduler = {
  now_s: () => performance.now() / 1000,
  every(period_s, tick) {
    const timer = setInterval(tick, Math.max(1, period_s * 1000));
    return () => { clearInterval(timer); };
  },
};
const refused = (why: Refusal): OpenedStation => ({ kind: "refused", why });

const host = createHost({
  scheduler, version: "",
  brands: BRANDS.map(({ id, name, vendor, dialect, ports }) => ({ id, name, vendor, dialect, ports: { ...ports } })),
  async open(ask): Promise<OpenedStation> {
    const brand = brandById(ask.brand), robot = robotById(ask.robot), dialect = brand && dialectById(brand.dialect);
    if (!brand || !dialect || !robot) return refused({ code: "station.none", sentence: `There is no virtual controller “${ask.brand}” for “${ask.robot}”.`, hint: "Choose another robot." });
    if (ask.address) return refused({ code: "station.no-network", sentence: "A page has no network of its own: real controllers are reached through the server.", hint: "Start Twincell with npx twincell serve and open its address." });
    return openStation({
      id: ask.station, brand, robot, scheduler, dialect,
      ...(ask.name === undefined ? {} : { name: ask.name }), ...(ask.worldFromBase ? { worldFromBase: ask.worldFromBase } : {}),
    });
  },
});

const seat = host.join("you", { send(text) { postMessage(text); }, close() { /* A page's worker ends with the page. */ } });
addEventListener("message", ({ data }: MessageEvent<string>) => { seat.hear(data); });
