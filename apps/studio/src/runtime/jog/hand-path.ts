import {
  angleBetween,
  copyPose,
  distance,
  freshGroupIds,
  freshStepIds,
  identity,
  type MoveStep,
  type Speed,
} from "@twincell/core";
import { cellStore } from "../../stores/cell.ts";
import { theProgram } from "../../stores/document.ts";
import { notify } from "../../stores/notices.ts";
import { addSteps } from "../../stores/program.ts";
import { RECORD_EVERY_M, RECORD_EVERY_RAD, recordMoving, recordStore } from "../../stores/record.ts";
import { words } from "../../messages/index.ts";
import { onFrame } from "./jog-frames.ts";
import { MAX_COORDINATES } from "./pressed-inputs.ts";
import { theLive } from "../live.ts";
import { moverNow } from "../robot/motion-owner.ts";

/** One stroke of the hand holds at most this many points; then recording ends and says so. */
export const MAX_POINTS = 2000;
/** A headset may draw 120 times a second; points do not come faster than this. */
const LEAST_GAP_MS = 10;
/** Points are passed, not stopped at; the corner this cuts is half of what may be missed between two points. */
const PASS_M = RECORD_EVERY_M / 2;
/** Below this change of a joint two postures are the same point [rad]. */
const SAME_RAD = 1e-7;
/**
 * Replayed as fast as the hand went, within these bounds: a hand that hesitates does not make a program that crawls.
 */
const SLOWEST_MPS = 0.01;
const FASTEST_MPS = 0.25;
/** Where the tool only turns, one radian counts as this much path [m/rad], as in the planner. */
const TURN_M = 0.1;

/**
 * Records the way of the hand while it jogs or drags (row N-57): the posture it began at, a point for every
 * `RECORD_EVERY_M` or `RECORD_EVERY_RAD`, and the posture it let go at. A stroke goes to the program when the hand lets
 * go; all strokes until recording is switched off are one group and one undo step. Allocates nothing while the hand
 * moves.
 */
export function startHandPath(): () => void {
  const stroke = new Float64Array(MAX_COORDINATES * MAX_POINTS);
  const standing = new Float64Array(MAX_COORDINATES);
  const last = identity<"world", "tcp">();
  const before = identity<"world", "tcp">();
  /**
   * `ended`: points of the stroke before, whose last still stands in `stroke`; 0 before the first of this recording.
   */
  let count = 0;
  let ended = 0;
  let way_m = 0;
  let began_ms = 0;
  let at_ms = 0;
  let revision = -1;
  let group = "";
  let session = 0;
  let goesOn = false;
  let joints = theLive().q_rad.length;

  const keep = (q: Float64Array, now_ms: number): void => {
    for (let i = 0; i < joints; i++) stroke[joints * count + i] = q[i]!;
    count++;
    copyPose(theLive().worldFromTcp, last);
    at_ms = now_ms;
  };
  /** Whether a joint is further than this from the last point. */
  const turned = (q: Float64Array, by_rad: number): boolean => {
    for (let i = 0; i < joints; i++) if (Math.abs(q[i]! - stroke[joints * (count - 1) + i]!) >= by_rad) return true;
    return false;
  };
  /**
   * The stroke ends at q and goes to the program; one that goes on where the last ended leaves out the point they
   * share.
   */
  const finish = (now_ms: number, q: Float64Array): void => {
    if (turned(q, SAME_RAD)) keep(q, now_ms);
    const took_s = (now_ms - began_ms) / 1000;
    const mps = Math.min(FASTEST_MPS, Math.max(SLOWEST_MPS, took_s > 0 ? way_m / took_s : SLOWEST_MPS));
    const program = theProgram();
    if (program) group ||= freshGroupIds(program, 1, "path-")[0]!;
    const first = goesOn ? 1 : 0;
    if (
      count > 1 &&
      addStroke(
        stroke.subarray(joints * first, joints * count),
        joints,
        group,
        { mps: Math.round(mps * 1000) / 1000 },
        `record path ${session}`,
      )
    ) {
      notify("done", words.jog.pathRecorded(count - first));
    }
    ended = count;
    count = 0;
  };

  const leave = onFrame(now_ms => {
    // Another robot begins anew.
    if (theLive().q_rad.length !== joints) {
      joints = theLive().q_rad.length;
      count = ended = 0;
      revision = -1;
    }
    const live = theLive();
    const mover = moverNow();
    const byHand = recordStore.getState().moving && (mover === "jog" || mover === "drag");
    if (!byHand) {
      if (count > 0) finish(now_ms, standing);
      if (revision !== live.revision) {
        standing.set(live.q_rad);
        copyPose(live.worldFromTcp, before);
        revision = live.revision;
      }
      return;
    }
    if (revision === live.revision) return;
    revision = live.revision;
    if (count === 0) {
      count = ended;
      goesOn =
        ended > 0 && !turned(standing, SAME_RAD) && theProgram()?.steps.some(step => step.group === group) === true;
      stroke.set(standing);
      count = 1;
      way_m = 0;
      began_ms = now_ms;
      at_ms = -Infinity;
      copyPose(before, last);
    }
    way_m += Math.max(
      distance(before.position, live.worldFromTcp.position),
      TURN_M * angleBetween(before.quaternion, live.worldFromTcp.quaternion),
    );
    copyPose(live.worldFromTcp, before);
    standing.set(live.q_rad);
    if (now_ms - at_ms < LEAST_GAP_MS) return;
    const far =
      distance(last.position, before.position) >= RECORD_EVERY_M ||
      angleBetween(last.quaternion, before.quaternion) >= RECORD_EVERY_RAD ||
      turned(live.q_rad, RECORD_EVERY_RAD);
    if (!far) return;
    if (count === MAX_POINTS - 1) {
      finish(now_ms, live.q_rad);
      recordMoving(false);
      notify("warn", words.jog.pathFull(MAX_POINTS), words.jog.pathFullHint);
      return;
    }
    keep(live.q_rad, now_ms);
  });
  const off = recordStore.subscribe(({ moving }, { moving: was }) => {
    if (moving && !was) {
      group = "";
      session++;
      ended = 0;
    }
  });
  return () => {
    leave();
    off();
  };
}

/** Adds a stroke to the program: PTP between its points, passing all but the last. */
function addStroke(stroke: Float64Array, joints: number, group: string, speed: Speed, gesture: string): boolean {
  const tool = cellStore.getState().document?.tool ?? "flange";
  const count = stroke.length / joints;
  return addSteps(
    words.undo.recordPath,
    program =>
      freshStepIds(program, count, "p").map((id, i): MoveStep => {
        const q = Array.from(stroke.subarray(joints * i, joints * (i + 1)));
        return {
          id,
          type: "move",
          group,
          path: "ptp",
          target: tool === "flange" ? { q } : { q, tool },
          speed,
          blend_m: i === count - 1 ? 0 : PASS_M,
        };
      }),
    program =>
      Object.hasOwn(program.groups, group)
        ? program
        : { ...program, groups: { ...program.groups, [group]: { name: words.jog.pathGroup } } },
    gesture,
  );
}
