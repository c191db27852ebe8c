import { useEffect, useState } from "react";
import { useStore } from "zustand";
import { postProgram } from "../../runtime/planning/posting.ts";
import { cellStore } from "../../stores/cell.ts";
import { closeDialog, dialogStore } from "../../stores/dialogs.ts";
import { programOf, robotOf } from "../../stores/document.ts";
import { languageOf, languageStore } from "../../stores/languages.ts";
import { notify } from "../../stores/notices.ts";
import { postStore } from "../../stores/post.ts";
import { findStep, stepWords } from "../../stores/program.ts";
import { select, selectionStore } from "../../stores/selection.ts";
import { Segments } from "../../ui/Choice.tsx";
import { CodeView } from "../../ui/CodeView.tsx";
import { download } from "../../ui/download.ts";
import { Frame } from "../../ui/Frame.tsx";
import { say, words } from "../../messages/index.ts";
import { ImportDialog } from "./ImportDialog.tsx";
import { LanguageChoice } from "../../ui/LanguageChoice.tsx";
import { manifestOf } from "./manifest.ts";
import { zipped } from "./zip.ts";
import "./export.css";

/** The programs of a language, and no other form of text. */
const WHOLE = "program";

/** The program in the controller's own language, proven by reading it back. */
export default function Export() {
  const open = useStore(dialogStore, state => state.open);
  return (
    <>
      <Frame open={open === "export"} title={words.export.title} onClose={closeDialog} width={960}>
        {open === "export" && <Body />}
      </Frame>
      <ImportDialog open={open === "import"} />
    </>
  );
}

function Body() {
  const { emitted, proof, working, trouble: problem } = useStore(postStore);
  const cell = useStore(cellStore, state => state.document);
  const program = programOf(cell);
  const robot = robotOf(cell);
  const dialect = useStore(languageStore, state => languageOf(robot, state));
  const id = dialect?.id ?? "";
  const [chosen, setChosen] = useState(0);
  const forms = dialect?.forms ?? [];
  const [wanted, setForm] = useState(WHOLE);
  const form = forms.some(each => each.id === wanted) ? wanted : WHOLE;
  const selected = useStore(selectionStore, state => (state.selected?.kind === "step" ? state.selected.id : ""));
  useEffect(() => {
    postStore.setState({ emitted: null, proof: null });
    postProgram(true, form === WHOLE ? null : form);
  }, [program, id, form]);
  if (!program || program.steps.length === 0) return <p className="muted">{words.run.nothing}</p>;
  if (!robot || !dialect) return <p className="muted">{words.export.noLanguage(robot?.name ?? "")}</p>;
  const files = emitted?.kind === "emitted" ? emitted.files : [];
  const file = files[Math.min(chosen, files.length - 1)];
  const stepOf = (line: number): string => file?.lines[line - 1] ?? "";
  const copy = async (text: string): Promise<void> => {
    try {
      await navigator.clipboard.writeText(text);
      notify("done", words.export.copied);
    } catch {
      notify("warn", words.export.notCopied, words.export.notCopiedHint);
    }
  };
  const whole = (): readonly { readonly name: string; readonly text: string }[] => [
    ...files,
    { name: "manifest.json", text: manifestOf(program, id, files, proof) },
  ];
  const downloadFiles = (): void => {
    for (const { name, text } of whole()) download(name, new Blob([text], { type: "text/plain" }));
  };
  const downloadZip = (): void =>
    download(
      `${files[0]?.name.replace(/\.[^.]*$/, "") ?? "program"}.zip`,
      new Blob([zipped(whole())], { type: "application/zip" }),
    );
  return (
    <div className="export" aria-busy={working}>
      <div className="export-side stack">
        <span className="dim small">{words.export.dialect}</span>
        <LanguageChoice robot={robot} />
        {forms.length > 0 && (
          <Segments
            label={words.export.form}
            className="seg small-seg"
            value={form}
            onChange={setForm}
            options={[
              { value: WHOLE, words: words.export.wholeProgram },
              ...forms.map(each => ({ value: each.id, words: each.name })),
            ]}
          />
        )}
        <p className="small muted">
          {dialect.maturity === "proven" ? (
            words.export.proven
          ) : (
            <>
              <i className="mark" data-verdict="warn" aria-hidden /> {words.export.experimental}
            </>
          )}
        </p>
        {proof && (
          <p className="export-proof" data-good={proof.kind === "proven"}>
            <i className="mark" data-verdict={proof.kind === "proven" ? "ok" : "bad"} aria-hidden />
            {say(proof.sentence)}
          </p>
        )}
        {(problem ?? (emitted?.kind === "cannot" ? `${emitted.sentence} ${emitted.hint}` : null)) !== null && (
          <p className="export-proof" role="alert">
            <i className="mark" data-verdict="bad" aria-hidden />
            {words.export.cannot}{" "}
            {say(problem ?? (emitted?.kind === "cannot" ? `${emitted.sentence} ${emitted.hint}` : ""))}
          </p>
        )}
        {emitted?.kind === "emitted" && (
          <>
            <span className="dim small">{words.export.warnings}</span>
            {emitted.warnings.length === 0 ? (
              <p className="small muted">{words.export.none}</p>
            ) : (
              <ul className="notes small">
                {emitted.warnings.map(says => (
                  <li key={says}>{say(says)}</li>
                ))}
              </ul>
            )}
          </>
        )}
        {dialect.cannot.length > 0 && (
          <details className="small">
            <summary>{words.export.cannotDo}</summary>
            <ul className="notes">
              {dialect.cannot.map(({ what, because }) => (
                <li key={what}>
                  <b>{say(what)}</b>: {say(because)}
                </li>
              ))}
            </ul>
          </details>
        )}
      </div>
      <div className="export-main stack">
        {file && (
          <>
            <div className="row-flex export-head">
              <Segments
                label={words.export.files}
                className="seg small-seg"
                value={String(Math.min(chosen, files.length - 1))}
                onChange={value => setChosen(Number(value))}
                options={files.map((each, i) => ({ value: String(i), words: each.name }))}
              />
              <span className="dim small">{words.export.lines(file.lines.length)}</span>
              <span className="grow" />
              <button className="btn" onClick={() => void copy(file.text)}>
                {words.export.copy}
              </button>
              <button className="btn" onClick={downloadFiles}>
                {words.export.downloadFiles}
              </button>
              <button className="btn primary" onClick={downloadZip}>
                {words.export.download}
              </button>
            </div>
            <CodeView
              text={file.text}
              dialect={id}
              label={`${words.export.text} ${file.name}`}
              height="min(54vh, 520px)"
              marked={line => selected !== "" && stepOf(line) === selected}
              onLine={line => {
                const step = stepOf(line);
                if (step) select({ kind: "step", id: step });
              }}
            />
            <p className="small dim">{nameOfSelected(program, selected)}</p>
          </>
        )}
        {working && !file && <p className="muted">{words.saving.saving}</p>}
      </div>
    </div>
  );
}

function nameOfSelected(program: NonNullable<ReturnType<typeof programOf>>, id: string): string {
  const found = findStep(program, id);
  return found ? words.export.step(stepWords(found.step, found.index)) : "";
}
