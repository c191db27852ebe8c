import { showAs } from "../../runtime/robot/cell-connection.ts";
import { isLive } from "../../stores/connection.ts";
import { notify } from "../../stores/notices.ts";
import { words } from "../../messages/index.ts";

/**
 * Programming begins: in the place of the twin of a connected robot stands its clone, which is moved and taught, and
 * the twin becomes a grey ghost that goes on showing where the robot is (row T-41). Nothing is sent to the robot.
 */
export function beginProgramming(): void {
  if (!isLive()) return;
  showAs("clone");
  notify("info", words.headset.cloneShown);
}
