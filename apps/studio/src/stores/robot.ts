import { retargetProgram, robotById, type Pose, type Robot } from "@twincell/core";
import { withStepPrograms } from "@twincell/project";
import { words } from "../messages/index.ts";
import { cellStore } from "./cell.ts";
import { commit, robotOf } from "./document.ts";
import { notify } from "./notices.ts";
import { ownFileOf } from "./own-robots.ts";

/** The robot as it is called beside its maker. */
export const shortName = ({ name, vendor }: Robot): string =>
  name.startsWith(`${vendor} `) ? name.slice(vendor.length + 1) : name;

/**
 * Another robot takes the place of the one in the cell: base, tools and objects stay, every program is taught anew for
 * it. One undo step. Says whether anything changed.
 *
 * @param into  where its base stands, if not where the other's did, and objects that leave the cell for it.
 */
export function changeRobot(
  id: string,
  into: { readonly worldFromBase?: Pose<"world", "base">; readonly without?: ReadonlySet<string> } = {},
): boolean {
  const { document } = cellStore.getState();
  const from = robotOf(document);
  const to = robotById(id);
  if (!document || !to || document.robot.id === id) return false;
  const worldFromBase = into.worldFromBase ?? document.robot.worldFromBase;
  let points = 0;
  let kept = 0;
  const { programs } = withStepPrograms(document, program => {
    const taught = robotById(program.robot) ?? from;
    if (!taught) return program;
    const moved = retargetProgram(program, taught, to, worldFromBase, document.robot.worldFromBase);
    points += moved.points;
    kept += moved.points - moved.unreached.length;
    return moved.program;
  });
  const file = ownFileOf(id);
  const record = { id, worldFromBase, ...(file ? { file } : {}) };
  const changed = commit(words.undo.robot(shortName(to)), before => ({
    ...before,
    robot: record,
    programs,
    objects: into.without ? before.objects.filter(object => !into.without?.has(object.id)) : before.objects,
  }));
  if (!changed) return false;
  notify(
    kept === points ? "done" : "warn",
    changedWords(shortName(to), kept, points),
    kept === points ? undefined : words.robots.changedHint,
  );
  return true;
}

function changedWords(robot: string, kept: number, points: number): string {
  if (points === 0) return words.robots.changed(robot);
  return kept === points
    ? words.robots.changedAll(robot, points)
    : words.robots.changedSome(robot, kept, points, points - kept);
}
