export { mayBeRobot, robotFromFiles, type RobotRead } from "./robot-from-files.ts";
export { robotFromRig, sameAxis, type Rig, type Rigged, type RigJoint, type RigPart } from "./rig.ts";
export { urdfFolder, type FolderFile } from "./urdf-files.ts";
