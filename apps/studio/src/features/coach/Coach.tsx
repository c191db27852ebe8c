import { X } from "lucide-react";
import { useEffect, useState } from "react";
import { useStore } from "zustand";
import { cellStore } from "../../stores/cell.ts";
import { programOf } from "../../stores/document.ts";
import { playStore } from "../../stores/play.ts";
import { traceStore } from "../../stores/trace.ts";
import { historyStore } from "../../stores/history.ts";
import { viewStore } from "../../stores/view.ts";
import { words } from "../../messages/index.ts";
import { reachedStep } from "./reached.ts";
import "./coach.css";

/** Six steps through the main job. Each goes on by itself when it was done, or by hand. */
export function Coach() {
  const done = useStore(viewStore, state => state.coachDone);
  const hasObjects = useStore(cellStore, state => (state.document?.objects.length ?? 0) > 0);
  const [at, setAt] = useState(0);
  const tracing = useStore(traceStore, state => state.active);
  const chosen = useStore(traceStore, state => state.chosen.length);
  const steps = useStore(cellStore, state => programOf(state.document)?.steps.length ?? 0);
  const mode = useStore(viewStore, state => state.mode);
  const judged = useStore(playStore, state => state.verdict !== null);
  const runs = useStore(historyStore, state => state.runs.length);
  const reached = reachedStep({ tracing, chosen, steps, mode, judged, runs });
  useEffect(() => {
    setAt(before => Math.max(before, reached));
  }, [reached]);
  const finish = (): void => viewStore.setState({ coachDone: true });
  if (done || !hasObjects || at >= words.coach.steps.length) return null;
  const [title, says] = words.coach.steps[at]!;
  return (
    <aside className="coach float" aria-label={words.coach.title}>
      <div className="row-flex">
        <b className="grow">{title}</b>
        <span className="dim small">{words.coach.of(at + 1, words.coach.steps.length)}</span>
        <button
          className="btn quiet icon tight"
          aria-label={words.coach.skip}
          title={words.coach.skip}
          onClick={finish}
        >
          <X />
        </button>
      </div>
      <p className="muted">{says}</p>
      <div className="row-flex coach-foot">
        <span className="coach-dots" aria-hidden>
          {words.coach.steps.map(([name], i) => (
            <i key={name} data-on={i <= at} />
          ))}
        </span>
        <button className="btn tight" onClick={() => (at + 1 < words.coach.steps.length ? setAt(at + 1) : finish())}>
          {at + 1 < words.coach.steps.length ? words.coach.next : words.common.done}
        </button>
      </div>
    </aside>
  );
}
