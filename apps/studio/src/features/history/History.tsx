import { Download, Pause, Play, Trash2 } from "lucide-react";
import { useVirtualizer } from "@tanstack/react-virtual";
import { useRef } from "react";
import { useStore } from "zustand";
import { theHistory } from "../../live/cell-control.ts";
import { historyStore, type RunRecord } from "../../stores/history.ts";
import { notify } from "../../stores/notices.ts";
import { download } from "../../ui/download.ts";
import { Slide } from "../../ui/Slide.tsx";
import { words } from "../../words/index.ts";
import "./history.css";

const ROW_PX = 52;
const SPEEDS = [0.25, 1, 4] as const;
const seconds = (t_s: number): string => `${t_s.toFixed(2)} s`;

/** Every run that was recorded in this browser, and any moment of the one that is open. */
export default function History() {
  const runs = useStore(historyStore, state => state.runs), open = useStore(historyStore, state => state.open);
  const box = useRef<HTMLDivElement>(null);
  const rows = useVirtualizer({ count: runs.length, getScrollElement: () => box.current, estimateSize: () => ROW_PX, overscan: 6 });
  return (
    <section className="section history">
      <h2>{words.history.title}</h2>
      {runs.length === 0 && <p className="muted">{words.history.none}</p>}
      {runs.length > 0 && open === null && <p className="small muted">{words.history.choose}</p>}
      {open !== null && <Moment />}
      <div ref={box} className="history-list" role="list" aria-label={words.history.title}>
        <div style={{ height: rows.getTotalSize(), position: "relative" }}>
          {rows.getVirtualItems().map(row => <RunRow key={runs[row.index]!.id} run={runs[row.index]!} open={runs[row.index]!.id === open} top_px={row.start} />)}
        </div>
      </div>
    </section>
  );
}

function RunRow({ run, open, top_px }: { readonly run: RunRecord; readonly open: boolean; readonly top_px: number }) {
  const save = async (): Promise<void> => {
    try { download(`${run.id}.mcap`, new Blob([await theHistory.bytes(run.id)], { type: "application/octet-stream" })); }
    catch (trouble) { notify("bad", `${words.history.unreadable} ${trouble instanceof Error ? trouble.message : String(trouble)}.`); }
  };
  const remove = async (): Promise<void> => { await theHistory.remove(run.id); notify("info", words.history.deleted); };
  return (
    <div role="listitem" className="history-row" data-open={open || undefined} style={{ transform: `translateY(${top_px}px)` }}>
      <button className="history-open" aria-pressed={open} onClick={() => { void theHistory.open(run.id); }}>
        <b>{run.name}</b>
        <span className="small muted">{new Date(run.startedAt).toLocaleString()} · {seconds(run.duration_s)} · {words.history.endings[run.ending]}</span>
      </button>
      <button className="btn quiet icon" aria-label={`${words.history.download}: ${run.name}`} onClick={() => { void save(); }}><Download /></button>
      <button className="btn quiet icon" aria-label={`${words.history.remove}: ${run.name}`} onClick={() => { void remove(); }}><Trash2 /></button>
    </div>
  );
}

/** The open run: slider, play, speed, what happened. */
function Moment() {
  const { t_s, duration_s, playing, opening, events, step, speed } = useStore(historyStore);
  if (opening) return <p role="status" className="muted">{words.history.loading}</p>;
  return (
    <div className="history-moment">
      <Slide label={words.history.title} value={t_s} min={0} max={Math.max(duration_s, 0.001)} step={0.001} says={seconds(t_s)} onChange={theHistory.seek} />
      <div className="history-time">
        <button className="btn" onClick={() => { if (playing) theHistory.pause(); else theHistory.play(); }}>{playing ? <Pause /> : <Play />}{playing ? words.time.pause : words.time.play}</button>
        <span className="history-speeds" role="group" aria-label={words.time.speed}>
          {SPEEDS.map(factor => <button key={factor} className="btn tight" aria-pressed={speed === factor} onClick={() => { theHistory.setSpeed(factor); }}>{factor} ×</button>)}
        </span>
        <output>{seconds(t_s)} <span className="dim">/ {seconds(duration_s)}</span></output>
      </div>
      {step && <p className="small muted">{words.inspector.step}: {step}</p>}
      <h3>{words.history.events}</h3>
      {events.length === 0 && <p className="small muted">{words.history.noEvents}</p>}
      <ul className="history-events">
        {events.map((event, i) => (
          <li key={i} data-level={event.level}><button className="link" onClick={() => { theHistory.seek(event.at_s); }}>{seconds(event.at_s)}</button> <span>{event.sentence}</span></li>
        ))}
      </ul>
    </div>
  );
}
