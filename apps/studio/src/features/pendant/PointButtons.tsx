import { ChevronLeft, ChevronRight, CircleDot, Home, LocateFixed, MapPinPlus, Rainbow, Spline } from "lucide-react";
import { useStore } from "zustand";
import { commandStore, runCommand } from "../../stores/commands.ts";
import { controlStore } from "../../stores/control.ts";
import { jogStore } from "../../stores/jog.ts";
import { recordStore } from "../../stores/record.ts";
import { selectionStore } from "../../stores/selection.ts";
import { orientationPresetStore } from "../../stores/aids.ts";
import { Tip } from "../../ui/Tip.tsx";
import { say, words } from "../../messages/index.ts";
import { EditButton } from "./EditButton.tsx";

/** Aids, home, record, touch up, gripper, last message. */
export function PointButtons() {
  const aid = useStore(jogStore, state => state.aid);
  const count = useStore(orientationPresetStore, state => state.count);
  const message = useStore(controlStore, state => state.message);
  const moving = useStore(recordStore, state => state.moving);
  const canTouchUp =
    useStore(selectionStore, state => state.selected?.kind === "step") &&
    commandStore.getState().commands.get("program.touch-up")?.can?.() !== false;
  return (
    <>
      <div className="point-row">
        <span className="point-label">{words.jog.record}</span>
        <Tip words={words.jog.recordTip} keys="P">
          <button className="btn" onClick={() => runCommand("program.record-ptp")}>
            <CircleDot />
            {words.jog.recordPtp}
          </button>
        </Tip>
        <Tip words={words.jog.recordTip} keys="Shift+P">
          <button className="btn" onClick={() => runCommand("program.record-lin")}>
            <CircleDot />
            {words.jog.recordLin}
          </button>
        </Tip>
      </div>
      <div className="point-row">
        <span className="point-label" />
        <Tip words={words.jog.recordCircTip}>
          <button className="btn" onClick={() => runCommand("program.record-circ")}>
            <Rainbow />
            {words.step.path.circ}
          </button>
        </Tip>
        <Tip words={words.poses.addTip} keys="Shift+K">
          <button className="btn" onClick={() => runCommand("program.keep-pose")}>
            <MapPinPlus />
            {words.jog.keepPose}
          </button>
        </Tip>
      </div>
      <div className="point-row">
        <span className="point-label" />
        <Tip words={words.jog.recordMovingTip} keys="Shift+R">
          <button className="btn" aria-pressed={moving} onClick={() => runCommand("program.record-moving")}>
            <Spline />
            {words.jog.recordMoving}
          </button>
        </Tip>
      </div>
      <div className="point-row">
        <span className="point-label" />
        <Tip words={canTouchUp ? words.jog.touchUpTip : words.jog.touchUpNone}>
          <button className="btn" aria-disabled={!canTouchUp} onClick={() => runCommand("program.touch-up")}>
            <LocateFixed />
            {words.jog.touchUp}
          </button>
        </Tip>
        <Tip words={words.jog.readyTip} keys="H">
          <button className="btn" onClick={() => runCommand("jog.ready")}>
            <Home />
            {words.jog.ready}
          </button>
        </Tip>
      </div>
      <EditButton />
      <div className="point-row">
        <span className="point-label">{words.jog.aids}</span>
        <button className="btn icon" aria-label={words.jog.aidPrevious} onClick={() => runCommand("jog.aid-previous")}>
          <ChevronLeft />
        </button>
        <span className="aid-now" role="status">
          {aid === null ? words.jog.aidFree : words.jog.aid(aid + 1, count)}
        </span>
        <button className="btn icon" aria-label={words.jog.aidNext} onClick={() => runCommand("jog.aid-next")}>
          <ChevronRight />
        </button>
      </div>
      <div className="point-row">
        <span className="point-label">{words.jog.gripper}</span>
        <button className="btn" onClick={() => runCommand("program.gripper-open")}>
          {words.jog.gripperOpen}
        </button>
        <button className="btn" onClick={() => runCommand("program.gripper-close")}>
          {words.jog.gripperClose}
        </button>
      </div>
      <p className="small dim pendant-message" title={words.jog.message}>
        {message ? say(message) : words.jog.dead}
      </p>
    </>
  );
}
