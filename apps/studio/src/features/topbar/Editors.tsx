import { CloudOff, Eye, Users } from "lucide-react";
import { useStore } from "zustand";
import { openDialog } from "../../stores/dialogs.ts";
import { colourOf, togetherStore } from "../../stores/together.ts";
import { Tip } from "../../ui/Tip.tsx";
import { words } from "../../messages/index.ts";

/** So many are shown by their initials; the rest is a number. */
const MAX_SHOWN = 4;

/** Who else is in this cell, and whether the others are reached; nothing while the cell is one's own. */
export function Editors() {
  const { state, editors, right } = useStore(togetherStore);
  if (state === "off") return null;
  const Icon = state === "offline" ? CloudOff : right === "look" ? Eye : Users;
  const says = [words.together.states[state], right === "write" ? "" : words.together.rights[right]].filter(Boolean);
  return (
    <Tip words={says.join(". ")}>
      <button
        className="editors"
        data-state={state}
        aria-label={`${words.together.title}: ${words.together.states[state]}, ${words.together.editors(editors.length)}`}
        onClick={() => openDialog("together")}
      >
        <Icon aria-hidden />
        {editors.slice(0, MAX_SHOWN).map(editor => (
          <i key={editor.connection} style={{ background: colourOf(editor) }} title={editor.who}>
            {initials(editor.who)}
          </i>
        ))}
        {editors.length > MAX_SHOWN && <span>+{editors.length - MAX_SHOWN}</span>}
      </button>
    </Tip>
  );
}

/** Two letters: of first and last name, or letter and number of somebody without one. */
function initials(who: string): string {
  const parts = who.split(/[\s@._-]+/).filter(Boolean);
  return [parts[0], parts.length > 1 ? parts.at(-1) : undefined]
    .map(part => part?.[0] ?? "")
    .join("")
    .toUpperCase();
}
