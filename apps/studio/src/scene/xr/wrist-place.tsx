import { useXR, useXRInputSourceState } from "@react-three/xr";
import { useFrame } from "@react-three/fiber";
import { useRef, useState } from "react";
import { type Group, Matrix4, Quaternion, Vector3 } from "three";
import { useStore } from "zustand";
import { headsetStore } from "../../stores/headset.ts";
import type { KeyAim } from "./grabber.ts";
import { WristPanel } from "./wrist-panel.tsx";

/** The foot of the plate over the hand, and over the wrist of a bare hand [m]. */
const ABOVE_M = 0.055;
/** A bare palm is up when its normal rises this much; a controller is laid by when its palm side looks down so far. */
const PALM_UP = 0.25;
const CONTROLLER_DOWN = -0.6;
/** Once shown it stays until the hand has clearly turned. */
const HYSTERESIS = 0.2;
const UP = new Vector3(0, 1, 0);

/** Where the plate stands for who uses one hand, or has no such hand [m]; turned to the eyes as well. */
const STANDS_AT = [-0.42, 1.02, -0.52] as const;
const STANDS_SCALE = 1.5;

/**
 * The plate rides over the hand that wears it and is turned to the eyes; it is there while the palm is turned up. Who
 * uses one hand finds it standing beside.
 */
export function WristPlace({ keys }: { readonly keys: KeyAim }) {
  const wrist = useStore(headsetStore, state => state.wrist);
  const inside = useXR(state => state.session !== undefined);
  const side = wrist === "stand" ? "left" : wrist;
  const controller = useXRInputSourceState("controller", side);
  const hand = useXRInputSourceState("hand", side);
  const group = useRef<Group>(null);
  const [shown, setShown] = useState(true);
  const worn = wrist !== "stand" && (controller ?? hand) !== undefined;
  useFrame(({ gl, camera }, _dt, frame: XRFrame | undefined) => {
    const at = group.current;
    const space = gl.xr.getReferenceSpace();
    if (!at?.parent || !space || !frame) return;
    // The camera of the page rides on the place where the person stands: the eyes in room coordinates.
    eye.setFromMatrixPosition(camera.matrixWorld).applyMatrix4(roomFromScene.copy(at.parent.matrixWorld).invert());
    if (!worn) {
      at.position.set(...STANDS_AT);
      at.scale.setScalar(STANDS_SCALE);
      faceTo(at);
      if (!shown) setShown(true);
      return;
    }
    const palm = controller
      ? palmOfController(controller.inputSource, frame, space)
      : palmOfHand(hand!.inputSource, frame, space);
    if (!palm) return;
    at.position.copy(place).addScaledVector(UP, ABOVE_M);
    at.scale.setScalar(1);
    faceTo(at);
    const least = controller ? CONTROLLER_DOWN : PALM_UP;
    const next = shown ? normal.y > least - HYSTERESIS : normal.y > least;
    if (next !== shown) setShown(next);
  }, -20);
  if (!inside) return null;
  return (
    <group ref={group} name="wrist-panel" visible={shown}>
      <WristPanel keys={keys} wearer={worn ? side : "none"} shown={shown} />
    </group>
  );

  function palmOfController(source: XRInputSource, frame: XRFrame, space: XRReferenceSpace): boolean {
    const grip = source.gripSpace ? frame.getPose(source.gripSpace, space) : undefined;
    if (!grip) return false;
    const { position, orientation } = grip.transform;
    place.set(position.x, position.y, position.z).addScaledVector(UP, 0.04);
    // The x axis of a grip leaves the left palm and enters the right one.
    normal
      .set(side === "left" ? 1 : -1, 0, 0)
      .applyQuaternion(turn.set(orientation.x, orientation.y, orientation.z, orientation.w));
    return true;
  }
  function palmOfHand(source: XRInputSource, frame: XRFrame, space: XRReferenceSpace): boolean {
    const joint = source.hand?.get("wrist");
    const wristPose = joint ? frame.getJointPose?.(joint, space) : undefined;
    if (!wristPose) return false;
    const { position, orientation } = wristPose.transform;
    place.set(position.x, position.y, position.z);
    // The y axis of a joint leaves the back of the hand.
    normal.set(0, -1, 0).applyQuaternion(turn.set(orientation.x, orientation.y, orientation.z, orientation.w));
    return true;
  }
}

const eye = new Vector3();
const place = new Vector3();
const normal = new Vector3();
const turn = new Quaternion();
const roomFromScene = new Matrix4();
const look = new Matrix4();

/** Turns it squarely to the eyes, upright. */
function faceTo(at: Group): void {
  at.quaternion.setFromRotationMatrix(look.lookAt(eye, at.position, UP));
}
