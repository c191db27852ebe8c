import type { Scheduler } from "@twincell/core";
import type { RobotServer } from "@twincell/protocol";

/** A robot that is told to stop and still moves after this time is named, and waited for no longer [s]. */
const PATIENCE_S = 3;
const LOOK_EACH_S = 0.02;

/**
 * Waits until every connected robot says that it stands.
 *
 * @param moving  ids of those that say that they move.
 * @returns ids of those that did not come to a stand in time.
 */
export async function standstill(
  host: Pick<RobotServer, "stations">,
  moving: (id: string) => boolean,
  scheduler: Scheduler,
): Promise<readonly string[]> {
  const until_s = scheduler.now_s() + PATIENCE_S;
  const still = (): readonly string[] =>
    host.stations.filter(({ link, words }) => link?.state === "open" && moving(words.id)).map(({ words }) => words.id);
  if (still().length === 0) return [];
  return new Promise(resolve => {
    const stop = scheduler.every(LOOK_EACH_S, () => {
      const left = still();
      if (left.length > 0 && scheduler.now_s() < until_s) return;
      stop();
      resolve(left);
    });
  });
}
