import { ownRobotFile, type Robot } from "@twincell/core";
import { twoFingerTree } from "@twincell/project";
import { ownFileOf, type KeptRobotFile } from "../stores/own-robots.ts";
import { download } from "../ui/download.ts";

/** No file says when it was made: the same robot is the same archive. 1980 is where the format begins to count. */
const EPOCH = new Date(1980, 0, 1);

/** A robot as a URDF with its meshes, in a ZIP that ROS, other simulators and this studio open. */
export async function saveUrdf(robot: Robot): Promise<void> {
  const [{ urdfFolder }, { strToU8, zipSync }] = await Promise.all([import("@twincell/formats"), import("fflate")]);
  const { name, files } = urdfFolder(robot);
  const packed = zipSync(
    Object.fromEntries(
      files.map(({ path, content }) => [path, typeof content === "string" ? strToU8(content) : content]),
    ),
    { level: 6, mtime: EPOCH },
  ) as Uint8Array<ArrayBuffer>;
  download(`${name}.urdf.zip`, new Blob([packed], { type: "application/zip" }));
}

/** The two fingers of the library as a URDF whose five other joints mimic the driven one (row X-05). */
export async function saveGripperUrdf(): Promise<void> {
  const { writeUrdfTree } = await import("@twincell/formats");
  const tree = twoFingerTree();
  download(`${tree.name}.urdf`, new Blob([writeUrdfTree(tree)], { type: "application/xml" }));
}

/** A robot as a robot file (docs/add-a-robot.md). */
export function saveRobotFile(file: KeptRobotFile, { name }: Robot): void {
  const stem = name.replace(/[^\p{L}\p{N}_.-]+/gu, "_") || "robot";
  download(`${stem}.robot.json`, new Blob([`${JSON.stringify(file, null, 1)}\n`], { type: "application/json" }));
}

/** The file of a robot: the one it came from, else one that is written now. */
export const robotFileFor = (robot: Robot): KeptRobotFile => ownFileOf(robot.id) ?? ownRobotFile(robot);
