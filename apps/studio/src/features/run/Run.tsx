import { Pause, Play, Square } from "lucide-react";
import { useEffect } from "react";
import { useStore } from "zustand";
import { postProgram } from "../../live/posting.ts";
import { cellStore } from "../../stores/cell.ts";
import { runCommand } from "../../stores/commands.ts";
import { controlStore } from "../../stores/control.ts";
import { programOf } from "../../stores/document.ts";
import { postStore } from "../../stores/post.ts";
import { runStore } from "../../stores/run.ts";
import { CodeView } from "../../ui/CodeView.tsx";
import { showNumber } from "../../ui/expression.ts";
import { words } from "../../words/index.ts";
import "./run.css";

/** Run mode: the exported text itself, executed statement by statement, with the twin beside it. */
export default function Run() {
  const program = useStore(cellStore, state => programOf(state.document)), { emitted, trouble, working } = useStore(postStore);
  const run = useStore(runStore), control = useStore(controlStore);
  useEffect(() => { if (!controlStore.getState().running) postProgram(); }, [program]);
  const file = emitted?.kind === "emitted" ? emitted.files[0] : undefined, empty = !program || program.steps.length === 0;
  const why = trouble ?? (emitted?.kind === "cannot" ? `${emitted.sentence} ${emitted.hint}` : null);
  return (
    <section className="run" aria-label={words.run.title}>
      <h2 className="heading"><span className="grow">{words.run.title}</span><span className="run-clock">{words.time.s(run.elapsed_s)} s</span></h2>
      <div className="section stack">
        <div className="row-flex run-buttons">
          {control.running
            ? <button className="btn primary" onClick={() => runCommand("run.hold")}>{run.held ? <Play /> : <Pause />}{run.held ? words.run.resume : words.run.hold}</button>
            : <button className="btn primary" disabled={empty || !file || working} onClick={() => runCommand("run.start")}><Play />{run.phase === "ended" ? words.run.again : words.run.run}</button>}
          <button className="btn" disabled={!control.running} onClick={() => runCommand("run.stop")}><Square />{words.run.stop}</button>
        </div>
        <p className="small muted run-says" role="status">{control.running ? words.run.running(control.line) : run.ending || words.run.idle}</p>
        <dl className="facts">
          <div><dt>{words.run.twin}</dt><dd data-testid="twin-error">{showNumber(control.twinError_rad, "angle", 4)}°</dd></div>
          <div><dt>{words.run.io}</dt><dd>{run.gripperClosed ? words.jog.gripperClosed : words.jog.gripperOpened}</dd></div>
          <div><dt>{words.control.latency}</dt><dd>{control.latency_ms === null ? words.control.unknown : words.control.ms(control.latency_ms)}</dd></div>
        </dl>
        {empty && <p className="muted small">{words.run.nothing}</p>}
        {why && <p className="why" data-tone="bad" role="alert"><b>{words.run.notEmitted}</b> {why}</p>}
        {file && <><span className="dim small">{words.run.text} · {file.name}</span><CodeView text={file.text} label={words.run.text} current={control.line} height="min(46vh, 460px)" /></>}
        <p className="small dim">{words.run.recording}</p>
      </div>
    </section>
  );
}
