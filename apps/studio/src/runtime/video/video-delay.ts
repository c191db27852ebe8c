import { armScratch, flangePose, identity, type Pose } from "@twincell/core";
import { cellStore } from "../../stores/cell.ts";
import { robotOf } from "../../stores/document.ts";
import { stationStore } from "../../stores/stations.ts";
import { videoStore } from "../../stores/video.ts";
import { onFrame } from "../jog/jog-frames.ts";
import { theLive } from "../live.ts";
import { poseTrail, type PoseTrail } from "../robot/pose-trail.ts";
import { showOtherInstead, showRobotInstead } from "../robot/drawn-robots.ts";
import { stationLive } from "../robot/stations.ts";
import { feedOf } from "./feeds.ts";

interface HeldArm {
  readonly q_rad: Float64Array;
  readonly baseFromFlange: Pose<"base", "flange">;
  revision: number;
  readonly trail: PoseTrail;
}

/**
 * When the picture was taken by which the twin is held back, of the page's clock [s]; null while it is not held back.
 */
export function heldAt_s(): number | null {
  const { heldBy } = videoStore.getState();
  const times = heldBy === null ? null : feedOf(heldBy)?.times;
  return times && Number.isFinite(times.captured_s) ? times.captured_s : null;
}

/**
 * Keeps what every robot looked like during the last seconds, while a camera is on, and shows it as it was when the
 * picture was taken if that is wished. Only what is drawn is held back: commands, limits, read-outs and STOP never are.
 */
export function startHoldingBack(): () => void {
  const arms = new Map<string, HeldArm>();
  const CELL = "";
  const scratch = armScratch();
  /** True when it has been brought to that moment. */
  function bring(id: string, now_s: number, q_rad: ArrayLike<number>, at_s: number | null): HeldArm | null {
    let arm = arms.get(id);
    if (arm?.q_rad.length !== q_rad.length)
      arms.set(
        id,
        (arm = {
          q_rad: new Float64Array(q_rad.length),
          baseFromFlange: identity(),
          revision: -2,
          trail: poseTrail(q_rad.length),
        }),
      );
    arm.trail.record(now_s, q_rad);
    if (at_s === null || !arm.trail.at(at_s, arm.q_rad)) return null;
    arm.revision--;
    return arm;
  }
  const letGo = (): void => {
    showRobotInstead(null);
    for (const id of arms.keys()) showOtherInstead(id, null);
    arms.clear();
  };
  const stop = onFrame(now_ms => {
    if (videoStore.getState().panels.length === 0) {
      if (arms.size > 0) letGo();
      return;
    }
    const at_s = heldAt_s();
    const now_s = now_ms / 1000;
    const live = theLive();
    const robot = robotOf(cellStore.getState().document);
    const arm = bring(CELL, now_s, live.q_rad, at_s);
    if (arm && robot?.arm.joints.length === arm.q_rad.length) {
      flangePose(robot.arm, arm.q_rad, arm.baseFromFlange, scratch);
      showRobotInstead(arm);
    } else showRobotInstead(null);
    for (const { id } of stationStore.getState().stations) {
      const station = stationLive(id);
      if (station) showOtherInstead(id, bring(id, now_s, station.q_rad, at_s));
    }
  });
  return () => {
    stop();
    letGo();
  };
}
