import {
  jogScratch,
  jogStep,
  type JogBlock,
  type JogCell,
  type JogCommand,
  type Jogged,
  type Quaternion,
  type Vector3,
} from "@twincell/core";
import { cellStore } from "../../stores/cell.ts";
import { followTargetStore } from "../../stores/follow-target.ts";
import { isLive } from "../../stores/connection.ts";
import { controlStore } from "../../stores/control.ts";
import { flangeFromTcpOf, robotOf, worldFromFrameOf } from "../../stores/document.ts";
import { jogStore, type JogState } from "../../stores/jog.ts";
import { sound } from "../../stores/sound.ts";
import { words } from "../../messages/index.ts";
import { createTargetFollower } from "./follow-target.ts";
import { onFrame } from "./jog-frames.ts";
import { heldNow, MAX_COORDINATES } from "./pressed-inputs.ts";
import { moveByHand } from "./hand-motion.ts";
import { theLive } from "../live.ts";
import { jogLive } from "../robot/cell-connection.ts";
import { leaveRobot, moverNow, takeRobot } from "../robot/motion-owner.ts";

/** Manual mode: the TCP never goes faster (ISO 10218-1). */
export const MANUAL_SPEED_MPS = 0.25;
const TURN_RAD_S = (40 * Math.PI) / 180;
/** Joints jog at this part of their full speed. */
const JOINT_PART = 0.15;
/** Row N-40: time to let go after a limit was met. Nothing freezes meanwhile. */
export const LOCK_MS = 500;
/** How long the sentence stays after a stop before a contact. */
const STOPPED_MS = 2500;
/** One step of step jogging is taken in this time. */
const STEP_S = 0.12;

/** Moves the robot on screen by what is held, once a frame. */
export interface Jogger {
  /** Called once a frame; `now_ms` is the time of the page. */
  step(now_ms: number, dt_s: number): void;
}

export function createJogger(): Jogger {
  const scratch = jogScratch();
  const held = new Float64Array(MAX_COORDINATES);
  const before = new Float64Array(MAX_COORDINATES);
  const pending = new Float64Array(MAX_COORDINATES);
  const rates = new Float64Array(MAX_COORDINATES);
  const linear: Vector3 = [0, 0, 0];
  const angular: Vector3 = [0, 0, 0];
  const told = new Set<Coordinate>();
  const follower = createTargetFollower();
  let following = false;
  let q = new Float64Array(6);
  // Stopped before a contact it waits for the hand to let go: pushing on would only meet it again.
  let left_s = 0;
  let letGo = false;
  let known = "";
  let cell: JogCell | null = null;
  let document: unknown = null;

  const cellNow = (): JogCell | null => {
    const now = cellStore.getState().document;
    if (now !== document) {
      document = now;
      const robot = robotOf(now);
      cell =
        now && robot ? { robot, worldFromBase: now.robot.worldFromBase, flangeFromTcp: flangeFromTcpOf(now) } : null;
    }
    return cell;
  };

  const command = (on: JogCell, jog: JogState, want: Float64Array): JogCommand => {
    if (jog.frame === "joint") {
      for (let i = 0; i < on.robot.arm.joints.length; i++)
        rates[i] =
          want[i]! *
          (jog.manner === "steps"
            ? jog.step_rad / STEP_S
            : jog.speed * JOINT_PART * on.robot.arm.joints[i]!.limits.speed_rad_s);
      return { kind: "joints", speed_rad_s: rates };
    }
    const metres = jog.manner === "steps" ? jog.step_m / STEP_S : jog.speed * MANUAL_SPEED_MPS;
    const turn = jog.manner === "steps" ? jog.step_rad / STEP_S : jog.speed * TURN_RAD_S;
    for (let i = 0; i < 3; i++) {
      linear[i] = want[i]! * metres;
      angular[i] = want[i + 3]! * turn;
    }
    return {
      kind: "tip",
      linear_mps: linear,
      angular_rad_s: angular,
      frame: jog.frame === "user" ? userAxes(jog) : jog.frame,
    };
  };
  /** One frame in which what is held moves the target, and the arm goes after it. */
  const follow = (on: JogCell, jog: JogState, pressed: boolean, now_ms: number, dt_s: number): void => {
    const locked = jog.blocked !== null && now_ms < jog.blocked.until_ms;
    if (!pressed) {
      letGo = false;
      if (jog.blocked && !locked) jogStore.setState({ blocked: null });
    }
    const stepping = jog.manner === "steps";
    const part_s = stepping ? Math.min(dt_s, left_s) : dt_s;
    const moves = !locked && !letGo && (stepping ? left_s > 0 : pressed);
    const sentence = follower.step(on, moves ? command(on, jog, stepping ? pending : held) : null, part_s, dt_s);
    if (stepping && moves) left_s -= part_s;
    if (sentence === null) return;
    letGo = pressed;
    left_s = 0;
    jogStore.setState({ blocked: { sentence, until_ms: now_ms + STOPPED_MS } });
  };
  const userAxes = (jog: JogState): Quaternion =>
    worldFromFrameOf(cellStore.getState().document, "user", jog.userFrame).quaternion;

  return {
    step(now_ms, dt_s) {
      const pressed = heldNow(held);
      const jog = jogStore.getState();
      if (jog.moving !== pressed) jogStore.setState({ moving: pressed });
      if (isLive()) {
        jogLive(held, now_ms);
        if (jog.blocked && now_ms >= jog.blocked.until_ms) jogStore.setState({ blocked: null });
        return;
      }
      if (jog.aid !== null && pressed && (jog.frame === "joint" || held[3] !== 0 || held[4] !== 0 || held[5] !== 0))
        jogStore.setState({ aid: null });
      if (jog.manner === "steps") {
        for (let i = 0; i < MAX_COORDINATES; i++)
          if (held[i] !== 0 && before[i] === 0) {
            pending.fill(0);
            pending[i] = Math.sign(held[i]!);
            left_s = STEP_S;
          }
      }
      for (const coordinate of told) if (!stillPushed(coordinate, held, before)) told.delete(coordinate);
      before.set(held);
      const stepping = jog.manner === "steps";
      const on = cellNow();
      const locked = jog.blocked !== null && now_ms < jog.blocked.until_ms;
      const follows = followTargetStore.getState().on && jog.frame !== "joint";
      if (follows && !following) follower.begin();
      following = follows;
      if (follows && on && dt_s > 0 && !controlStore.getState().running) {
        follow(on, jog, pressed, now_ms, dt_s);
        return;
      }
      if (!pressed && !(stepping && left_s > 0)) {
        if (moverNow() === "jog") leaveRobot("jog");
        known = "";
        letGo = false;
        told.clear();
        if (jog.blocked && !locked) jogStore.setState({ blocked: null });
        return;
      }
      if (!on || locked || letGo || dt_s <= 0 || (stepping && left_s <= 0)) return;
      if (controlStore.getState().running) {
        if (known !== "busy") {
          known = "busy";
          sound("limit");
          jogStore.setState({ blocked: { sentence: words.jog.busy, until_ms: now_ms + LOCK_MS } });
        }
        return;
      }
      takeRobot("jog");
      const part_s = stepping ? Math.min(dt_s, left_s) : dt_s;
      if (q.length !== theLive().q_rad.length) q = new Float64Array(theLive().q_rad.length);
      q.set(theLive().q_rad);
      const done = jogStep(on, q, command(on, jog, stepping ? pending : held), part_s, q, scratch);
      if (stepping) left_s = done.kind === "blocked" ? 0 : left_s - part_s;
      const met = done.kind === "moved" ? moveByHand(q) : null;
      if (met?.kind === "stopped") {
        letGo = true;
        left_s = 0;
        jogStore.setState({ blocked: { sentence: met.sentence, until_ms: now_ms + STOPPED_MS } });
        return;
      }
      known = tell(done, known, told, now_ms);
    },
  };
}

