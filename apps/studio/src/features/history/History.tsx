import { Download, Trash2 } from "lucide-react";
import { useVirtualizer } from "@tanstack/react-virtual";
import { useRef } from "react";
import { useStore } from "zustand";
import { theHistory } from "../../live/cell-control.ts";
import { historyStore, type RunRecord } from "../../stores/history.ts";
import { notify } from "../../stores/notices.ts";
import { download } from "../../ui/download.ts";
import { words } from "../../words/index.ts";
import "./history.css";

const when = new Intl.DateTimeFormat("en-GB", { day: "numeric", month: "short", hour: "2-digit", minute: "2-digit" });
const ROW_PX = 52;
const seconds = (t_s: number): string => `${t_s.toFixed(2)} s`;

/** Every run that was recorded in this browser, and any moment of the one that is open. */
export default function History() {
  const runs = useStore(historyStore, state => state.runs), open = useStore(historyStore, state => state.open);
  const box = useRef<HTMLDivElement>(null);
  const rows = useVirtualizer({ count: runs.length, getScrollElement: () => box.current, estimateSize: () => ROW_PX, overscan: 6 });
  return (
    <section aria-label={words.history.title}>
      <h2 className="heading"><span className="grow">{words.history.title}</span></h2>
      <div className="section history">
        {runs.length === 0 && <p className="muted">{words.history.none}</p>}
        {runs.length > 0 && open === null && <p className="small muted">{words.history.choose}</p>}
        {open !== null && <Moment />}
        <div ref={box} className="history-list" role="list" aria-label={words.history.title}>
          <div style={{ height: rows.getTotalSize(), position: "relative" }}>
            {rows.getVirtualItems().map(row => <RunRow key={runs[row.index]!.id} run={runs[row.index]!} open={runs[row.index]!.id === open} top_px={row.start} />)}
          </div>
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
        <span className="small muted">{when.format(new Date(run.startedAt))} · {seconds(run.duration_s)} · {words.history.endings[run.ending]}</span>
      </button>
      <button className="btn quiet icon" aria-label={`${words.history.download}: ${run.name}`} onClick={() => { void save(); }}><Download /></button>
      <button className="btn quiet icon" aria-label={`${words.history.remove}: ${run.name}`} onClick={() => { void remove(); }}><Trash2 /></button>
    </div>
  );
}

/** What happened in the open run, and when. */
function Moment() {
  const opening = useStore(historyStore, state => state.opening), events = useStore(historyStore, state => state.events), step = useStore(historyStore, state => state.step);
  if (opening) return <p role="status" className="muted">{words.history.loading}</p>;
  return (
    <div className="history-moment">
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
