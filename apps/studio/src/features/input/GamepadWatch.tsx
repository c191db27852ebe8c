import { useEffect } from "react";
import { beginEdit, endEdit } from "../../runtime/jog/edit-point.ts";
import { onFrame } from "../../runtime/jog/jog-frames.ts";
import { hold, release, releaseAll } from "../../runtime/jog/pressed-inputs.ts";
import { bindingStore, type PressedAction } from "../../stores/bindings.ts";
import { runCommand } from "../../stores/commands.ts";
import { dialogStore } from "../../stores/dialogs.ts";
import { gamepadStore } from "../../stores/gamepad.ts";
import { notify } from "../../stores/notices.ts";
import { tiltCloseCamera, turnView, viewStore } from "../../stores/view.ts";
import { words } from "../../messages/index.ts";
import { padStep, type PadReading } from "./gamepad.ts";

const COMMAND: Readonly<Record<PressedAction, string>> = {
  "aid-next": "jog.aid-next",
  "aid-previous": "jog.aid-previous",
  record: "program.record-ptp",
  ready: "jog.ready",
  camera: "view.camera",
};
/** The Controls dialog draws the pad ten times a second. */
const TELL_EVERY_MS = 100;

/** Reads the gamepad once a frame. A pad that goes away while it holds something stops the robot. */
export function GamepadWatch() {
  useEffect(() => {
    let before: PadReading | null = null;
    let told_ms = 0;
    let name = "";
    let edits = false;
    let grips = false;
    const back = new Set<number>();
    return onFrame(now_ms => {
      const pad = navigator.getGamepads().find(each => each?.connected) ?? null;
      if (!pad) {
        if (before === null) return;
        before = null;
        back.clear();
        release("gamepad");
        releaseAll();
        if (edits) endEdit();
        edits = false;
        grips = false;
        turnView([0, 0]);
        gamepadStore.setState({ pad: null });
        notify("warn", words.pad.lost, words.pad.lostHint);
        return;
      }
      // A trigger counts as pressed long before it is down; its value is what tilts. Some pads know only pressed.
      const now: PadReading = {
        buttons: pad.buttons.map(({ value, pressed }) => (value > 0 || !pressed ? value : 1)),
        axes: [...pad.axes],
      };
      if (before === null || name !== pad.id) {
        name = pad.id;
        notify("info", words.pad.found(pad.id));
      }
      const step = padStep(now, before, bindingStore.getState(), back);
      const listens = viewStore.getState().mode === "teach" && dialogStore.getState().open === null;
      for (let axis = 0; axis < 6; axis++) hold("gamepad", axis, listens ? step.axes[axis]! : 0);
      if (listens) for (const action of step.pressed) runCommand(COMMAND[action]);
      const wantsEdit = step.edit && listens;
      if (wantsEdit !== edits) {
        edits = wantsEdit;
        if (edits) beginEdit();
        else endEdit();
      }
      if (step.grip !== null && step.grip !== grips && listens) {
        grips = step.grip;
        runCommand(grips ? "program.gripper-close" : "program.gripper-open");
      }
      turnView(dialogStore.getState().open === null ? step.view : [0, 0]);
      if (step.tilt !== null) tiltCloseCamera(step.tilt);
      if ((now_ms - told_ms > TELL_EVERY_MS && dialogStore.getState().open === "controls") || before === null) {
        told_ms = now_ms;
        gamepadStore.setState({ pad: { id: pad.id, buttons: now.buttons, axes: now.axes } });
      }
      before = now;
    });
  }, []);
  return null;
}
