import type { Scheduler } from "@twincell/core";
import { addEffort } from "./effort.ts";

/**
 * The page's clock. Ticks may come late (a busy page, a hidden tab); whoever asked looks at the clock, not at the
 * count.
 */
export const pageScheduler: Scheduler = {
  now_s: () => performance.now() / 1000,
  every(period_s, tick) {
    const timer = setInterval(
      () => {
        const began_ms = performance.now();
        tick();
        addEffort(performance.now() - began_ms);
      },
      Math.max(4, period_s * 1000),
    );
    return () => {
      clearInterval(timer);
    };
  },
};
