import type { Pose } from "@twincell/core";
import { Matrix4, Vector3 } from "three";
import type { ControllerUse } from "../../stores/headset.ts";
import { matrixPose } from "../pose-matrix.ts";
import { takesWith, triggerHeld } from "./controller-input.ts";

/** Fingers nearer than this hold; farther than that let go: between the two nothing changes. */
const PINCH_CLOSED_M = 0.022;
const PINCH_OPEN_M = 0.04;
/** How near to the tool tip a hand must be to take the ring, and how near a ray must pass. */
export const GRAB_NEAR_M = 0.2;
export const RAY_NEAR_M = 0.11;

const place = new Matrix4();
const thumb = new Vector3();
const index = new Vector3();

/** What one hand does in this frame. Written in place. */
export interface HandState {
  /** What carries: the grip of a controller, the wrist of a bare hand, which closing the fingers does not move. */
  readonly worldFromHand: Pose<"world", "hand">;
  /** Where it takes hold: at the grip, or between thumb and index. */
  readonly holds: Pose<"world", "hand">["position"];
  /** Place and way of the pointing ray. */
  readonly worldFromRay: Pose<"world", "hand">;
  tracked: boolean;
  /** Its position was measured once, not guessed from how an arm is built. */
  measured: boolean;
  squeezing: boolean;
  pointing: boolean;
  /** It is there only while fingers are pinched, with the ray of the eyes: what it takes goes with the hand. */
  transient: boolean;
  /** Frames since it came. */
  age: number;
}
export const handState = (): HandState => ({
  worldFromHand: { position: [0, 0, 0], quaternion: [0, 0, 0, 1] },
  holds: [0, 0, 0],
  worldFromRay: { position: [0, 0, 0], quaternion: [0, 0, 0, 1] },
  tracked: false,
  measured: false,
  squeezing: false,
  pointing: false,
  transient: false,
  age: 0,
});

/** How the room that the headset counts in lies in the scene, and the scene in the z-up world. */
export interface Room {
  readonly sceneFromRoom: Matrix4;
  readonly worldFromScene: Matrix4;
}

function intoWorld(transform: XRRigidTransform, room: Room, out: Pose<"world", "hand">): void {
  place.fromArray(transform.matrix).premultiply(room.sceneFromRoom).premultiply(room.worldFromScene);
  matrixPose(place, out);
}

/** Reads one input source. A hand that is not tracked keeps its last place and holds what it holds. */
export function readHand(
  source: XRInputSource,
  frame: XRFrame,
  space: XRReferenceSpace,
  room: Room,
  use: ControllerUse,
  out: HandState,
): void {
  out.age++;
  const ray = frame.getPose(source.targetRaySpace, space);
  if (ray) intoWorld(ray.transform, room, out.worldFromRay);
  if (source.hand) {
    readFingers(source.hand, frame, space, room, out);
    return;
  }
  if (source.targetRayMode === "transient-pointer") {
    readPinch(source, frame, space, room, out);
    return;
  }
  const grip = source.gripSpace ? frame.getPose(source.gripSpace, space) : undefined;
  // One that was measured and now is guessed is out of sight; one that is never measured has only its guess.
  if (grip?.emulatedPosition === false) out.measured = true;
  out.tracked = grip ? !grip.emulatedPosition || !out.measured : false;
  if (grip && out.tracked) {
    intoWorld(grip.transform, room, out.worldFromHand);
    for (let k = 0; k < 3; k++) out.holds[k] = out.worldFromHand.position[k]!;
  }
  const { gamepad } = source;
  out.squeezing = gamepad ? takesWith(gamepad, use) : false;
  out.pointing = gamepad ? triggerHeld(gamepad) : false;
}

/** Panels learn of a ray that is new only in the next frame: until then it takes nothing behind them. */
const KNOWN_AFTER = 3;

/** Eyes choose, a pinch takes, the hand carries (Vision Pro): the source is there as long as the pinch is. */
function readPinch(source: XRInputSource, frame: XRFrame, space: XRReferenceSpace, room: Room, out: HandState): void {
  const grip = source.gripSpace ? frame.getPose(source.gripSpace, space) : undefined;
  out.transient = true;
  out.tracked = grip !== undefined && grip !== null;
  if (grip) {
    intoWorld(grip.transform, room, out.worldFromHand);
    for (let k = 0; k < 3; k++) out.holds[k] = out.worldFromHand.position[k]!;
  }
  out.squeezing = false;
  out.pointing = out.age >= KNOWN_AFTER;
}

/** Takes hold between thumb and index and carries with the wrist. */
function readFingers(hand: XRHand, frame: XRFrame, space: XRReferenceSpace, room: Room, out: HandState): void {
  const thumbTip = joint(hand, "thumb-tip", frame, space);
  const indexTip = joint(hand, "index-finger-tip", frame, space);
  const wrist = joint(hand, "wrist", frame, space);
  out.tracked = thumbTip !== undefined && indexTip !== undefined && wrist !== undefined;
  out.pointing = false;
  if (!thumbTip || !indexTip || !wrist) return;
  const a = thumbTip.transform.position;
  const b = indexTip.transform.position;
  thumb.set(a.x, a.y, a.z);
  index.set(b.x, b.y, b.z);
  const gap = thumb.distanceTo(index);
  out.squeezing = out.squeezing ? gap < PINCH_OPEN_M : gap < PINCH_CLOSED_M;
  intoWorld(wrist.transform, room, out.worldFromHand);
  thumb.add(index).multiplyScalar(0.5).applyMatrix4(room.sceneFromRoom).applyMatrix4(room.worldFromScene);
  out.holds[0] = thumb.x;
  out.holds[1] = thumb.y;
  out.holds[2] = thumb.z;
}
function joint(hand: XRHand, name: XRHandJoint, frame: XRFrame, space: XRReferenceSpace): XRJointPose | undefined {
  const at = hand.get(name);
  return at ? frame.getJointPose?.(at, space) : undefined;
}

/** How far the ray of a hand passes by a point [m]; infinite behind it. */
export function rayMisses(worldFromRay: Pose<"world", "hand">, point: readonly [number, number, number]): number {
  const [x, y, z, w] = worldFromRay.quaternion;
  const [ox, oy, oz] = worldFromRay.position;
  // The ray looks along −z of its own frame.
  const dx = -2 * (x * z + w * y);
  const dy = -2 * (y * z - w * x);
  const dz = -(1 - 2 * (x * x + y * y));
  const px = point[0] - ox;
  const py = point[1] - oy;
  const pz = point[2] - oz;
  const along = px * dx + py * dy + pz * dz;
  if (along <= 0) return Infinity;
  const x_m = px - along * dx;
  const y_m = py - along * dy;
  const z_m = pz - along * dz;
  return Math.sqrt(x_m * x_m + y_m * y_m + z_m * z_m);
}
