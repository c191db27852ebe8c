import { Copy, Link2Off, LogOut, Share2, Users } from "lucide-react";
import type { Editor } from "@twincell/project/sharing";
import { get, keys, set, del } from "idb-keyval";
import { useEffect, useState } from "react";
import { useStore } from "zustand";
import { joinCell, leaveCell, linkCell, listCells, shareOpenCell, unlinkCell } from "../../runtime/together.ts";
import { closeDialog, dialogStore } from "../../stores/dialogs.ts";
import type { KeyValueStore } from "../../stores/keeper.ts";
import { notify } from "../../stores/notices.ts";
import { cellStore } from "../../stores/cell.ts";
import { stepWords, findStep } from "../../stores/program.ts";
import { programOf } from "../../stores/document.ts";
import { colourOf, togetherStore } from "../../stores/together.ts";
import { Frame } from "../../ui/Frame.tsx";
import { words } from "../../messages/index.ts";
import "./together.css";

const browserStore: KeyValueStore = {
  get: key => get(key),
  set: (key, value) => set(key, value),
  keys: () => keys(),
  delete: key => del(key),
};
const told = (done: Promise<unknown>): void => {
  done.catch((problem: unknown) => notify("bad", problem instanceof Error ? problem.message : String(problem)));
};

/** Cells of the server that several people edit, who is in this one, and a link for those who only look. */
export default function Together() {
  const open = useStore(dialogStore, state => state.open === "together");
  const off = useStore(togetherStore, state => state.state === "off");
  return (
    <Frame open={open} title={words.together.title} onClose={closeDialog} width={520}>
      {open && (off ? <Alone /> : <Here />)}
    </Frame>
  );
}

function Alone() {
  const [names, setNames] = useState<readonly string[] | null>(null);
  const [why, setWhy] = useState("");
  useEffect(() => {
    void listCells().then(listed => {
      if (listed.kind === "answer") setNames(listed.value.names);
      else setWhy(listed.sentence);
    });
  }, []);
  return (
    <div className="stack edit-together">
      <p className="small muted">{words.together.alone}</p>
      <button
        className="btn primary"
        onClick={() =>
          told(
            shareOpenCell(browserStore).then(sentence => {
              if (sentence !== null) notify("bad", sentence);
            }),
          )
        }
      >
        <Share2 />
        {words.together.share}
      </button>
      {why !== "" && <p className="small">{why}</p>}
      {names !== null && <h3 className="heading">{words.together.open}</h3>}
      {names?.length === 0 && <p className="small muted">{words.together.none}</p>}
      {names?.map(name => (
        <div key={name} className="row-flex edit-together-row">
          <span className="grow">{name}</span>
          <button
            className="btn"
            aria-label={words.together.join(name)}
            onClick={() => {
              closeDialog();
              told(joinCell(name, browserStore));
            }}
          >
            <Users />
            {words.common.open}
          </button>
        </div>
      ))}
    </div>
  );
}

function Here() {
  const { cell, state, who, right, waiting, editors } = useStore(togetherStore);
  const [link, setLink] = useState("");
  const copy = (): void => {
    void linkCell(cell).then(made => {
      if (made.kind === "no") {
        notify("bad", made.sentence);
        return;
      }
      setLink(made.value.link);
      void navigator.clipboard.writeText(made.value.link).then(
        () => notify("done", words.people.copied),
        () => undefined, // The link is shown: it can be copied by hand.
      );
    });
  };
  return (
    <div className="stack edit-together">
      <p>
        {words.together.in(cell)} <span className="small muted">· {words.together.states[state]}</span>
        {waiting > 0 && <span className="small muted"> · {words.together.waiting(waiting)}</span>}
      </p>
      <ul className="edit-together-people" aria-label={words.together.title}>
        <li>
          <i aria-hidden style={{ background: "var(--accent)" }} />
          {words.together.here(who, words.together.you)}
        </li>
        {editors.map(editor => (
          <Somebody key={editor.connection} editor={editor} />
        ))}
      </ul>
      {editors.length === 0 && <p className="small muted">{words.together.nobody}</p>}
      {right !== "write" && <p className="small">{words.together.rights[right]}</p>}
      {right === "write" && (
        <>
          <h3 className="heading">{words.together.link}</h3>
          <p className="small muted">{words.together.linkSays}</p>
          {link !== "" && <code className="people-link">{link}</code>}
          <div className="row-flex edit-together-row">
            <button className="btn" onClick={copy}>
              <Copy />
              {words.people.copy}
            </button>
            <button
              className="btn"
              onClick={() => {
                void unlinkCell(cell).then(gone => {
                  setLink("");
                  if (gone.kind === "no") notify("info", gone.sentence);
                  else notify("done", words.together.unlinked);
                });
              }}
            >
              <Link2Off />
              {words.together.unlink}
            </button>
          </div>
        </>
      )}
      <button
        className="btn"
        onClick={() => {
          leaveCell();
        }}
      >
        <LogOut />
        {words.together.leave}
      </button>
    </div>
  );
}

function Somebody({ editor }: { readonly editor: Editor }) {
  const document = useStore(cellStore, state => state.document);
  const { presence } = editor;
  const step = presence?.selected?.kind === "step" ? presence.selected.id : null;
  const program = document && step !== null && presence?.program === document.program ? programOf(document) : null;
  const found = program && step !== null ? findStep(program, step) : undefined;
  const what = found
    ? `${presence!.program}, ${stepWords(found.step, found.index)}`
    : (presence?.program ?? words.together.states.opening);
  return (
    <li>
      <i aria-hidden style={{ background: colourOf(editor) }} />
      {words.together.here(editor.who, what)}
    </li>
  );
}
