import { Download, Pause, Play, Trash2 } from "lucide-react";
import { useStore } from "zustand";
import { runCommand } from "../../stores/commands.ts";
import { historyStore, type RunRecord } from "../../stores/history.ts";
import { notify } from "../../stores/notices.ts";
import { theTravel } from "../../stores/travel.ts";
import { download } from "../../ui/download.ts";
import { words } from "../../words/index.ts";
import "./history.css";

const when = new Intl.DateTimeFormat("en-GB", { dateStyle: "medium", timeStyle: "medium" });

/** History mode: every run, and any moment of it. */
export default function History() {
  const { runs, open, opening, events, t_s } = useStore(historyStore);
  return (
    <section aria-label={words.history.title}>
      <h2 className="heading"><span className="grow">{words.history.title}</span>{open && <button className="btn quiet tight" onClick={() => runCommand("history.close")}>{words.history.back}</button>}</h2>
      {runs.length === 0 ? <p className="empty">{words.history.none}</p> : <ul className="runs">{runs.map(run => <Line key={run.id} run={run} open={run.id === open} />)}</ul>}
      {opening && <p className="empty" role="status">{words.history.loading}</p>}
      {open && !opening && (
        <>
          <h2 className="heading">{words.history.events}</h2>
          {events.length === 0 ? <p className="empty">{words.history.noEvents}</p>
            : <ul className="events">{events.map((event, i) => <li key={i}><button className="row" data-on={t_s >= event.at_s} onClick={() => theTravel()?.seek(event.at_s)}><i className="mark" data-verdict={event.level === "error" ? "bad" : event.level === "warning" ? "warn" : "ok"} aria-hidden /><span className="event-says">{event.sentence}</span><span className="kind">{words.time.s(event.at_s)} s</span></button></li>)}</ul>}
        </>
      )}
      {!open && runs.length > 0 && <p className="empty">{words.history.choose}</p>}
    </section>
  );
}

function Line({ run, open }: { run: RunRecord; open: boolean }) {
  const keep = async (): Promise<void> => {
    const bytes = await theTravel()?.bytes(run.id);
    if (bytes) download(`${run.name.replaceAll(/[^\p{L}\p{N}]+/gu, "-")}.mcap`, new Blob([bytes], { type: "application/octet-stream" }));
  };
  return (
    <li className="run-line" data-on={open}>
      <button className="run-open" aria-pressed={open} aria-label={`${words.history.open}: ${run.name}`} onClick={() => void theTravel()?.open(run.id)}>
        <b>{run.name}</b><span className="small muted">{when.format(new Date(run.startedAt))}</span>
        <span className="small dim"><i className="mark" data-verdict={run.ending === "done" ? "ok" : "bad"} aria-hidden /> {words.history.endings[run.ending]} · {run.duration_s.toFixed(1)} s · {words.history.size(run.bytes)}</span>
      </button>
      {open && <PlayButton />}
      <button className="btn quiet icon" aria-label={`${words.history.download}: ${run.name}`} title={words.history.download} onClick={() => void keep()}><Download /></button>
      <button className="btn quiet icon" aria-label={`${words.history.remove}: ${run.name}`} title={words.history.remove} onClick={() => void theTravel()?.remove(run.id).then(() => notify("info", words.history.deleted))}><Trash2 /></button>
    </li>
  );
}
function PlayButton() {
  const playing = useStore(historyStore, state => state.playing);
  return <button className="btn quiet icon" aria-label={playing ? words.time.pause : words.time.play} onClick={() => runCommand("history.play")}>{playing ? <Pause /> : <Play />}</button>;
}
