import {
  addScaled,
  copyPose,
  distance,
  followScratch,
  followTarget,
  fromAxisAngle,
  identity,
  multiply,
  norm,
  normalizeQuaternion,
  rotate,
  type FollowScratch,
  type JogCell,
  type JogCommand,
  type Pose,
  type Quaternion,
  type Robot,
  type Vector3,
} from "@twincell/core";
import { tellFollowing } from "../../stores/follow-target.ts";
import { theLive } from "../live.ts";
import { leaveRobot, moverNow, takeRobot } from "../robot/motion-owner.ts";
import { moveByHand } from "./hand-motion.ts";

/** A joint that turns less than this in a frame stands [rad]. */
const STANDS_RAD = 1e-9;
/** A joint that somebody else moved further than this makes the sphere begin anew at the tool [rad]. */
const ELSEWHERE_RAD = 1e-9;

const target: Pose<"world", "tcp"> = identity();
let revision = 0;
/** Where the sphere is, and a count of its changes; written in place. */
export const theTarget = (): Readonly<Pose<"world", "tcp">> => target;
export const targetRevision = (): number => revision;

export interface TargetFollower {
  /**
   * One frame: the sphere goes as it is told, the arm goes after it as fast as its joints may.
   *
   * @param command  null while nothing is held.
   * @returns a sentence where the arm stopped before a contact; the sphere is then back at the tool.
   */
  step(cell: JogCell, command: JogCommand | null, moved_s: number, dt_s: number): string | null;
  /** The sphere is put to the tool before the next frame. */
  begin(): void;
}

export function createTargetFollower(): TargetFollower {
  let scratch: FollowScratch | null = null;
  let known: Robot | null = null;
  let q = new Float64Array(0);
  let out = new Float64Array(0);
  let fresh = true;
  const linear: Vector3 = [0, 0, 0];
  const angular: Vector3 = [0, 0, 0];
  const turn: Quaternion = [0, 0, 0, 1];

  const atTool = (): void => {
    copyPose(theLive().worldFromTcp, target);
    revision++;
    q.set(theLive().q_rad);
    fresh = false;
  };
  const elsewhere = (): boolean => {
    const now = theLive().q_rad;
    for (let j = 0; j < q.length; j++) if (Math.abs(now[j]! - q[j]!) > ELSEWHERE_RAD) return true;
    return false;
  };

  return {
    begin() {
      fresh = true;
    },
    step(cell, command, moved_s, dt_s) {
      const { robot } = cell;
      if (known !== robot || q.length !== theLive().q_rad.length) {
        known = robot;
        scratch = followScratch(robot);
        q = new Float64Array(robot.arm.joints.length);
        out = q.slice();
        fresh = true;
      }
      const mover = moverNow();
      if (fresh || (mover !== null && mover !== "jog") || elsewhere()) atTool();
      // What is held takes the robot from whoever has it, as jogging does.
      if (mover !== null && mover !== "jog" && command === null) return null;
      if (command?.kind === "tip") {
        const axes = axesOf(cell, command.frame);
        rotate(axes, command.linear_mps, linear);
        rotate(axes, command.angular_rad_s, angular);
        addScaled(target.position, linear, moved_s, target.position);
        const rate = norm(angular);
        if (rate > 0) {
          fromAxisAngle([angular[0] / rate, angular[1] / rate, angular[2] / rate], rate * moved_s, turn);
          normalizeQuaternion(multiply(turn, target.quaternion), target.quaternion);
        }
        revision++;
      }
      const followed = followTarget(cell, target, q, dt_s, out, scratch!);
      let most = 0;
      for (let j = 0; j < out.length; j++) most = Math.max(most, Math.abs(out[j]! - q[j]!));
      if (most > STANDS_RAD) {
        takeRobot("jog");
        const met = moveByHand(out);
        q.set(theLive().q_rad);
        if (met.kind === "stopped") {
          fresh = true;
          leaveRobot("jog");
          return met.sentence;
        }
      } else if (command === null) leaveRobot("jog");
      tellFollowing({
        kind: followed.kind,
        off_m: distance(target.position, theLive().worldFromTcp.position),
        joint: followed.kind === "behind" ? followed.joint : null,
        why: followed.kind === "out-of-reach" ? followed.sentence : null,
      });
      return null;
    },
  };
}

const WORLD: Quaternion = [0, 0, 0, 1];
function axesOf(cell: JogCell, frame: "world" | "base" | "tool" | Quaternion): Quaternion {
  if (frame === "world") return WORLD;
  if (frame === "base") return cell.worldFromBase.quaternion;
  return frame === "tool" ? target.quaternion : frame;
}
