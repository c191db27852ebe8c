import type { MoveStep, Program } from "@twincell/core";
import { tracedCartonCell, type CellDocument } from "@twincell/project";
import type { Page } from "playwright-core";

const DEG = Math.PI / 180;
const BAD: MoveStep = {
  id: "bad",
  name: "Bad point",
  type: "move",
  path: "ptp",
  speed: { ratio: 0.2 },
  blend_m: 0,
  // Joint 5 of the RX90L ends at 120°.
  target: { q: [0, -1.2, 1.9, 0, 123 * DEG, 0], tool: "torch" },
};

/** The traced carton with one good step and one whose joint 5 is beyond its limit. */
export function cellWithBadPoint(): CellDocument {
  const cell = tracedCartonCell();
  const program = cell.programs[0] as Program;
  return { ...cell, programs: [{ ...program, steps: [...program.steps.slice(0, 1), BAD] }] };
}

/** What the check says of that step; "stale" while it is looked at anew. */
export const verdictOfBad = (page: Page): Promise<string | undefined> =>
  page.evaluate(() => {
    const { verdict, stale } = window.twincell.stores.playStore.getState();
    return stale ? "stale" : verdict?.steps.find(({ id }) => id === "bad")?.verdict;
  });

/** Joint 5 as it is shown [°]. */
export const fifthJoint = (page: Page): Promise<number> =>
  page.evaluate(() => (window.twincell.live.now().q_rad[4]! * 180) / Math.PI);
