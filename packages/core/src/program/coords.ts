import { copyPose, type Pose } from "../spatial/pose.ts";
import type { MoveStep, Program, Speed } from "./program.ts";
import { freshStepIds } from "./edit.ts";

/** A pose of the tool tip that a person keeps under a name. Nothing asks whether a robot reaches it. */
export interface SavedPose { readonly name: string; readonly worldFromTcp: Pose<"world", "tcp"> }

/*
 * Edits of a list of saved poses: each takes a list and returns another, so that undo is keeping the one before. Names
 * are those of one pose each; an edit of a name that the list does not have returns the very same list.
 */

/** The list with one more pose behind the others: where the tool tip is now. A taken name gets a number; without one it is P1, P2 and so on. */
export function addCoords(poses: readonly SavedPose[], worldFromTcp: Pose<"world", "tcp">, name?: string): readonly SavedPose[] {
  return [...poses, { name: freeName(poses, name), worldFromTcp: copyPose(worldFromTcp) }];
}

/** The list with one pose renamed, moved, or both; also to where no robot reaches. */
export function editCoords(poses: readonly SavedPose[], name: string, change: Partial<SavedPose>): readonly SavedPose[] {
  const at = poses.findIndex(pose => pose.name === name), before = poses[at];
  if (before === undefined) return poses;
  const renamed = change.name === undefined || change.name === name ? name : freeName(poses, change.name);
  return poses.map((pose, i) => i === at ? { name: renamed, worldFromTcp: copyPose(change.worldFromTcp ?? before.worldFromTcp) } : pose);
}

/** The list without the poses of these names; without any pose when no name is given. */
export const removeCoords = (poses: readonly SavedPose[], names?: readonly string[]): readonly SavedPose[] =>
  names === undefined ? [] : poses.some(pose => names.includes(pose.name)) ? poses.filter(pose => !names.includes(pose.name)) : poses;

export interface CoordsChoices {
  /** How each pose after the first is reached; the first is reached by the joints, since the way there is not known. */
  readonly path: "ptp" | "lin" | "spline";
  readonly speed: Speed;
  /** Name of the tool whose tip the poses are. */
  readonly tool: string;
  readonly blend_m?: number;
}

/** One move to each pose, in their order, with ids that the program does not have. The last stops. */
export function stepsFromCoords(program: Pick<Program, "steps"> & Partial<Pick<Program, "routines">>, poses: readonly SavedPose[], { path, speed, tool, blend_m = 0 }: CoordsChoices): readonly MoveStep[] {
  const ids = freshStepIds(program, poses.length);
  return poses.map(({ name, worldFromTcp: { position, quaternion } }, i): MoveStep => ({
    id: ids[i]!, name, type: "move", path: i === 0 ? "ptp" : path, target: { pose: { position: [...position], quaternion: [...quaternion] }, frame: "world", tool },
    speed, blend_m: i === poses.length - 1 ? 0 : blend_m,
  }));
}

function freeName(poses: readonly SavedPose[], wanted: string | undefined): string {
  const taken = new Set(poses.map(pose => pose.name)), stem = wanted?.replace(/[\r\n]+/g, " ") ?? "";
  if (stem !== "" && !taken.has(stem)) return stem;
  for (let i = stem === "" ? 1 : 2; ; i++) {
    const tried = stem === "" ? `P${i}` : `${stem} ${i}`;
    if (!taken.has(tried)) return tried;
  }
}
