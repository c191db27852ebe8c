import { useState } from "react";
import { useStore } from "zustand";
import { vPlus } from "@twincell/languages";
import type { TextFault } from "@twincell/core";
import { cellStore } from "../../stores/cell.ts";
import { closeDialog, dialogStore } from "../../stores/dialogs.ts";
import { commit, robotOf, withProgram } from "../../stores/document.ts";
import { notify } from "../../stores/notices.ts";
import { Frame } from "../../ui/Frame.tsx";
import { words } from "../../words/index.ts";

/** A V+ text becomes the steps of the current program; undo brings the old ones back. */
export function Import() {
  const open = useStore(dialogStore, state => state.open === "import");
  const [text, write] = useState(""), [faults, tell] = useState<readonly TextFault[]>([]);
  const go = (): void => {
    const { document } = cellStore.getState(), robot = robotOf(document);
    if (!document || !robot) return;
    const parsed = vPlus.parse(text, robot, document.robot.worldFromBase);
    if (parsed.kind === "not-understood") { tell(parsed.faults); return; }
    const { steps, tools, frames, groups } = parsed.program;
    commit(words.undo.import, cell => withProgram(cell, program => ({ ...program, steps, groups, tools: { ...program.tools, ...tools }, frames: { ...program.frames, ...frames } })));
    notify("done", words.export.imported(steps.length));
    closeDialog();
  };
  return (
    <Frame open={open} title={words.export.import} onClose={closeDialog} width={720} foot={<button className="btn primary" disabled={text.trim() === ""} onClick={go}>{words.export.importGo}</button>}>
      <p className="muted">{words.export.importSays}</p>
      <textarea
        className="export-paste" aria-label={words.export.paste} value={text} spellCheck={false} rows={14}
        onChange={event => { write(event.target.value); tell([]); }}
        onDrop={event => {
          const [file] = event.dataTransfer.files;
          if (!file) return;
          event.preventDefault();
          file.text().then(write, (trouble: unknown) => { notify("bad", words.file.unreadable(file.name), trouble instanceof Error ? trouble.message : undefined); });
        }}
      />
      {faults.length > 0 && <ul role="alert" className="export-faults">{faults.slice(0, 8).map((fault, i) => <li key={i}>{words.export.line(fault.line, fault.column, fault.sentence)}</li>)}{faults.length > 8 && <li>{words.check.more(faults.length - 8)}</li>}</ul>}
    </Frame>
  );
}
