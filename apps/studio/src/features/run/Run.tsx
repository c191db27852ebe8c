import { Pause, Play, RotateCcw, Square } from "lucide-react";
import { useEffect } from "react";
import { useStore } from "zustand";
import { dialectById, joinFiles, runnableFile } from "@twincell/languages";
import type { TextProgram } from "@twincell/project";
import { postProgram } from "../../runtime/planning/posting.ts";
import { cellStore } from "../../stores/cell.ts";
import { runCommand } from "../../stores/commands.ts";
import { connectionStore } from "../../stores/connection.ts";
import { controlStore } from "../../stores/control.ts";
import { programOf, robotOf, textOf } from "../../stores/document.ts";
import { foreignStore, openForeign } from "../../stores/foreign.ts";
import { languageOf, languageStore } from "../../stores/languages.ts";
import { playStore } from "../../stores/play.ts";
import { postStore } from "../../stores/post.ts";
import { stationStore } from "../../stores/stations.ts";
import { CodeView } from "../../ui/CodeView.tsx";
import { say, words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";
import { LanguageChoice } from "../../ui/LanguageChoice.tsx";
import { Foreign } from "./Foreign.tsx";
import { Production } from "./Production.tsx";
import { SignalList } from "./SignalList.tsx";
import "./run.css";

/**
 * Run: the exported text on the left of one's mind, the twin in the view. The line under way is lit and kept in sight.
 */
export default function Run() {
  const document = useStore(cellStore, state => state.document);
  const program = programOf(document);
  const text = textOf(document);
  const robot = robotOf(document);
  const running = useStore(controlStore, state => state.running);
  const safety = useStore(controlStore, state => state.safety);
  const connected = useStore(connectionStore, state => state.station);
  const producing = useStore(
    stationStore,
    ({ stations }) => (stations.find(({ id: each }) => each === connected)?.production ?? null) !== null,
  );
  const held = useStore(playStore, state => state.speed === 0);
  const dialect = useStore(languageStore, state => languageOf(robot, state));
  const nothing = !program || !robot || program.steps.length === 0;
  const { emitted, trouble: problem } = useStore(postStore);
  const id = dialect?.id ?? "";
  useEffect(() => {
    postStore.setState({ emitted: null, proof: null, trouble: null });
    postProgram(false);
  }, [program, id]);
  const file = dialect && emitted?.kind === "emitted" ? runnableFile(dialect, emitted.files) : undefined;
  const foreign = useStore(foreignStore, state => state.open);
  useEffect(() => {
    openTextOfCell(text);
  }, [text]);
  const cannot = problem ?? (emitted?.kind === "cannot" ? emitted.sentence : null);

  if (foreign)
    return (
      <section aria-label={words.run.title}>
        <h2 className="heading">
          <span className="grow">{words.run.title}</span>
        </h2>
        <div className="section run">
          <Foreign open={foreign} />
          <TwinError />
        </div>
      </section>
    );
  return (
    <section aria-label={words.run.title}>
      <h2 className="heading">
        <span className="grow">{words.run.title}</span>
      </h2>
      <div className="section run">
        <p className="small muted">
          {dialect ? words.run.idle : words.run.neutral(robot?.name ?? "")} {words.run.recording}
        </p>
        {robot && dialect && <LanguageChoice robot={robot} disabled={running} />}
        <div className="run-buttons">
          {running || producing ? (
            <>
              <button className="btn" onClick={() => playStore.setState({ speed: held ? 1 : 0 })}>
                {held ? <Play /> : <Pause />}
                {held ? words.run.resume : words.run.hold}
              </button>
              <button className="btn" onClick={() => runCommand("stop")}>
                <Square />
                {words.run.stop}
              </button>
            </>
          ) : (
            <button
              className="btn primary"
              disabled={nothing || cannot !== null || safety !== "normal"}
              onClick={() => runCommand("run.start")}
            >
              <Play />
              {words.run.run}
            </button>
          )}
          {safety !== "normal" && (
            <button className="btn" onClick={() => runCommand("run.reset")}>
              <RotateCcw />
              {words.control.reset}
            </button>
          )}
        </div>
        {connected !== null && <Production id={connected} disabled={nothing || safety !== "normal"} />}
        <TwinError />
        {nothing && <p className="muted">{words.run.nothing}</p>}
        {cannot !== null && (
          <p role="alert" className="run-cannot">
            {words.run.notEmitted(dialect?.name ?? "")} {say(cannot)}
          </p>
        )}
        {program && <SignalList signals={program.signals} />}
        {file && dialect && <Listing text={file.text} dialect={dialect.id} name={dialect.name} />}
      </div>
    </section>
  );
}

/** The text that is worked on is what runs, as it stands; one that is under way is not taken away. */
function openTextOfCell(text: TextProgram | null): void {
  const { open, phase } = foreignStore.getState();
  if (phase !== "idle") return;
  const dialect = text && dialectById(text.language);
  if (text && dialect) {
    const joined = joinFiles(dialect, text.files, text.main);
    if (open?.text !== joined.text || open.name !== text.main)
      openForeign({ name: text.main, dialect: text.language, text: joined.text, ofCell: true });
  } else if (open?.ofCell === true) foreignStore.setState({ open: null });
}

function TwinError() {
  const error_rad = useStore(controlStore, state => state.twinError_rad);
  const message = useStore(controlStore, state => state.message);
  return (
    <dl className="facts run-facts">
      <div>
        <dt>{words.run.twin}</dt>
        <dd data-testid="twin-error">{fixed((error_rad * 180) / Math.PI, 6)}°</dd>
      </div>
      {message && (
        <div>
          <dt>{words.jog.message}</dt>
          <dd>{say(message)}</dd>
        </div>
      )}
    </dl>
  );
}

/** The text with the line under way lit and kept in sight. */
function Listing({ text, dialect, name }: { readonly text: string; readonly dialect: string; readonly name: string }) {
  const line = useStore(controlStore, state => (state.running ? state.line : 0));
  return (
    <CodeView
      text={text.replace(/\r?\n$/, "")}
      dialect={dialect}
      label={words.run.text(name)}
      current={line}
      height="min(48vh, 520px)"
    />
  );
}
