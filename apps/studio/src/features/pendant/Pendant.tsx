import { Minus, Plus } from "lucide-react";
import { useRef } from "react";
import { useStore } from "zustand";
import { hold, release } from "../../runtime/jog/pressed-inputs.ts";
import { readFrame, readTcp } from "../../runtime/jog/readout.ts";
import { cellStore } from "../../stores/cell.ts";
import { robotOf, worldFromFrameOf } from "../../stores/document.ts";
import { jogStore, type JogFrame } from "../../stores/jog.ts";
import { Segments } from "../../ui/Choice.tsx";
import { showNumber } from "../../ui/expression.ts";
import { HoldButton } from "../../ui/HoldButton.tsx";
import { useLive } from "../../ui/useLive.ts";
import { say, words } from "../../messages/index.ts";
import { nearness } from "./nearness.ts";
import { Connection } from "./Connection.tsx";
import { JointGauges } from "./JointGauges.tsx";
import { DragManner, JogMode, TargetManner } from "./Manner.tsx";
import { PointButtons } from "./PointButtons.tsx";
import "../../ui/axis.css";
import "./pendant.css";

const FRAMES: readonly JogFrame[] = ["joint", "base", "tool", "user", "world"];
const TIP_AXES = 6;

/** What a robot programmer's hands know. */
export function Pendant() {
  const frame = useStore(jogStore, state => state.frame);
  const blocked = useStore(jogStore, state => state.blocked);
  const noUser = useStore(cellStore, state => (state.document?.frames.length ?? 0) === 0);
  return (
    <section className="pendant" aria-label={words.jog.title}>
      <h2 className="heading">
        <span className="grow">{words.jog.title}</span>
      </h2>
      <div className="section stack">
        <Connection />
        <Segments
          label={words.jog.frame}
          value={frame}
          onChange={next => jogStore.setState({ frame: next, blocked: null })}
          options={FRAMES.map(value => ({
            value,
            words: words.jog.frames[value],
            disabled: value === "user" && noUser,
          }))}
        />
        <Axes />
        {blocked ? (
          <p className="pendant-blocked" role="alert">
            {say(blocked.sentence)}
          </p>
        ) : (
          frame !== "joint" && <JointGauges />
        )}
        <JogMode />
        <DragManner />
        <TargetManner />
        <PointButtons />
      </div>
    </section>
  );
}

/** One row a coordinate: − and + jog while held; in the joint frame with the gauge of its limits. */
function Axes() {
  const frame = useStore(jogStore, state => state.frame);
  const userFrame = useStore(jogStore, state => state.userFrame);
  const blockedJoint = useStore(jogStore, state => state.blocked?.joint);
  const cell = useStore(cellStore, state => state.document);
  const robot = robotOf(cell);
  const numbers = useRef<(HTMLElement | null)[]>([]);
  const gauges = useRef<(HTMLElement | null)[]>([]);
  const rows = useRef<(HTMLElement | null)[]>([]);
  const values = useRef(new Float64Array(TIP_AXES));
  const joint = frame === "joint";
  const axes = Array.from({ length: joint ? (robot?.arm.joints.length ?? 0) : TIP_AXES }, (_, i) => i);
  useLive(live => {
    if (!joint) readTcp(live.worldFromTcp, worldFromFrameOf(cell, readFrame(frame), userFrame), values.current);
    for (const i of axes) {
      const value = joint ? live.q_rad[i]! : values.current[i]!;
      const number = numbers.current[i];
      const text = joint || i > 2 ? `${showNumber(value, "angle")}°` : showNumber(value, "length");
      if (number && number.textContent !== text) number.textContent = text;
      const limits = robot?.arm.joints[i]?.limits;
      const gauge = gauges.current[i];
      if (!joint || !limits || !gauge) continue;
      const part = (value - limits.lower_rad) / (limits.upper_rad - limits.lower_rad);
      gauge.style.left = `${Math.min(1, Math.max(0, part)) * 100}%`;
      const near = nearness(value, limits.lower_rad, limits.upper_rad);
      const row = rows.current[i];
      if (row && row.dataset.near !== near) row.dataset.near = near;
    }
  });
  return (
    <div className="axes" key={joint ? "joint" : "cartesian"}>
      {axes.map(axis => {
        const name = joint ? words.time.joint(axis + 1) : words.jog.axes[axis]!;
        return (
          <div
            className="axis"
            key={axis}
            ref={element => {
              rows.current[axis] = element;
            }}
            data-blocked={blockedJoint === axis + 1 && joint}
          >
            <span className="axis-name">{name}</span>
            <HoldButton
              label={words.jog.minus(name)}
              className="btn icon axis-button"
              onHold={() => hold("pendant", axis, -1)}
              onRelease={() => release("pendant", axis)}
            >
              <Minus />
            </HoldButton>
            {joint ? (
              <span className="gauge" aria-hidden>
                <i
                  ref={element => {
                    gauges.current[axis] = element;
                  }}
                />
              </span>
            ) : (
              <span className="axis-line" aria-hidden />
            )}
            <HoldButton
              label={words.jog.plus(name)}
              className="btn icon axis-button"
              onHold={() => hold("pendant", axis, 1)}
              onRelease={() => release("pendant", axis)}
            >
              <Plus />
            </HoldButton>
            <span
              className="num axis-value"
              ref={element => {
                numbers.current[axis] = element;
              }}
            />
          </div>
        );
      })}
    </div>
  );
}
