import { armScratch, compose, flangePose, identity, readyPosture, type Pose } from "@twincell/core";
import { isTextProgram, type CellDocument } from "@twincell/project";
import { cellStore } from "../../stores/cell.ts";
import { flangeFromTcpOf, robotOf } from "../../stores/document.ts";
import { libraryStore } from "../../stores/library.ts";
import { followPoses, showJoints } from "../live.ts";

/** Nothing is taught and nothing stands in the cell yet. */
const isBare = ({ programs, objects }: CellDocument): boolean =>
  objects.length === 0 && programs.every(program => !isTextProgram(program) && program.steps.length === 0);

/** Keeps the poses of `live` in step with the document: another robot, another place, another tool. */
export function startFollowing(): () => void {
  const scratch = armScratch();
  const worldFromFlange = identity<"world", "flange">();
  let robotId = "";
  let cellId = "";
  let toolPose: Pose<"flange", "tcp"> | null = null;
  let basePose: Pose<"world", "base"> | null = null;
  const follow = (): void => {
    const { document } = cellStore.getState();
    const robot = robotOf(document);
    if (!document || !robot) return;
    const flangeFromTcp = flangeFromTcpOf(document);
    const { worldFromBase } = document.robot;
    const { current } = libraryStore.getState();
    if (current === cellId && robot.id === robotId && flangeFromTcp === toolPose && worldFromBase === basePose) return;
    const another = robot.id !== robotId || (current !== cellId && isBare(document));
    cellId = current;
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
      },
      another,
    );
    // Row N-69: a robot starts at home, Do Ready. A stretched arm cannot go down, though, and says nothing of what it
    // reaches: in a cell without anything it stands bent.
    if (another && isBare(document)) showJoints(readyPosture(robot));
  };
  follow();
  return cellStore.subscribe(follow);
}
