import { identity, type Pose, type TextFault } from "@twincell/core";
import { readPoseList } from "./read/list.ts";
import { headerLine, poseNumbers, quoted } from "./write.ts";

/** A pose of the tool tip that a person keeps under a name. Nothing asks whether a robot reaches it. */
export interface SavedPose {
  readonly name: string;
  readonly worldFromTcp: Pose<"world", "tcp">;
}

export type LoadedPoses =
  | { readonly kind: "poses"; readonly poses: readonly SavedPose[] }
  | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] };

/**
 * Named poses as a list, counted from the world. Names may hold every character but the ends of lines, which become
 * blanks.
 */
export const savePoses = (poses: readonly SavedPose[]): string =>
  [
    headerLine("WORLD"),
    ...poses.map(
      ({ name, worldFromTcp }) => `POSE ${quoted(name.replace(/[\r\n]+/g, " "))} ${poseNumbers(worldFromTcp)}`,
    ),
  ]
    .map(line => `${line}\n`)
    .join("");

/**
 * The named poses of any list, rows without a name as P1, P2 and so on; its motions are passed over. `worldFromBase`
 * counts for lists from the BASE.
 */
export function loadPoses(text: string, worldFromBase: Pose<"world", "base"> = identity()): LoadedPoses {
  const read = readPoseList(text, undefined, worldFromBase);
  if (read.kind === "not-understood") return read;
  return { kind: "poses", poses: Array.from(read.list.poses, ([name, { worldFromTcp }]) => ({ name, worldFromTcp })) };
}
