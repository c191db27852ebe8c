import { identity, compose, type Pose, type SavedPose } from "@twincell/core";
import type { CellDocument, FrameRecord } from "./document.ts";

/** A frame whose name begins like this is a saved pose: where a tool tip was, not what targets count from. */
const PREFIX = "pose/";

/** The saved poses of a cell, in their order. A cell keeps them among its frames. */
export const savedPosesOf = ({ frames }: Pick<CellDocument, "frames">): readonly SavedPose[] =>
  frames.flatMap(({ name, worldFromFrame }) => name.startsWith(PREFIX) ? [{ name: name.slice(PREFIX.length), worldFromTcp: compose(worldFromFrame, identity<"frame", "tcp">()) }] : []);

/** The cell with these saved poses instead of those it had; its other frames stay. Undo is the history of the document. */
export function withSavedPoses(document: CellDocument, poses: readonly SavedPose[]): CellDocument {
  const others = document.frames.filter(({ name }) => !name.startsWith(PREFIX));
  return { ...document, frames: [...others, ...poses.map(recordOf)] };
}

const recordOf = ({ name, worldFromTcp }: SavedPose): FrameRecord => ({ name: `${PREFIX}${name}`, worldFromFrame: frameAt(worldFromTcp) });
const frameAt = (worldFromTcp: Pose<"world", "tcp">): Pose<"world", "frame"> => compose(worldFromTcp, identity<"tcp", "frame">());
