import type { Skipped, TextFault } from "@twincell/core";
import { DIALECTS } from "@twincell/languages";
import { useEffect, useRef, useState, type DragEvent } from "react";
import { useStore } from "zustand";
import { readText, type Reading } from "../../runtime/planning/reading.ts";
import { cellStore } from "../../stores/cell.ts";
import { controlStore } from "../../stores/control.ts";
import { closeDialog } from "../../stores/dialogs.ts";
import { robotOf } from "../../stores/document.ts";
import { foreignStore, openForeign } from "../../stores/foreign.ts";
import { importParsed } from "../../stores/importing.ts";
import { notify } from "../../stores/notices.ts";
import { showMode, viewStore } from "../../stores/view.ts";
import { Chooser } from "../../ui/Choice.tsx";
import { Frame } from "../../ui/Frame.tsx";
import { words } from "../../messages/index.ts";
import { skippedWords } from "../../messages/phrases.ts";

const GUESS = "guess";
/** Typing settles before the text is read. */
const WAIT_MS = 250;
const MOST_FAULTS = 12;

/** A program text of any language becomes steps, or is run as it stands. */
export function ImportDialog({ open }: { open: boolean }) {
  return (
    <Frame open={open} title={words.export.import} onClose={closeDialog} width={960}>
      {open && <Body />}
    </Frame>
  );
}

function Body() {
  const { text, name } = useStore(foreignStore, state => state.draft);
  const cell = useStore(cellStore, state => state.document);
  const robot = robotOf(cell);
  const running = useStore(controlStore, state => state.running);
  const [wanted, setWanted] = useState(GUESS);
  const [skips, setSkips] = useState(false);
  const [reading, setReading] = useState<Reading | null>(null);
  const area = useRef<HTMLTextAreaElement>(null);
  const set = (next: string, file = ""): void => foreignStore.setState({ draft: { text: next, name: file } });
  useEffect(() => {
    if (!robot || !cell || text.trim() === "") {
      setReading(null);
      return undefined;
    }
    const timer = setTimeout(
      () =>
        setReading(
          readText(text, robot, cell.robot.worldFromBase, name, wanted === GUESS ? undefined : wanted, skips) ?? null,
        ),
      WAIT_MS,
    );
    return () => clearTimeout(timer);
  }, [text, name, wanted, skips, robot, cell]);

  const skipped =
    reading?.parsed.kind === "parsed"
      ? [...(reading.parsed.skipped ?? [])].sort(
          (a, b) => Number(a.what === "statement") - Number(b.what === "statement"),
        )
      : [];
  const faults =
    reading === null ? [] : reading.parsed.kind === "parsed" ? reading.parsed.warnings : reading.parsed.faults;
  const understood = reading?.parsed.kind === "parsed" && reading.parsed.program.steps.length > 0;
  const look = ({ line, column }: TextFault): void => {
    const element = area.current;
    if (!element) return;
    const before = text
      .split("\n")
      .slice(0, line - 1)
      .reduce((sum, each) => sum + each.length + 1, 0);
    const height = parseFloat(getComputedStyle(element).lineHeight);
    element.focus();
    element.setSelectionRange(before + column - 1, before + (text.split("\n")[line - 1]?.length ?? 0));
    element.scrollTop = Math.max(0, (line - 4) * height);
  };
  const drop = (event: DragEvent): void => {
    const file = event.dataTransfer.files[0];
    if (!file) return;
    event.preventDefault();
    event.stopPropagation();
    file.text().then(
      content => set(content, file.name),
      () => notify("bad", words.file.unreadable(file.name)),
    );
  };
  const steps = (): void => {
    if (reading?.parsed.kind === "parsed" && importParsed(reading.parsed, name || reading.dialect.name)) {
      set("");
      closeDialog();
    }
  };
  const runIt = (): void => {
    if (!reading) return;
    openForeign({ name: name || words.foreign.pasted, dialect: reading.dialect.id, text, skipUnknown: skips });
    closeDialog();
    showMode("run");
    viewStore.setState({ sheet: "run" });
  };
  return (
    <div className="import">
      <div className="import-main">
        <p className="muted small">{words.export.importSays}</p>
        <textarea
          ref={area}
          className="import-text"
          aria-label={words.export.paste}
          value={text}
          spellCheck={false}
          wrap="off"
          onChange={event => set(event.currentTarget.value)}
          onDragOver={event => event.preventDefault()}
          onDrop={drop}
        />
      </div>
      <div className="import-side stack">
        <span className="dim small">{words.export.dialect}</span>
        <Chooser
          label={words.export.dialect}
          value={wanted}
          onChange={setWanted}
          options={[
            { value: GUESS, words: words.foreign.guess },
            ...DIALECTS.map(each => ({ value: each.id, words: `${each.name} · ${each.brand}` })),
          ]}
        />
        <p className="small" role="status">
          {reading === null
            ? words.foreign.nothing
            : understood && reading.parsed.kind === "parsed"
              ? words.foreign.reads(reading.dialect.name, reading.parsed.program.steps.length)
              : words.foreign.cannotRead(reading.dialect.name)}
        </p>
        {reading?.dialect.maturity === "experimental" && (
          <p className="small muted">
            <i className="mark" data-verdict="warn" aria-hidden /> {words.export.experimental}
          </p>
        )}
        {reading?.dialect.lines !== undefined && (skips || !understood) && (
          <label className="import-skip small">
            <input type="checkbox" checked={skips} onChange={event => setSkips(event.currentTarget.checked)} />
            <span>
              <b>{words.foreign.skip}</b>
              <br />
              <span className="muted">{words.foreign.skipSays}</span>
            </span>
          </label>
        )}
        {skipped.length > 0 && (
          <>
            <p className="small" role="alert">
              <i
                className="mark"
                data-verdict={skipped.some(({ what }) => what !== "statement") ? "bad" : "warn"}
                aria-hidden
              />{" "}
              {skippedWords(skipped)}
            </p>
            <Places faults={skipped} bad={each => "what" in each && each.what !== "statement"} look={look} />
          </>
        )}
        {faults.length > 0 && (
          <Places faults={faults} bad={() => !understood} look={look} role={understood ? "status" : "alert"} />
        )}
        <button className="btn primary" disabled={!understood} onClick={steps}>
          {words.foreign.steps}
        </button>
        <button className="btn" disabled={reading === null || running} onClick={runIt}>
          {words.foreign.asText}
        </button>
        <p className="small muted">{words.foreign.asTextSays}</p>
      </div>
    </div>
  );
}

/** Places in the text; a click goes there. */
function Places({
  faults,
  bad,
  look,
  role,
}: {
  readonly faults: readonly (TextFault | Skipped)[];
  readonly bad: (fault: TextFault | Skipped) => boolean;
  readonly look: (fault: TextFault) => void;
  readonly role?: "status" | "alert";
}) {
  return (
    <ul className="notes import-faults" role={role}>
      {faults.slice(0, MOST_FAULTS).map((fault, i) => (
        <li key={i}>
          <button className="import-fault" data-bad={bad(fault)} onClick={() => look(fault)}>
            {words.export.line(fault.line, fault.column, fault.sentence)}
          </button>
        </li>
      ))}
      {faults.length > MOST_FAULTS && <li className="small dim">{words.check.more(faults.length - MOST_FAULTS)}</li>}
    </ul>
  );
}
