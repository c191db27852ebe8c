import { armScratch, compose, flangePose, identity, type Pose } from "@twincell/core";
import { cellStore } from "../../stores/cell.ts";
import { flangeFromTcpOf, robotOf } from "../../stores/document.ts";
import { followPoses } from "../live.ts";

/** Keeps the poses of `live` in step with the document: another robot, another place, another tool. */
export function startFollowing(): () => void {
  const scratch = armScratch();
  const worldFromFlange = identity<"world", "flange">();
  let robotId = "";
  let toolPose: Pose<"flange", "tcp"> | null = null;
  let basePose: Pose<"world", "base"> | null = null;
  const follow = (): void => {
    const { document } = cellStore.getState();
    const robot = robotOf(document);
    if (!document || !robot) return;
    const flangeFromTcp = flangeFromTcpOf(document);
    const { worldFromBase } = document.robot;
    if (robot.id === robotId && flangeFromTcp === toolPose && worldFromBase === basePose) return;
    const another = robot.id !== robotId;
    robotId = robot.id;
    toolPose = flangeFromTcp;
    basePose = worldFromBase;
    followPoses(
      robot,
      {
        flange: (q_rad, out) => {
          flangePose(robot.arm, q_rad, out, scratch);
        },
        tcp: (baseFromFlange, out) => {
          compose(compose(worldFromBase, baseFromFlange, worldFromFlange), flangeFromTcp, out);
        },
        // Row N-69: the program starts at Do Ready.
      },
      another,
    );
  };
  follow();
  return cellStore.subscribe(follow);
}
