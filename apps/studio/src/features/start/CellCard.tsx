import { Box, Copy, History, Pencil, Trash2 } from "lucide-react";
import { useState } from "react";
import { useStore } from "zustand";
import { commit } from "../../stores/document.ts";
import { libraryStore, theLibrary, type StoredCell } from "../../stores/library.ts";
import { notify } from "../../stores/notices.ts";
import { words } from "../../messages/index.ts";
import { moment } from "../../messages/numbers.ts";
import { sayWhen } from "./list.ts";

interface Props {
  readonly cell: StoredCell;
  /** By what it was found inside. */
  readonly where: string | null;
  readonly robot: string;
  readonly now_ms: number;
  readonly onOpen: (version?: number) => void;
  readonly onTrash: () => void;
  readonly onPutBack: () => void;
  readonly onDuplicate: () => void;
}

/**
 * One cell: picture, name, what its check found, when it was last changed. Enter opens, F2 renames, Delete moves it to
 * the trash.
 */
export function CellCard({ cell, where, robot, now_ms, onOpen, onTrash, onPutBack, onDuplicate }: Props) {
  const current = useStore(libraryStore, state => state.current === cell.id);
  const [renaming, setRenaming] = useState(false);
  const [versions, setVersions] = useState(false);
  const trashed = cell.trashed_ms !== null;
  return (
    <li className="start-card" data-current={current}>
      <button
        className="start-picture"
        aria-label={trashed ? `${words.cells.putBack}: ${cell.name}` : words.cells.open(cell.name)}
        onClick={() => (trashed ? onPutBack() : onOpen())}
        onKeyDown={event => {
          if (trashed) return;
          if (event.key === "F2") setRenaming(true);
          else if (event.key === "Delete") onTrash();
          else return;
          event.preventDefault();
          event.stopPropagation();
        }}
      >
        {cell.thumbnail ? <img src={cell.thumbnail} alt="" /> : <Box aria-hidden />}
      </button>
      {renaming ? (
        <NameField cell={cell} current={current} onDone={() => setRenaming(false)} />
      ) : (
        <b className="start-name" title={cell.name}>
          {cell.name}
        </b>
      )}
      <p className="start-line small">
        <i className="mark" data-verdict={cell.verdict ?? "unknown"} aria-hidden />
        <span className="grow">{where === null ? `${robot} · ${verdictOf(cell)}` : words.cells.found(where)}</span>
        <span className="dim">{current ? words.cells.openNow : sayWhen(cell.saved_ms, now_ms)}</span>
      </p>
      <div className="start-actions">
        {trashed ? (
          <button className="btn" onClick={onPutBack}>
            {words.cells.putBack}
          </button>
        ) : (
          <>
            <Action words={words.cells.rename(cell.name)} glyph={<Pencil />} onClick={() => setRenaming(true)} />
            <Action words={words.cells.duplicate(cell.name)} glyph={<Copy />} onClick={onDuplicate} />
            <Action
              words={words.cells.versions(cell.name)}
              glyph={<History />}
              pressed={versions}
              onClick={() => setVersions(shown => !shown)}
            />
            <Action words={words.cells.toTrash(cell.name)} glyph={<Trash2 />} onClick={onTrash} />
          </>
        )}
      </div>
      {versions && (
        <ol className="start-versions" aria-label={words.cells.versions(cell.name)}>
          {[...cell.versions].reverse().map(version => (
            <li key={version.number}>
              <span className="grow small">{moment(version.saved_ms)}</span>
              <button className="btn" onClick={() => onOpen(version.number)}>
                {words.cells.goBack}
              </button>
            </li>
          ))}
        </ol>
      )}
    </li>
  );
}

function verdictOf(cell: StoredCell): string {
  const verdict = cell.verdict ?? "unknown";
  return verdict === "bad" ? words.cells.verdict.bad(cell.findings ?? 1) : words.cells.verdict[verdict];
}

function Action({
  words: label,
  glyph,
  pressed,
  onClick,
}: {
  words: string;
  glyph: React.ReactNode;
  pressed?: boolean;
  onClick: () => void;
}) {
  return (
    <button className="btn quiet icon" aria-label={label} title={label} aria-pressed={pressed} onClick={onClick}>
      {glyph}
    </button>
  );
}

function NameField({ cell, current, onDone }: { cell: StoredCell; current: boolean; onDone: () => void }) {
  const [typed, setTyped] = useState(cell.name);
  const take = (): void => {
    const name = typed.trim();
    onDone();
    if (name === "" || name === cell.name) return;
    if (current) commit(words.undo.cellName, document => ({ ...document, name }));
    theLibrary()
      ?.rename(cell.id, name)
      .catch((problem: unknown) =>
        notify("bad", words.cells.failed(problem instanceof Error ? problem.message : String(problem))),
      );
  };
  return (
    <div className="field text">
      <input
        autoFocus
        aria-label={words.cells.rename(cell.name)}
        value={typed}
        maxLength={80}
        onFocus={event => event.currentTarget.select()}
        onChange={event => setTyped(event.currentTarget.value)}
        onBlur={take}
        onKeyDown={event => {
          if (event.key === "Enter") event.currentTarget.blur();
          if (event.key === "Escape") {
            event.stopPropagation();
            onDone();
          }
        }}
      />
    </div>
  );
}
