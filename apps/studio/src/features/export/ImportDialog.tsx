import { useState } from "react";
import { closeDialog } from "../../stores/dialogs.ts";
import { importText } from "../../stores/importing.ts";
import { Frame } from "../../ui/Frame.tsx";
import { words } from "../../words/index.ts";

/** A program text becomes steps. */
export function ImportDialog({ open }: { open: boolean }) {
  const [text, setText] = useState(""), [faults, setFaults] = useState<readonly string[]>([]);
  const go = (): void => {
    const answer = importText(text);
    if (answer.length > 0) { setFaults(answer); return; }
    setText(""); setFaults([]);
    closeDialog();
  };
  return (
    <Frame open={open} title={words.export.import} onClose={closeDialog} foot={<button className="btn primary" disabled={text.trim() === ""} onClick={go}>{words.export.importGo}</button>}>
      <p className="muted">{words.export.importSays}</p>
      <textarea className="import-text" aria-label={words.export.paste} value={text} spellCheck={false} onChange={event => { setText(event.currentTarget.value); setFaults([]); }} />
      {faults.length > 0 && <ul className="notes" role="alert">{faults.slice(0, 8).map(says => <li key={says} className="field-fault">{says}</li>)}</ul>}
    </Frame>
  );
}
