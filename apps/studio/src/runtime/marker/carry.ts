import { clutchStep, copyPose, FREE_HAND, type Grip, identity, type Pose, takeGrip } from "@twincell/core";
import { markerViewStore } from "../../stores/marker-view.ts";
import { beginDrag, dragTcp } from "../jog/drag.ts";
import { theLive } from "../live.ts";
import { markerView, onMarkerPicture } from "./marker-camera.ts";

/** A phone that is found again after the marker was out of sight carries on from there. */
let held: { grip: Grip | null; readonly end: () => void } | null = null;
const wanted: Pose<"world", "tcp"> = identity();
const worldFromHand: Pose<"world", "hand"> = identity();

/**
 * The tool is fixed to this device from now on: it moves and turns as the device does (row L-28). Taking it moves
 * nothing; while the marker is out of sight the tool stays where it is.
 */
export function beginCarry(): void {
  if (held || !markerViewStore.getState().on) return;
  const endDrag = beginDrag(endCarry);
  const stopListening = onMarkerPicture(follow);
  held = {
    grip: null,
    end() {
      stopListening();
      endDrag();
    },
  };
  markerViewStore.setState({ carrying: true });
  follow();
}

export function endCarry(): void {
  if (!held) return;
  const { end } = held;
  held = null;
  end();
  markerViewStore.setState({ carrying: false });
}

let followed = -1;
function follow(): void {
  if (!held) return;
  if (!markerViewStore.getState().seen) {
    held.grip = null;
    return;
  }
  if (held.grip && markerView.revision === followed) return;
  followed = markerView.revision;
  copyPose<string, string>(markerView.worldFromCamera, worldFromHand);
  held.grip ??= takeGrip(worldFromHand, theLive().worldFromTcp);
  dragTcp(clutchStep(held.grip, worldFromHand, FREE_HAND, wanted));
}
