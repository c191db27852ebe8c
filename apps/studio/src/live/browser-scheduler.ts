import type { Scheduler } from "@twincell/core";

/** Time of the page. Ticks come as often as the browser grants; whoever needs every cycle catches up by `now_s`. */
export const browserScheduler: Scheduler = {
  now_s: () => performance.now() / 1000,
  every(period_s, tick) {
    const timer = setInterval(tick, Math.max(4, period_s * 1000));
    return () => clearInterval(timer);
  },
};