type Coordinate = JogBlock["coordinate"];
const AXES: readonly Coordinate[] = ["x", "y", "z"];

/** Whether the push that met a limit goes on: in the same direction, without having been let go. */
function stillPushed(coordinate: Coordinate, held: Float64Array, before: Float64Array): boolean {
  if (coordinate === "rotation") return [3, 4, 5].every(i => Math.sign(held[i]!) === Math.sign(before[i]!));
  const i = typeof coordinate === "number" ? coordinate - 1 : AXES.indexOf(coordinate);
  return Math.sign(held[i]!) === Math.sign(before[i]!);
}

/**
 * The first time a push meets a limit: sound, 500 ms, and which joint and limit. Held on, it stays blocked silently,
 * also where a longer or shorter frame lets it creep on for a moment.
 *
 * @param known  what stood in the panel before.
 * @param told   coordinates whose push has been told of.
 * @returns what stands in the panel now.
 */
function tell(done: Jogged, known: string, told: Set<Coordinate>, now_ms: number): string {
  const [first] = done.blocked;
  if (!first) {
    if (known !== "") jogStore.setState({ blocked: null });
    return "";
  }
  const now = done.blocked.map(block => String(block.coordinate)).join();
  const fresh = done.blocked.some(block => !told.has(block.coordinate));
  if (fresh) {
    for (const { coordinate } of done.blocked) told.add(coordinate);
    sound("limit");
  }
  if (now !== known || fresh) jogStore.setState({ blocked: blockedState(first, fresh ? now_ms + LOCK_MS : now_ms) });
  return now;
}
function blockedState({ reach, sentence }: JogBlock, until_ms: number): NonNullable<JogState["blocked"]> {
  return reach.kind === "outside-limits" ? { sentence, joint: reach.joint, until_ms } : { sentence, until_ms };
}

export function startJogging(): () => void {
  const jogger = createJogger();
  return onFrame((now_ms, dt_s) => jogger.step(now_ms, dt_s));
}
