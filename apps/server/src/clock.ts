import type { Scheduler } from "@twincell/core";

/** The clock of this machine. Ticks may come late; whoever asked looks at the clock, not at the count. */
export const nodeScheduler: Scheduler = {
  now_s: () => performance.now() / 1000,
  every(period_s, tick) {
    const timer = setInterval(tick, period_s * 1000);
    return () => {
      clearInterval(timer);
    };
  },
};
