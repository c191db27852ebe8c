import type { CellDocument } from "@twincell/project";
import { commit, toolOf } from "../../stores/document.ts";
import { Chooser } from "../../ui/Choice.tsx";
import { words } from "../../messages/index.ts";
import { PoseFields } from "./PoseFields.tsx";

export function ToolInspector({ document }: { document: CellDocument }) {
  const tool = toolOf(document);
  return (
    <section aria-label={words.inspector.tool}>
      <h2 className="heading">
        <span className="grow">{words.inspector.tool}</span>
      </h2>
      <div className="section stack">
        <Chooser
          label={words.inspector.tool}
          value={document.tool}
          onChange={name =>
            commit(words.undo.tool, before => (before.tool === name ? before : { ...before, tool: name }))
          }
          options={[
            { value: "flange", words: words.tree.noTool },
            ...document.tools.map(each => ({ value: each.name, words: each.name })),
          ]}
        />
        {tool && (
          <>
            <h3 className="label">{words.inspector.tcp}</h3>
            <PoseFields
              pose={tool.flangeFromTcp}
              onChange={(pose, done) =>
                commit(
                  words.undo.tool,
                  before => ({
                    ...before,
                    tools: before.tools.map(each =>
                      each.name === tool.name
                        ? { ...each, flangeFromTcp: { position: pose.position, quaternion: pose.quaternion } }
                        : each,
                    ),
                  }),
                  done ? undefined : "tool",
                )
              }
            />
          </>
        )}
      </div>
    </section>
  );
}
