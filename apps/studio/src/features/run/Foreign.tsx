import { Pause, Play, Square, StepForward } from "lucide-react";
import { useMemo } from "react";
import { useStore } from "zustand";
import { dialectById } from "@twincell/languages";
import { runForeign, stopForeign } from "../../runtime/run/foreign-text.ts";
import { controlStore } from "../../stores/control.ts";
import { cellStore } from "../../stores/cell.ts";
import { robotOf } from "../../stores/document.ts";
import { openDialog } from "../../stores/dialogs.ts";
import { foreignStore, toggleBreakpoint, type ForeignText } from "../../stores/foreign.ts";
import { playStore } from "../../stores/play.ts";
import { CodeView } from "../../ui/CodeView.tsx";
import { words } from "../../messages/index.ts";
import { skippedWords } from "../../messages/phrases.ts";
import { SignalList } from "./SignalList.tsx";

/** A text from elsewhere, run as it stands: breakpoints by a click on the number, one statement at a time, or on. */
export function Foreign({ open }: { readonly open: ForeignText }) {
  const phase = useStore(foreignStore, state => state.phase);
  const paused_line = useStore(foreignStore, state => state.line);
  const breakpoints = useStore(foreignStore, state => state.breakpoints);
  const line = useStore(controlStore, state => state.line);
  const safety = useStore(controlStore, state => state.safety);
  const held = useStore(playStore, state => state.speed === 0);
  const moving = phase === "running";
  const dialect = dialectById(open.dialect);
  const cell = useStore(cellStore, state => state.document);
  const robot = robotOf(cell);
  const [signals, skipped] = useMemo(() => {
    const interpreted =
      robot && cell
        ? dialect?.interpret(open.text, robot, cell.robot.worldFromBase, { skipUnknown: open.skipUnknown ?? false })
        : undefined;
    return interpreted?.kind === "ready"
      ? ([interpreted.context.signals ?? {}, interpreted.skipped ?? []] as const)
      : ([{}, []] as const);
  }, [dialect, open, robot, cell]);
  return (
    <>
      <p className="small">
        <b>{open.name}</b> <span className="tag">{dialect?.name ?? open.dialect}</span>
        {dialect?.maturity === "experimental" && <span className="tag">{words.export.experimentalTag}</span>}
      </p>
      <div className="run-buttons">
        {moving ? (
          <button className="btn" onClick={() => playStore.setState({ speed: held ? 1 : 0 })}>
            {held ? <Play /> : <Pause />}
            {held ? words.run.resume : words.run.hold}
          </button>
        ) : (
          <>
            <button className="btn primary" disabled={safety !== "normal"} onClick={() => runForeign(false)}>
              <Play />
              {phase === "paused" ? words.run.resume : words.foreign.run}
            </button>
            <button className="btn" disabled={safety !== "normal"} onClick={() => runForeign(true)}>
              <StepForward />
              {words.foreign.step}
            </button>
          </>
        )}
        {phase !== "idle" && (
          <button className="btn" onClick={stopForeign}>
            <Square />
            {words.run.stop}
          </button>
        )}
      </div>
      <p className="small muted" role="status">
        {phase === "paused" ? words.foreign.paused(paused_line) : moving ? words.run.running(line) : words.foreign.idle}
      </p>
      {skipped.length > 0 && (
        <p className="small" role="alert">
          <i
            className="mark"
            data-verdict={skipped.some(({ what }) => what !== "statement") ? "bad" : "warn"}
            aria-hidden
          />{" "}
          {skippedWords(skipped)}
        </p>
      )}
      <SignalList signals={signals} />
      <CodeView
        text={open.text.replace(/\r?\n$/, "")}
        dialect={open.dialect}
        label={words.run.text(dialect?.name ?? open.dialect)}
        current={phase === "paused" ? paused_line : moving ? line : 0}
        height="min(52vh, 560px)"
        stops={{ at: at => breakpoints.has(at), toggle: toggleBreakpoint, words: words.foreign.breakpoint }}
      />
      {open.ofCell !== true && (
        <div className="run-buttons">
          <button className="btn" disabled={phase !== "idle"} onClick={() => openDialog("import")}>
            {words.foreign.edit}
          </button>
          <button className="btn" disabled={phase !== "idle"} onClick={() => foreignStore.setState({ open: null })}>
            {words.foreign.back}
          </button>
        </div>
      )}
    </>
  );
}
