import {
  baseField,
  CellCollider,
  suggestBase,
  type BaseField,
  learnPairs,
  keptApart,
  robotById,
  escapeSelfCollision,
  PathValidator,
  detour,
  repairAll,
  RepairSearch,
  trackingError,
  type Robot,
  type Tracking,
  type PathOptions,
  type RepairOptions,
} from "@twincell/core";
import type { FromPlanner, PlanTask, RepairQuestion, ToPlanner } from "../../workers/plan-messages.ts";

/** Long enough for a crowded cell, short enough to be waited for. */
const WITHIN_S = 20;
const SEED = 1;
const LEARN_SAMPLES = 2000;
/** Room to keep on the way to a posture; less where the ends have less [m]. */
const ROOMS_M = [0.01, 0] as const;
const TELL_EVERY_S = 0.06;

/** Parts of the planned speed at which the accuracy is looked at. */
const OVERRIDES = [0.1, 0.25, 0.5, 0.75, 1] as const;
/** Drives as of a medium-sized arm [rad/s], integrated in steps of this [s]. */
const BANDWIDTH_RAD_S = 60;
const DRIVE_STEP_S = 1e-3;

/** The error of the drives at each part of the speed, one after the other, so that progress can be told. */
function accuracyStudy(
  { plan, program, worldFromBase }: Extract<PlanTask, { kind: "accuracy" }>,
  robot: Robot,
  tell: (fraction: number) => void,
): Tracking {
  // The slowest takes the longest: a share of time is one of 1 / speed.
  const all = OVERRIDES.reduce((sum, override) => sum + 1 / override, 0);
  let done = 0;
  const rows = [];
  for (const override of OVERRIDES) {
    const one = trackingError(plan, robot, program, {
      worldFromBase,
      control: { kind: "drives", bandwidth_rad_s: BANDWIDTH_RAD_S },
      overrides: [override],
      step_s: DRIVE_STEP_S,
    });
    if (one.kind === "unknown") return one;
    rows.push(...one.rows);
    done += 1 / override / all;
    tell(done);
  }
  return { kind: "known", rows };
}

/** The body of the planning worker: pure but for the clock it is given. */
export function planTask(
  { id, task }: ToPlanner,
  now_s: () => number,
  tell: (message: FromPlanner) => void,
): FromPlanner {
  const robot = robotById(task.robot);
  if (!robot) return { kind: "trouble", id, sentence: `The library has no robot called “${task.robot}”.` };
  let told_s = now_s();
  const options: PathOptions = {
    seed: SEED,
    now_s,
    within_s: WITHIN_S,
    onProgress: share => {
      if (now_s() - told_s > TELL_EVERY_S) {
        told_s = now_s();
        tell({ kind: "progress", id, share });
      }
    },
  };
  switch (task.kind) {
    case "way":
      return {
        kind: "way",
        id,
        answer: detour(task.program, task.step, robot, { ...options, cell: task.cell, margin_m: task.margin_m }),
      };
    case "accuracy":
      return { kind: "accuracy", id, tracking: accuracyStudy(task, robot, options.onProgress!) };
    case "explain":
      return {
        kind: "explained",
        id,
        explanation: new RepairSearch(task.program, robot, repairOptions(task)).explain(task.step) ?? null,
      };
    case "repair-all": {
      const { applied, left } = repairAll(task.program, robot, repairOptions(task), options.onProgress);
      return { kind: "repaired", id, applied, left };
    }
    case "base-field": {
      const { cell, program, margin_m } = task;
      const { worldFromBase } = cell;
      let field: BaseField = { points: 0, square_m: 0, squares: [], complete: false };
      for (field of baseField(program, robot, worldFromBase)) tell({ kind: "field-so-far", id, field });
      const asked = { cell, margin_m, worldFromBase };
      return {
        kind: "base-field",
        id,
        field,
        best: suggestBase(field, program, robot, asked, options.onProgress) ?? null,
      };
    }
    case "learn":
      return { kind: "learnt", id, matrix: learnPairs(task.cell, robot.arm, SEED, LEARN_SAMPLES, robot.home_rad) };
    case "go": {
      const collider = new CellCollider(task.cell, robot.arm);
      const ways = ROOMS_M.map(
        margin_m => () =>
          escapeSelfCollision(
            new PathValidator(collider, robot.arm, { margin_m, keepsMargin: keptApart }),
            task.from_rad,
            task.to_rad,
            options,
          ),
      );
      collider.allowContactsAt(robot.home_rad);
      const roomy = ways[0]!();
      return { kind: "go", id, answer: roomy.kind === "found" ? roomy : ways[1]!() };
    }
  }
}

const repairOptions = ({ cell, margin_m, parts, movesBase }: RepairQuestion): RepairOptions => ({
  cell,
  margin_m,
  movesBase,
  objectsOf: frame => parts[frame]?.objects ?? [],
  framesOf: frame => parts[frame]?.frames ?? [frame],
  nameOf: frame => parts[frame]?.name ?? frame,
});
