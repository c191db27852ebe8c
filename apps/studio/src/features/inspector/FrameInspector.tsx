import { Trash2 } from "lucide-react";
import { attachFrame, placeFrame, removeFrame, usesOfFrame, type CellDocument } from "@twincell/project";
import { commit } from "../../stores/document.ts";
import { select } from "../../stores/selection.ts";
import { jogStore } from "../../stores/jog.ts";
import { words } from "../../messages/index.ts";
import { AttachedTo } from "./AttachedTo.tsx";
import { PoseFields } from "./PoseFields.tsx";

export function FrameInspector({ document, name }: { document: CellDocument; name: string }) {
  const frame = document.frames.find(each => each.name === name);
  if (!frame) return <p className="empty">{words.inspector.nothing}</p>;
  const uses = usesOfFrame(document, name);
  const remove = (): void => {
    const done = commit(words.inspector.removeFrame, before => removeFrame(before, name));
    if (!done) return;
    if (jogStore.getState().userFrame === name) jogStore.setState({ frame: "world", userFrame: "" });
    select(null);
  };
  return (
    <section aria-label={name}>
      <h2 className="heading">
        <span className="grow">{name}</span>
        <span className="tag">{words.inspector.frame}</span>
      </h2>
      <div className="section stack">
        <PoseFields
          pose={frame.worldFromFrame}
          onChange={(pose, done) =>
            commit(
              words.undo.moveObject,
              before => placeFrame(before, name, { position: pose.position, quaternion: pose.quaternion }),
              done ? undefined : `frame ${name}`,
            )
          }
        />
        <AttachedTo
          objects={document.objects}
          value={frame.attachedTo?.object ?? null}
          onChange={object => commit(words.undo.attach, before => attachFrame(before, name, object))}
        />
        <button className="btn" onClick={() => jogStore.setState({ frame: "user", userFrame: name })}>
          {words.commands.frame(name)}
        </button>
        <button className="btn" disabled={uses > 0} onClick={remove}>
          <Trash2 />
          {words.inspector.removeFrame}
        </button>
        {uses > 0 && <p className="small muted">{words.inspector.frameUsed(uses)}</p>}
      </div>
    </section>
  );
}
