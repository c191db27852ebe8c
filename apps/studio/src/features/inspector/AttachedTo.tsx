import type { ObjectRecord } from "@twincell/project";
import { Chooser } from "../../ui/Choice.tsx";
import { words } from "../../messages/index.ts";

const NOTHING = "none";
const valueOf = (id: string): string => `object ${id}`;

/** The object that a frame or taught points belong to and follow; the cell itself when none. */
export function AttachedTo({
  objects,
  value,
  onChange,
}: {
  objects: readonly ObjectRecord[];
  value: string | null;
  onChange: (object: string | null) => void;
}) {
  return (
    <div className="pair">
      <span className="label">{words.inspector.attachedTo}</span>
      <Chooser
        label={words.inspector.attachedTo}
        value={value === null ? NOTHING : valueOf(value)}
        options={[
          { value: NOTHING, words: words.inspector.attachedToCell },
          ...objects.filter(({ role }) => role !== "wall").map(({ id, name }) => ({ value: valueOf(id), words: name })),
        ]}
        onChange={chosen => onChange(chosen === NOTHING ? null : chosen.slice(valueOf("").length))}
      />
    </div>
  );
}
