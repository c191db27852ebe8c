import type { CommandOutcome } from "@twincell/core";
import type { Pendant } from "../driver/brand.ts";

/** The jog keys of a cabinet. Let go, they stop what they have begun and nothing else. */
export function jogKeys(jog: Pendant["jog"], stop: () => void): Pick<Pendant, "jog" | "stopJog"> {
  let jogging = false;
  return {
    async jog(q_rad, ratio): Promise<CommandOutcome> {
      jogging = true;
      const outcome = await jog(q_rad, ratio);
      jogging = false;
      return outcome;
    },
    stopJog() {
      if (jogging) stop();
    },
  };
}
