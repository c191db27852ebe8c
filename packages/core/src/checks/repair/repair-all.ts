import type { CellGeometry } from "../../collision/cell.ts";
import type { Robot } from "../../model/robot.ts";
import { identity, type Pose } from "../../spatial/pose.ts";
import type { Program } from "../../program/program.ts";
import type { Checked } from "../check.ts";
import {
  badOf,
  shiftedPose,
  RepairSearch,
  withRepair,
  type ProvenRepair,
  type RepairOptions,
} from "./repair-search.ts";

export interface RepairedProgram {
  readonly program: Program;
  /** Where the robot stands then. */
  readonly worldFromBase: Pose<"world", "base">;
  readonly cell?: CellGeometry;
  /** What was changed, in its order. */
  readonly applied: readonly { readonly step: string; readonly repair: ProvenRepair }[];
  /** Steps that are bad all the same. */
  readonly left: readonly string[];
  readonly checked: Checked;
  /** The sum of the efforts. */
  readonly effort: number;
}

/** Repairs applied at most. */
const MOST_ROUNDS = 40;

/**
 * Repairs a program as far as it goes, changing as little as possible: of the ways out of the first bad step the one
 * with the least effort for each step that it mends, then again with the program as it is then. Every repair has been
 * proven by checking the whole program.
 *
 * @param onProgress  called with 0 … 1.
 */
export function repairAll(
  program: Program,
  robot: Robot,
  options: RepairOptions = {},
  onProgress?: (share: number) => void,
): RepairedProgram {
  const applied: { step: string; repair: ProvenRepair }[] = [];
  const left = new Set<string>();
  let so = program;
  let asked = options;
  let search = new RepairSearch(so, robot, asked);
  const begun = Math.max(1, search.bad.length);
  for (let round = 0; round < MOST_ROUNDS && options.cancelled?.() !== true; round++) {
    const step = search.bad.find(id => !left.has(id));
    if (step === undefined) break;
    onProgress?.(Math.min(1, Math.max(0, 1 - search.bad.length / begun)));
    const best = search
      .explain(step)
      ?.repairs.toSorted((a, b) => a.effort / mends(a) - b.effort / mends(b))
      .at(0);
    if (best === undefined) {
      left.add(step);
      continue;
    }
    applied.push({ step, repair: best });
    const next = withRepair(so, step, best, asked.cell, asked);
    so = next.program;
    const stood = asked.worldFromBase ?? asked.cell?.worldFromBase ?? identity<"world", "base">();
    asked = {
      ...asked,
      ...(next.cell === undefined ? {} : { cell: next.cell }),
      ...(best.moveBase === undefined ? {} : { worldFromBase: shiftedPose(stood, best.moveBase.by_m) }),
    };
    search = new RepairSearch(so, robot, asked);
  }
  onProgress?.(1);
  return {
    program: so,
    worldFromBase: asked.worldFromBase ?? asked.cell?.worldFromBase ?? identity(),
    ...(asked.cell === undefined ? {} : { cell: asked.cell }),
    applied,
    left: badOf(search.checked.verdict),
    checked: search.checked,
    effort: applied.reduce((sum, { repair }) => sum + repair.effort, 0),
  };
}

const mends = ({ reaches: { bad, badBefore } }: ProvenRepair): number => Math.max(1, badBefore - bad);
