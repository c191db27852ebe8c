import { Copy, Download } from "lucide-react";
import { Tabs } from "radix-ui";
import { useMemo, useState } from "react";
import { useStore } from "zustand";
import { dialectById, DIALECTS, proveText } from "@twincell/languages";
import { degrees, type Dialect, type EmittedFile, type Program, type Robot } from "@twincell/core";
import type { CellDocument } from "@twincell/project";
import { cellStore } from "../../stores/cell.ts";
import { closeDialog, dialogStore } from "../../stores/dialogs.ts";
import { programOf, robotOf } from "../../stores/document.ts";
import { notify } from "../../stores/notices.ts";
import { download } from "../../ui/download.ts";
import { Frame } from "../../ui/Frame.tsx";
import { words } from "../../words/index.ts";
import { Import } from "./Import.tsx";
import { Text } from "./Text.tsx";
import "./export.css";

/** Program to the controller's own language, and back. */
export default function Export() {
  const open = useStore(dialogStore, state => state.open), document = useStore(cellStore, state => state.document);
  const program = programOf(document), robot = robotOf(document);
  if (open === "import") return <Import />;
  if (open !== "export" || !document || !program || !robot) return null;
  return <ExportFrame document={document} program={program} robot={robot} />;
}

function ExportFrame({ document, program, robot }: { readonly document: CellDocument; readonly program: Program; readonly robot: Robot }) {
  const [id, choose] = useState(DIALECTS[0]!.id), dialect = dialectById(id)!;
  const emitted = useMemo(() => dialect.emit(program, robot, document.robot.worldFromBase), [dialect, program, robot, document.robot.worldFromBase]);
  const files = emitted.kind === "emitted" ? emitted.files : [];
  const [chosen, show] = useState(0), file = files[Math.min(chosen, files.length - 1)];
  return (
    <Frame
      open title={words.export.title} onClose={closeDialog} width={880}
      foot={file && <>
        <button className="btn" onClick={() => { void copy(file); }}><Copy />{words.export.copy}</button>
        <button className="btn primary" onClick={() => { saveAll(dialect, files, program, robot); }}><Download />{words.export.download}</button>
      </>}
    >
      <div className="export-head">
        <label>{words.export.dialect} <select value={id} onChange={event => { choose(event.target.value); show(0); }}>
          {DIALECTS.map(each => <option key={each.id} value={each.id}>{each.brand} · {each.name}</option>)}
        </select></label>
        <span className="tag">{dialect.maturity === "proven" ? words.export.proven : words.export.experimental}</span>
      </div>
      {emitted.kind === "cannot"
        ? <div role="alert" className="export-cannot"><p><b>{words.export.cannot}</b> {emitted.sentence}</p><p className="muted">{emitted.hint}</p></div>
        : <>
          <Tabs.Root value={file?.name ?? ""} onValueChange={name => { show(files.findIndex(each => each.name === name)); }}>
            <Tabs.List className="export-tabs" aria-label={words.export.files}>
              {files.map(each => <Tabs.Trigger key={each.name} value={each.name} className="export-tab">{each.name} <span className="dim">{words.export.lines(lineCount(each))}</span></Tabs.Trigger>)}
            </Tabs.List>
            {file && <Tabs.Content value={file.name} className="export-file"><Text file={file} program={program} /></Tabs.Content>}
          </Tabs.Root>
          {file && <Proven dialect={dialect} file={file} program={program} robot={robot} document={document} />}
          {emitted.warnings.length > 0 && <ul className="export-notes" aria-label={words.export.warnings}>{emitted.warnings.map(warning => <li key={warning}>{warning}</li>)}</ul>}
        </>}
      {dialect.cannot.length > 0 && <details className="small"><summary>{words.export.cannotDo}</summary><ul>{dialect.cannot.map(({ what, because }) => <li key={what}>{what}: {because}</li>)}</ul></details>}
    </Frame>
  );
}

const lineCount = (file: EmittedFile): number => file.text.split("\n").length - (file.text.endsWith("\n") ? 1 : 0);

/** The emitted text, executed by the interpreter and compared with the plan. Only programs can be executed, lists of points cannot. */
function Proven({ dialect, file, program, robot, document }: { readonly dialect: Dialect; readonly file: EmittedFile; readonly program: Program; readonly robot: Robot; readonly document: CellDocument }) {
  const proof = useMemo(
    () => (/^\s*\.PROGRAM/im.test(file.text) ? proveText(dialect, file, program, robot, document.robot.worldFromBase) : null),
    [dialect, file, program, robot, document.robot.worldFromBase],
  );
  if (!proof) return null;
  if (proof.kind === "proven") return <p className="export-proof" data-testid="proof">✓ {words.export.proof((proof.worst_m * 1000).toFixed(4), degrees(proof.worst_rad).toFixed(5))}</p>;
  return <p role="alert" className="export-cannot">{proof.sentence}</p>;
}

async function copy(file: EmittedFile): Promise<void> {
  try {
    await navigator.clipboard.writeText(file.text);
    notify("done", words.export.copied);
  } catch {
    notify("warn", words.export.notCopied, words.export.notCopiedHint);
  }
}

/** All files and a manifest that says what they are and where each step went. */
function saveAll(dialect: Dialect, files: readonly EmittedFile[], program: Program, robot: Robot): void {
  const manifest = {
    format: "twincell.export", version: 1, dialect: dialect.id, robot: robot.id, program: program.name,
    files: files.map(file => ({ name: file.name, lines: lineCount(file), steps: file.lines.flatMap((step, i) => (step ? [{ line: i + 1, step }] : [])) })),
  };
  for (const file of files) download(file.name, new Blob([file.text], { type: "text/plain" }));
  download(`${program.name.replace(/[^\w-]+/g, "_") || "program"}.manifest.json`, new Blob([JSON.stringify(manifest, null, 1)], { type: "application/json" }));
}
