import {
  RepairSearch,
  type CheckOptions,
  type Checked,
  type Explanation,
  type Program,
  type Robot,
} from "@twincell/core";
import { framesWith, nameOfFrame, objectsOfFrame, type CellDocument } from "@twincell/project";

/** More bad steps than this are not explained: each is a search of its own. */
export const MOST_EXPLAINED = 20;

/** A search for ways out of the bad steps of a program, as it was checked, in the cell it was checked in. */
export function repairSearch(
  program: Program,
  robot: Robot,
  options: CheckOptions,
  checked: Checked,
  document?: CellDocument,
): RepairSearch {
  const parts = document && {
    objectsOf: (frame: string) => objectsOfFrame(document, frame),
    framesOf: (frame: string) => framesWith(document, frame),
    nameOf: (frame: string) => nameOfFrame(document, frame),
  };
  return new RepairSearch(program, robot, { ...options, ...parts }, checked);
}

/** The verdict, each bad step with why it is so and what would change that, and how many bad steps were left out. */
export function explained(
  { verdict }: Checked,
  search: RepairSearch,
  most = MOST_EXPLAINED,
): { readonly verdict: object; readonly leftOut: number } {
  let left = most;
  const steps = verdict.steps.map(step => {
    const explanation = step.verdict === "bad" && left-- > 0 ? search.explain(step.id) : undefined;
    return explanation === undefined ? step : { ...step, repair: asJson(explanation) };
  });
  return { verdict: { ...verdict, steps }, leftOut: Math.max(0, -left) };
}

export const asJson = ({ cause, sentence, out, repairs, tried }: Explanation): object => ({
  cause,
  sentence,
  ...(out === undefined ? {} : { out }),
  repairs,
  tried,
});
