export { mayBeRobot, robotFromFiles, type RobotRead } from "./robot-from-files.ts";
