import { useState } from "react";
import { useStore } from "zustand";
import { cellStore } from "../../stores/cell.ts";
import { commit } from "../../stores/document.ts";
import { Tip } from "../../ui/Tip.tsx";
import { words } from "../../messages/index.ts";

/** The cell's name, typed in place, and whether it is kept. */
export function CellName() {
  const name = useStore(cellStore, state => state.document?.name ?? "");
  const saving = useStore(cellStore, state => state.saving);
  const [typed, setTyped] = useState<string | null>(null);
  const take = (): void => {
    const wanted = typed?.trim();
    if (wanted)
      commit(words.undo.cellName, document => (document.name === wanted ? document : { ...document, name: wanted }));
    setTyped(null);
  };
  return (
    <div className="cellname">
      <input
        aria-label={words.top.rename}
        value={typed ?? name}
        size={Math.max(6, (typed ?? name).length)}
        spellCheck={false}
        maxLength={80}
        onChange={event => setTyped(event.currentTarget.value)}
        onBlur={take}
        onKeyDown={event => {
          if (event.key === "Enter") event.currentTarget.blur();
          if (event.key === "Escape") {
            setTyped(null);
            event.stopPropagation();
          }
        }}
      />
      <Tip words={saving.kind === "problem" ? saving.sentence : words.saving.tip}>
        <span className="cellname-saving" data-kind={saving.kind} tabIndex={0} role="status">
          · {words.saving[saving.kind]}
        </span>
      </Tip>
    </div>
  );
}
