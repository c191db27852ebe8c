import { Pause, Play, RotateCcw, Square } from "lucide-react";
import { useEffect, useMemo, useRef } from "react";
import { useStore } from "zustand";
import { vPlus } from "@twincell/languages";
import { cellStore } from "../../stores/cell.ts";
import { runCommand } from "../../stores/commands.ts";
import { controlStore } from "../../stores/control.ts";
import { programOf, robotOf } from "../../stores/document.ts";
import { playStore } from "../../stores/play.ts";
import { words } from "../../words/index.ts";
import "./run.css";

/** Run: the exported text on the left of one's mind, the twin in the view. The line under way is lit and kept in sight. */
export default function Run() {
  const document = useStore(cellStore, state => state.document), program = programOf(document), robot = robotOf(document);
  const running = useStore(controlStore, state => state.running), safety = useStore(controlStore, state => state.safety);
  const held = useStore(playStore, state => state.speed === 0);
  const file = useMemo(() => {
    if (!program || !robot || !document || program.steps.length === 0) return null;
    const emitted = vPlus.emit(program, robot, document.robot.worldFromBase);
    return emitted.kind === "cannot" ? emitted : emitted.files.find(each => /^\s*\.PROGRAM/im.test(each.text)) ?? emitted.files[0] ?? null;
  }, [program, robot, document]);

  return (
    <section className="section run">
      <h2>{words.run.title}</h2>
      <p className="small muted">{words.run.idle} {words.run.recording}</p>
      <div className="run-buttons">
        {running
          ? <>
            <button className="btn" onClick={() => playStore.setState({ speed: held ? 1 : 0 })}>{held ? <Play /> : <Pause />}{held ? words.run.resume : words.run.hold}</button>
            <button className="btn" onClick={() => runCommand("stop")}><Square />{words.run.stop}</button>
          </>
          : <button className="btn primary" disabled={file === null || "kind" in file || safety !== "normal"} onClick={() => runCommand("run.start")}><Play />{words.run.run}</button>}
        {safety !== "normal" && <button className="btn" onClick={() => runCommand("run.reset")}><RotateCcw />{words.control.reset}</button>}
      </div>
      <TwinError />
      {file === null && <p className="muted">{words.run.nothing}</p>}
      {file !== null && "kind" in file && <p role="alert" className="run-cannot">{words.run.notEmitted} {file.sentence}</p>}
      {file !== null && !("kind" in file) && <Listing text={file.text} />}
    </section>
  );
}

function TwinError() {
  const error_rad = useStore(controlStore, state => state.twinError_rad), message = useStore(controlStore, state => state.message);
  return (
    <dl className="facts run-facts">
      <div><dt>{words.run.twin}</dt><dd data-testid="twin-error">{((error_rad * 180) / Math.PI).toFixed(6)}°</dd></div>
      {message && <div><dt>{words.jog.message}</dt><dd>{message}</dd></div>}
    </dl>
  );
}

const LINE_PX = 18;

/** The program's lines. Lines out of sight are not laid out (`content-visibility`), so that long texts cost little. */
function Listing({ text }: { readonly text: string }) {
  const lines = useMemo(() => text.replace(/\r/g, "").replace(/\n$/, "").split("\n"), [text]);
  const line = useStore(controlStore, state => (state.running ? state.line : 0)), box = useRef<HTMLOListElement>(null);
  useEffect(() => {
    const list = box.current;
    if (!list || line === 0) return;
    const top = (line - 1) * LINE_PX;
    if (top < list.scrollTop + LINE_PX || top > list.scrollTop + list.clientHeight - 3 * LINE_PX) list.scrollTop = top - list.clientHeight / 3;
  }, [line]);
  return (
    <ol ref={box} className="listing" aria-label={words.run.text} tabIndex={0}>
      {lines.map((says, i) => <li key={i} data-now={i + 1 === line || undefined}><code>{says || " "}</code></li>)}
    </ol>
  );
}
