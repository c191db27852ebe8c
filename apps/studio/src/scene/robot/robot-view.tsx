import type { Pose, Robot } from "@twincell/core";
import { theLive } from "../../live/live.ts";
import { ArmView } from "./arm-view.tsx";

/** The robot of the cell as it stands now. */
export const RobotView = (props: { readonly robot: Robot; readonly worldFromBase: Pose<"world", "base"> }) => <ArmView {...props} live={theLive} />;
