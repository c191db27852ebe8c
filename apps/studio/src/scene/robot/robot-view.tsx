import type { Pose, Robot } from "@twincell/core";
import { shownRobot } from "../../runtime/robot/drawn-robots.ts";
import { ArmView } from "./arm-view.tsx";

/** The robot of the cell as it stands now, or as it stood when the picture was taken by which it is held back. */
export const RobotView = (props: { readonly robot: Robot; readonly worldFromBase: Pose<"world", "base"> }) => (
  <ArmView {...props} live={shownRobot} />
);
