import { emptyCell, EXAMPLES } from "@twincell/project";
import { robotById } from "@twincell/core";
import { Plus, Upload } from "lucide-react";
import { useEffect, useMemo, useState } from "react";
import { useStore } from "zustand";
import { runCommand } from "../../stores/commands.ts";
import { closeDialog, dialogStore } from "../../stores/dialogs.ts";
import { libraryStore, theLibrary, type StoredCell } from "../../stores/library.ts";
import { notify } from "../../stores/notices.ts";
import { keepPresent, openCell, openStored, trashCell } from "../../stores/opening.ts";
import { shortName } from "../../stores/robot.ts";
import { Frame } from "../../ui/Frame.tsx";
import { say, words } from "../../messages/index.ts";
import { CellCard } from "./CellCard.tsx";
import { findCells } from "./list.ts";
import "./start.css";

const robotName = (id: string): string => {
  const robot = robotById(id);
  return robot ? shortName(robot) : id;
};
/** What went wrong is one sentence; the cells stay as they are. */
const told = (done: Promise<unknown>): void => {
  done.catch((problem: unknown) =>
    notify("bad", words.cells.failed(problem instanceof Error ? problem.message : String(problem))),
  );
};

/** All cells of this browser: open, search, rename, duplicate, trash, and versions to go back to. */
export default function Start() {
  const open = useStore(dialogStore, state => state.open === "cells");
  return (
    <Frame open={open} title={words.cells.title} onClose={closeDialog} width={1180}>
      {open && <Cells />}
    </Frame>
  );
}

function Cells() {
  const cells = useStore(libraryStore, state => state.cells) ?? [];
  const [query, setQuery] = useState("");
  const [inTrash, setInTrash] = useState(false);
  const [trashed, setTrashed] = useState<StoredCell | null>(null);
  const [now_ms] = useState(() => Date.now());
  const examples = useMemo(() => EXAMPLES.map(({ id, sentence, make }) => ({ id, sentence, example: make() })), []);
  useEffect(() => {
    keepPresent();
    told(theLibrary()?.flush() ?? Promise.resolve());
  }, []);
  const shown = cells.filter(cell => (cell.trashed_ms !== null) === inTrash);
  const found = findCells(shown, query, robotName);
  const trash = (cell: StoredCell): void => told(trashCell(cell.id).then(() => setTrashed(cell)));
  const putBack = (cell: StoredCell): void =>
    told(
      theLibrary()
        ?.putBack(cell.id)
        .then(() => setTrashed(null)) ?? Promise.resolve(),
    );
  const openExample = (document: ReturnType<typeof emptyCell>): void => {
    closeDialog();
    openCell(document);
  };
  return (
    <div className="start">
      <div className="start-bar">
        <button className="btn" aria-pressed={!inTrash} onClick={() => setInTrash(false)}>
          {words.cells.all(cells.filter(cell => cell.trashed_ms === null).length)}
        </button>
        <button className="btn" aria-pressed={inTrash} onClick={() => setInTrash(true)}>
          {words.cells.trash(cells.filter(cell => cell.trashed_ms !== null).length)}
        </button>
        <div className="field text start-search">
          <input
            type="search"
            aria-label={words.cells.search}
            placeholder={words.cells.search}
            value={query}
            onChange={event => setQuery(event.currentTarget.value)}
          />
        </div>
        <button className="btn primary" onClick={() => openExample(emptyCell())}>
          <Plus aria-hidden /> {words.cells.fresh}
        </button>
      </div>
      {query !== "" && found.length === 0 && (
        <p className="empty">
          {words.cells.none(query)}{" "}
          <button className="btn" onClick={() => setQuery("")}>
            {words.cells.clear}
          </button>
        </p>
      )}
      {query === "" && shown.length === 0 && (
        <p className="empty">{inTrash ? words.cells.trashEmpty : words.cells.noneYet}</p>
      )}
      <ul className="start-grid" aria-label={words.cells.title}>
        {found.map(({ cell, where }) => (
          <CellCard
            key={cell.id}
            cell={cell}
            where={where}
            now_ms={now_ms}
            robot={cell.robotName ?? robotName(cell.robot)}
            onOpen={version => {
              closeDialog();
              told(openStored(cell.id, version));
            }}
            onTrash={() => trash(cell)}
            onPutBack={() => putBack(cell)}
            onDuplicate={() => told(theLibrary()?.duplicate(cell.id) ?? Promise.resolve())}
          />
        ))}
        {!inTrash && (
          <li>
            <button className="start-drop" onClick={() => runCommand("file.load")}>
              <Upload aria-hidden />
              <b>{words.cells.dropTitle}</b>
              <span>{words.cells.dropSays}</span>
              <span className="start-choose">{words.cells.openFile}</span>
            </button>
          </li>
        )}
      </ul>
      {!inTrash && (
        <section aria-label={words.cells.examples}>
          <h3 className="start-head">
            {words.cells.examples} <span className="muted small">{words.cells.examplesSay}</span>
          </h3>
          <div className="start-examples">
            {examples.map(({ id, sentence, example }) => (
              <button
                key={id}
                className="start-example"
                aria-label={words.cells.openExample(say(example.name))}
                onClick={() => openExample(example)}
              >
                <b>{say(example.name)}</b>
                <span className="muted small">{robotName(example.robot.id)}</span>
                <span className="small">{say(sentence)}</span>
              </button>
            ))}
          </div>
        </section>
      )}
      {trashed && (
        <p className="start-trashed" role="status">
          <span className="grow">{words.cells.trashed(trashed.name)}</span>
          <button className="btn" onClick={() => putBack(trashed)}>
            {words.cells.putBack}
          </button>
        </p>
      )}
    </div>
  );
}
