import type { Pose, Robot } from "@twincell/core";
import { useStore } from "zustand";
import { shownRobot } from "../../runtime/robot/drawn-robots.ts";
import { connectionStore, isClone } from "../../stores/connection.ts";
import { ArmView } from "./arm-view.tsx";

/** Violet means clone, and nothing else does. */
export const CLONE = "#b38cff";

/**
 * The robot of the cell as it stands now, or as it stood when the picture was taken by which it is held back. While a
 * connected robot is programmed apart from its twin, it is the clone: a violet ghost.
 */
export function RobotView(props: { readonly robot: Robot; readonly worldFromBase: Pose<"world", "base"> }) {
  const clone = useStore(connectionStore, isClone);
  return <ArmView key={clone ? "clone" : "robot"} {...props} live={shownRobot} {...(clone ? { ghost: CLONE } : {})} />;
}
