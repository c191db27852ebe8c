import { Download, FolderOpen, Trash2 } from "lucide-react";
import { useVirtualizer } from "@tanstack/react-virtual";
import { lazy, Suspense, useRef, useState } from "react";
import { useStore } from "zustand";
import { openRecordingFiles, theHistory } from "../../runtime/robot/cell-control.ts";
import { historyStore, type RunRecord } from "../../stores/history.ts";
import { notify } from "../../stores/notices.ts";
import { Segments } from "../../ui/Choice.tsx";
import { download } from "../../ui/download.ts";
import { words } from "../../messages/index.ts";
import { Cycles } from "./Cycles.tsx";
import { Moment } from "./Moment.tsx";
import { clockOf } from "./times.ts";
import "./history.css";

const Figures = lazy(() => import("./Figures.tsx"));
const when = new Intl.DateTimeFormat("en-GB", { day: "numeric", month: "short", hour: "2-digit", minute: "2-digit" });
const ROW_PX = 52;
type View = "moment" | "cycles" | "figures";

/** Every run that was recorded in this browser, files from elsewhere, and any moment of what is open. */
export default function History() {
  const runs = useStore(historyStore, state => state.runs);
  const open = useStore(historyStore, state => state.open);
  const opening = useStore(historyStore, state => state.opening);
  const shown = useStore(historyStore, state => state.opening || state.duration_s > 0);
  const [view, setView] = useState<View>("moment");
  const box = useRef<HTMLDivElement>(null);
  const input = useRef<HTMLInputElement>(null);
  const rows = useVirtualizer({
    count: runs.length,
    getScrollElement: () => box.current,
    estimateSize: () => ROW_PX,
    overscan: 6,
  });
  return (
    <section aria-label={words.history.title}>
      <h2 className="heading">
        <span className="grow">{words.history.title}</span>
        <button
          className="btn quiet tight history-file"
          title={words.history.dropHint}
          onClick={() => input.current?.click()}
        >
          <FolderOpen />
          {words.history.openFile}
        </button>
      </h2>
      <input
        ref={input}
        type="file"
        accept=".mcap"
        multiple
        hidden
        aria-label={words.history.openFile}
        data-recording-input
        onChange={event => {
          const files = [...(event.currentTarget.files ?? [])];
          event.currentTarget.value = "";
          if (files.length > 0) void openRecordingFiles(files);
        }}
      />
      <div className="section history">
        {runs.length === 0 && !shown && <p className="muted">{words.history.none}</p>}
        {runs.length > 0 && !shown && <p className="small muted">{words.history.choose}</p>}
        {opening && (
          <p role="status" className="muted">
            {words.history.loading}
          </p>
        )}
        {shown && !opening && (
          <>
            <Segments<View>
              label={words.history.views}
              value={view}
              onChange={setView}
              options={[
                { value: "moment", words: words.history.momentView },
                { value: "cycles", words: words.history.cyclesView },
                { value: "figures", words: words.history.figuresView },
              ]}
            />
            {view === "moment" ? (
              <Moment />
            ) : view === "cycles" ? (
              <Cycles />
            ) : (
              <Suspense>
                <Figures />
              </Suspense>
            )}
          </>
        )}
        <div ref={box} className="history-list" role="list" aria-label={words.history.title}>
          <div style={{ height: rows.getTotalSize(), position: "relative" }}>
            {rows.getVirtualItems().map(row => (
              <RunRow
                key={runs[row.index]!.id}
                run={runs[row.index]!}
                open={runs[row.index]!.id === open}
                top_px={row.start}
              />
            ))}
          </div>
        </div>
        {runs.length > 0 && <p className="small muted">{words.history.keeping}</p>}
      </div>
    </section>
  );
}

function RunRow({ run, open, top_px }: { readonly run: RunRecord; readonly open: boolean; readonly top_px: number }) {
  const save = async (): Promise<void> => {
    try {
      download(`${run.id}.mcap`, await theHistory.file(run.id));
    } catch (problem) {
      notify("bad", `${words.history.unreadable} ${problem instanceof Error ? problem.message : String(problem)}.`);
    }
  };
  const remove = async (): Promise<void> => {
    await theHistory.remove(run.id);
    notify("info", words.history.deleted);
  };
  return (
    <div
      role="listitem"
      className="history-row"
      data-open={open || undefined}
      style={{ transform: `translateY(${top_px}px)` }}
    >
      <button
        className="history-open"
        aria-pressed={open}
        onClick={() => {
          void theHistory.open(run.id);
        }}
      >
        <b>{run.name}</b>
        <span className="small muted">
          {when.format(new Date(run.startedAt))} · {clockOf(run.duration_s)} · {words.history.endings[run.ending]}
        </span>
      </button>
      <button
        className="btn quiet icon"
        aria-label={`${words.history.download}: ${run.name}`}
        onClick={() => {
          void save();
        }}
      >
        <Download />
      </button>
      <button
        className="btn quiet icon"
        aria-label={`${words.history.remove}: ${run.name}`}
        onClick={() => {
          void remove();
        }}
      >
        <Trash2 />
      </button>
    </div>
  );
}
