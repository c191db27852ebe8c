import type { Scheduler } from "@twincell/core";

/** The clock of this process. */
export const processScheduler = (): Scheduler => ({
  now_s: () => performance.now() / 1000,
  every(period_s, tick) {
    const timer = setInterval(tick, period_s * 1000);
    return () => { clearInterval(timer); };
  },
});
