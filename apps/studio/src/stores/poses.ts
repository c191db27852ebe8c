import { loadPoses, savePoses } from "@twincell/languages";
import { addCoords, editCoords, removeCoords, savedCoords, trajectoryThroughCoords } from "@twincell/project";
import type { Pose } from "@twincell/core";
import { words } from "../messages/index.ts";
import { cellStore } from "./cell.ts";
import { commit } from "./document.ts";

/** Rows L-44 to L-49: poses of the tool tip that a person keeps, as frames of the cell. Each is one step of undo. */
export const keepPose = (worldFromTcp: Pose<"world", "tcp">): boolean =>
  commit(words.poses.add, cell => addCoords(cell, worldFromTcp));
export const movePose = (name: string, worldFromTcp: Pose<"world", "tcp">): boolean =>
  commit(words.poses.put(name), cell => editCoords(cell, name, worldFromTcp));
export const forgetPoses = (): boolean => commit(words.poses.remove, removeCoords);
/** The program goes on through all of them. */
export const movesThroughPoses = (): boolean =>
  commit(words.poses.through, cell =>
    trajectoryThroughCoords(
      cell,
      savedCoords(cell).map(({ name }) => name),
    ),
  );

/** The poses as a text that `readPoses` takes. */
export function posesText(): string {
  const { document } = cellStore.getState();
  return savePoses(
    (document === null ? [] : savedCoords(document)).map(({ name, worldFromFrame: { position, quaternion } }) => ({
      name,
      worldFromTcp: { position, quaternion },
    })),
  );
}

/** The poses of a text beside those that are there. Answers with the first fault, or with how many came. */
export function readPoses(
  text: string,
): { readonly kind: "read"; readonly count: number } | { readonly kind: "not-understood"; readonly sentence: string } {
  const { document } = cellStore.getState();
  const loaded = loadPoses(text, document?.robot.worldFromBase);
  if (loaded.kind === "not-understood") {
    const [fault] = loaded.faults;
    return {
      kind: "not-understood",
      sentence:
        fault === undefined ? words.run.notUnderstood : words.export.line(fault.line, fault.column, fault.sentence),
    };
  }
  commit(words.poses.load, cell =>
    loaded.poses.reduce((so, { name, worldFromTcp }) => addCoords(so, worldFromTcp, name), cell),
  );
  return { kind: "read", count: loaded.poses.length };
}
