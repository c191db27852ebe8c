import { isThere, sharedCell } from "./collision.ts";
import type { Bench } from "./figure.ts";
import { planningFigures } from "./planning.ts";

/** Paths round obstacles in the shared KR 6 cell, each line of them proven; the same questions to OMPL where it is. */
export const run: Bench = () => {
  if (!isThere()) {
    process.stderr.write("plan: the shared KR 6 cell is not beside the checkout and is left out.\n");
    return Promise.resolve([]);
  }
  const { collider, arm, cases, peer } = sharedCell();
  const free = cases.filter(({ collides }) => !collides).map(({ q_rad }) => q_rad);
  return Promise.resolve(planningFigures({ collider, arm, free, peer }));
};
