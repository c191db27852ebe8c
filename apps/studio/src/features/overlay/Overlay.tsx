import { useEffect, useRef } from "react";
import { useStore } from "zustand";
import { onFrame } from "../../runtime/jog/jog-frames.ts";
import { theLive } from "../../runtime/live.ts";
import { readFrame, readTcp } from "../../runtime/jog/readout.ts";
import { cellStore } from "../../stores/cell.ts";
import { runCommand } from "../../stores/commands.ts";
import { worldFromFrameOf } from "../../stores/document.ts";
import { buildStore } from "../../stores/build.ts";
import { connectionStore } from "../../stores/connection.ts";
import { jogStore } from "../../stores/jog.ts";
import { traceStore } from "../../stores/trace.ts";
import { viewStore } from "../../stores/view.ts";
import { showNumber } from "../../ui/expression.ts";
import { words } from "../../messages/index.ts";
import { ClearanceTag } from "./ClearanceTag.tsx";
import "./overlay.css";

/** What floats over the view: what a click does, and where the TCP is. */
export function Overlay({ phone }: { phone: boolean }) {
  const mode = useStore(viewStore, state => state.mode);
  return (
    <>
      {!phone && <Hint />}
      <ConnectionBadge />
      {mode !== "cell" && <Readout />}
      <ClearanceTag />
      <TraceTool />
    </>
  );
}

/** Whether what is moved on screen is the robot or its clone: to be seen in every mode as long as one is connected. */
function ConnectionBadge() {
  const connected = useStore(connectionStore, state => state.station !== null);
  const view = useStore(connectionStore, state => state.view);
  if (!connected) return null;
  return (
    <p className="connection-badge float" role="status" data-view={view}>
      {view === "live" ? words.connection.liveBadge : words.connection.cloneBadge}
    </p>
  );
}

function Hint() {
  const mode = useStore(viewStore, state => state.mode);
  const tracing = useStore(traceStore, state => state.active);
  const dragged = useStore(buildStore, ({ tool }) => tool === "move" || tool === "turn" || tool === "scale");
  // The other tools say in a card of their own what is to be done.
  if (mode === "cell" && !dragged) return null;
  const hint =
    mode === "cell"
      ? words.view.hintCell
      : mode === "check"
        ? words.view.hintCheck
        : mode === "run"
          ? words.view.hintRun
          : mode === "history"
            ? words.view.hintHistory
            : tracing
              ? words.view.hintTrace
              : words.view.hintTeach;
  return (
    <p className="hint float">
      {hint.map(([strong, rest], i) => (
        <span key={strong}>
          {i > 0 && " · "}
          <b>{strong}</b> {rest}
        </span>
      ))}
    </p>
  );
}

function TraceTool() {
  const active = useStore(traceStore, state => state.active);
  const mode = useStore(viewStore, state => state.mode);
  if (mode !== "teach") return null;
  return (
    <button
      className="btn trace-toggle"
      aria-pressed={active}
      title={words.trace.tip}
      onClick={() => runCommand("trace.toggle")}
    >
      <TraceGlyph />
      {words.trace.tool}
      <span className="kbd" aria-hidden>
        T
      </span>
    </button>
  );
}
const TraceGlyph = () => (
  <svg viewBox="0 0 16 16" aria-hidden fill="none" stroke="currentColor">
    <path d="M2.5 11 8 14l5.5-3V5L8 2 2.5 5z" opacity=".55" />
    <path d="M2.5 5 8 8l5.5-3" strokeWidth="2.2" />
  </svg>
);

/** Six numbers written straight into the page when the robot moved; React draws them once. */
function Readout() {
  const frame = useStore(jogStore, state => state.frame);
  const userFrame = useStore(jogStore, state => state.userFrame);
  const cell = useStore(cellStore, state => state.document);
  const numbers = useRef<(HTMLElement | null)[]>([]);
  const read = readFrame(frame);
  useEffect(() => {
    const worldFromFrame = worldFromFrameOf(cell, read, userFrame);
    const values = new Float64Array(6);
    const shown: string[] = [];
    let seen = -1;
    const write = (): void => {
      const live = theLive();
      if (live.revision === seen) return;
      seen = live.revision;
      readTcp(live.worldFromTcp, worldFromFrame, values);
      for (let i = 0; i < 6; i++) {
        const text = i < 3 ? showNumber(values[i]!, "length") : `${showNumber(values[i]!, "angle")}°`;
        const element = numbers.current[i];
        if (element && shown[i] !== text) {
          shown[i] = text;
          element.textContent = text;
        }
      }
    };
    write();
    return onFrame(write);
  }, [cell, read, userFrame]);
  return (
    <dl className="readout float" aria-label={words.view.inFrame(words.jog.frames[read])}>
      {words.view.tcpAxes.map((axis, i) => (
        <div key={axis}>
          <dt>{axis}</dt>
          <dd
            ref={element => {
              numbers.current[i] = element;
            }}
            data-tcp={axis}
          >
            –
          </dd>
        </div>
      ))}
      <div className="readout-frame">
        <dt>{words.view.tcp}</dt>
        <dd>{read === "user" && userFrame ? userFrame : words.jog.frames[read]}</dd>
      </div>
    </dl>
  );
}
