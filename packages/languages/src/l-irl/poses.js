import { identity } from "@twincell/core";
import { readPoseList } from "./read/list.ts";
import { headerLine, poseNumbers, quoted } from "./write.ts";
/** Named poses as a list, counted from the world. Names may hold every character but the ends of lines, which become blanks. */
export const savePoses = (poses) => [headerLine("WORLD"), ...poses.map(({ name, worldFromTcp }) => `POSE ${quoted(name.replace(/[\r\n]+/g, " "))} ${poseNumbers(worldFromTcp)}`)].map(line => `${line}\n`).join("");
/** The named poses of any list, rows without a name as P1, P2 and so on; its motions are passed over. `worldFromBase` counts for lists from the BASE. */
export function loadPoses(text, worldFromBase = identity()) {
    const read = readPoseList(text, undefined, worldFromBase);
    if (read.kind === "not-understood")
        return read;
    return { kind: "poses", poses: Array.from(read.list.poses, ([name, { worldFromTcp }]) => ({ name, worldFromTcp })) };
}
