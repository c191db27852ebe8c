import {
  changedTool,
  partById,
  partNumbers,
  pointsTaughtWith,
  swappedTool,
  toolMass,
  type CellDocument,
  type ToolRecord,
} from "@twincell/project";
import { saveGripperUrdf } from "../../runtime/robot-files.ts";
import { cellStore } from "../../stores/cell.ts";
import { commit, toolOf } from "../../stores/document.ts";
import { notify } from "../../stores/notices.ts";
import { Chooser } from "../../ui/Choice.tsx";
import { NumberField } from "../../ui/NumberField.tsx";
import { words } from "../../messages/index.ts";
import { PoseFields } from "./PoseFields.tsx";

const changeTool = (name: string, change: (tool: ToolRecord) => ToolRecord, done: boolean): boolean =>
  commit(
    words.undo.tool,
    before => ({ ...before, tools: before.tools.map(each => (each.name === name ? change(each) : each)) }),
    done ? undefined : "tool",
  );

/** What was taught with another tool is carried out with the one in use (row M-63). */
function takeOver(from: string): void {
  const { document } = cellStore.getState();
  if (!document) return;
  const points = pointsTaughtWith(document, from);
  if (commit(words.tools.undoExchange, before => swappedTool(before, from, before.tool)))
    notify("done", words.tools.exchanged(nameOf(from), nameOf(document.tool), points));
}

function remove(name: string): void {
  const { document } = cellStore.getState();
  const points = document ? pointsTaughtWith(document, name) : 0;
  if (points > 0) {
    notify("warn", words.tools.stillUsed(name, points));
    return;
  }
  commit(words.undo.tool, before => ({
    ...before,
    tool: before.tool === name ? "flange" : before.tool,
    tools: before.tools.filter(each => each.name !== name),
  }));
}

const nameOf = (tool: string): string => (tool === "flange" ? words.tools.bare : tool);

export function ToolInspector({ document }: { document: CellDocument }) {
  const tool = toolOf(document);
  const others = ["flange", ...document.tools.map(({ name }) => name)].filter(
    name => name !== document.tool && pointsTaughtWith(document, name) > 0,
  );
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
        {others.map(name => (
          <button key={name} className="btn small" title={words.tools.takesOverSays} onClick={() => takeOver(name)}>
            {words.tools.takesOver(nameOf(name))}
          </button>
        ))}
        {tool && (
          <>
            <ToolNumbers tool={tool} />
            <div className="pair">
              <span className="label">{words.parts.mass}</span>
              <NumberField
                label={words.parts.mass}
                mark="kg"
                quantity="plain"
                decimals={3}
                min={0.001}
                max={10_000}
                value={toolMass(tool) ?? 0}
                onChange={(mass_kg, done) => changeTool(tool.name, each => ({ ...each, mass_kg }), done)}
              />
            </div>
            <h3 className="label">{words.inspector.tcp}</h3>
            <PoseFields
              pose={tool.flangeFromTcp}
              onChange={({ position, quaternion }, done) =>
                changeTool(tool.name, each => ({ ...each, flangeFromTcp: { position, quaternion } }), done)
              }
            />
            {tool.shape?.kind === "part" && tool.shape.part === "two-fingers" && (
              <button className="btn small" title={words.tools.gripperUrdfSays} onClick={() => void saveGripperUrdf()}>
                {words.own.saveUrdf}
              </button>
            )}
            <button className="btn small" onClick={() => remove(tool.name)}>
              {words.tools.remove}
            </button>
          </>
        )}
      </div>
    </section>
  );
}

/** The numbers of a tool of the library; its TCP follows them. */
function ToolNumbers({ tool }: { tool: ToolRecord }) {
  const kind = tool.shape?.kind === "part" ? partById(tool.shape.part) : undefined;
  if (tool.shape?.kind !== "part" || kind === undefined) return null;
  const numbers = partNumbers(kind, tool.shape.parameters);
  return kind.parameters.map(({ id, quantity, min, max }) => {
    const label = kind.id === "two-fingers" && id === "width" ? words.parts.opening : words.parts.parameters[id];
    return (
      <div className="pair" key={id}>
        <span className="label">{label}</span>
        <NumberField
          label={label}
          quantity={quantity}
          min={min}
          max={max}
          decimals={1}
          value={numbers[id]!}
          onChange={(value, done) => changeTool(tool.name, each => changedTool(each, { [id]: value }), done)}
        />
      </div>
    );
  });
}
