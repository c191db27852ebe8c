import { Axis3d, Box, Cone, Cylinder, Plus, Wrench } from "lucide-react";
import type { ObjectRecord } from "@twincell/project";
import { ContextMenu } from "radix-ui";
import { useState, type ReactNode } from "react";
import { useStore } from "zustand";
import { cellStore } from "../../stores/cell.ts";
import { runCommand } from "../../stores/commands.ts";
import { robotOf } from "../../stores/document.ts";
import { deleteObject, duplicateObject, renameObject, toggleHidden, toggleLocked } from "../../stores/objects.ts";
import { shortName } from "../../stores/robot.ts";
import { hover, select, selectionStore, type Thing } from "../../stores/selection.ts";
import { showKeys } from "../../ui/keys.ts";
import { Tip } from "../../ui/Tip.tsx";
import { words } from "../../messages/index.ts";

const same = (a: Thing | null, b: Thing): boolean => a !== null && JSON.stringify(a) === JSON.stringify(b);

export function CellTree() {
  const document = useStore(cellStore, state => state.document);
  const robot = robotOf(document);
  if (!document) return null;
  return (
    <section aria-label={words.tree.cell}>
      <h2 className="heading">
        <span className="grow">{words.tree.cell}</span>
        <Tip words={words.tree.addBox}>
          <button
            className="btn quiet icon tight"
            aria-label={words.tree.addBox}
            onClick={() => runCommand("cell.box")}
          >
            <Plus />
          </button>
        </Tip>
      </h2>
      <div className="scroll cell-tree">
        <Leaf
          thing={{ kind: "robot" }}
          glyph={<RobotGlyph />}
          kind={words.tree.robot}
          extra={robot && <span className="tag">{words.tree.axes(robot.arm.joints.length)}</span>}
        >
          {robot ? shortName(robot) : document.robot.id}
        </Leaf>
        <Leaf thing={{ kind: "tool" }} glyph={<Wrench />} kind={words.tree.tool} inside>
          {document.tool === "flange" ? words.tree.noTool : document.tool}
        </Leaf>
        {document.objects.map(object => (
          <Leaf
            key={object.id}
            thing={{ kind: "object", id: object.id }}
            glyph={object.shape.kind === "box" ? <Box /> : object.shape.kind === "mesh" ? <Cone /> : <Cylinder />}
            kind={words.tree.roles[object.role]}
            object={object}
            extra={
              <>
                {object.hidden && <span className="tag">{words.tree.hidden}</span>}
                {object.locked && <span className="tag">{words.tree.locked}</span>}
              </>
            }
          >
            {object.name}
          </Leaf>
        ))}
        {/* The frame that traced points are kept in has the name of its object and is nothing to choose. */}
        {document.frames
          .filter(frame => !frame.hidden)
          .map(frame => (
            <Leaf
              key={frame.name}
              thing={{ kind: "frame", name: frame.name }}
              glyph={<Axis3d />}
              kind={words.tree.frame}
            >
              {frame.name}
            </Leaf>
          ))}
      </div>
    </section>
  );
}

const RobotGlyph = () => (
  <svg viewBox="0 0 16 16" width="15" height="15" fill="none" stroke="currentColor" strokeWidth="1.4" aria-hidden>
    <path d="M3 14h6M6 14V9m0 0a1.4 1.4 0 1 0 0-2.8A1.4 1.4 0 0 0 6 9Zm1-2.5 3.4-3.2M11.400 4.200a1.200 1.200 0 1 0 0-2.400 1.200 1.200 0 0 0 0 2.400Zm.400.100L13 8" />
  </svg>
);

function Leaf({
  thing,
  glyph,
  kind,
  extra,
  inside = false,
  object,
  children,
}: {
  thing: Thing;
  glyph: ReactNode;
  kind: string;
  extra?: ReactNode;
  inside?: boolean;
  object?: ObjectRecord;
  children: ReactNode;
}) {
  const on = useStore(selectionStore, state => same(state.selected, thing));
  const under = useStore(selectionStore, state => same(state.hovered, thing));
  const [renaming, setRenaming] = useState(false);
  if (object && renaming) return <ObjectName object={object} onDone={() => setRenaming(false)} />;
  const row = (
    <button
      className="row"
      data-on={on}
      data-under={under}
      aria-pressed={on}
      style={inside ? { paddingLeft: 24 } : undefined}
      title={kind}
      onClick={() => select(on ? null : thing)}
      onPointerEnter={() => hover(thing)}
      onPointerLeave={() => hover(null)}
      onKeyDown={event => {
        if (!object) return;
        if (event.key === "Delete") deleteObject(object.id);
        else if (event.key === "F2") setRenaming(true);
        else if (event.key.toLowerCase() === "d" && (event.ctrlKey || event.metaKey)) duplicateObject(object.id);
        else return;
        event.preventDefault();
        event.stopPropagation();
      }}
    >
      <span className="glyph" aria-hidden>
        {glyph}
      </span>
      <span className="name" translate="no">
        {children}
      </span>
      {extra}
    </button>
  );
  if (!object) return row;
  return (
    <ContextMenu.Root modal={false}>
      <ContextMenu.Trigger asChild>{row}</ContextMenu.Trigger>
      <ContextMenu.Portal>
        <ContextMenu.Content className="menu" onCloseAutoFocus={event => event.preventDefault()}>
          <MenuItem words={words.common.rename} keys="F2" onSelect={() => setRenaming(true)} />
          <MenuItem words={words.common.duplicate} keys="Mod+D" onSelect={() => duplicateObject(object.id)} />
          <MenuItem
            words={object.hidden ? words.tree.show : words.tree.hide}
            onSelect={() => toggleHidden(object.id)}
          />
          <MenuItem
            words={object.locked ? words.tree.unlock : words.tree.lock}
            onSelect={() => toggleLocked(object.id)}
          />
          <ContextMenu.Item className="menu-item danger" onSelect={() => deleteObject(object.id)}>
            {words.tree.deleteObject}
            <span className="kbd">{showKeys("Delete")}</span>
          </ContextMenu.Item>
        </ContextMenu.Content>
      </ContextMenu.Portal>
    </ContextMenu.Root>
  );
}

const MenuItem = ({ words: text, keys, onSelect }: { words: string; keys?: string; onSelect: () => void }) => (
  <ContextMenu.Item className="menu-item" onSelect={onSelect}>
    {text}
    {keys !== undefined && <span className="kbd">{showKeys(keys)}</span>}
  </ContextMenu.Item>
);

/** The name of an object, typed in its row. */
function ObjectName({ object, onDone }: { object: ObjectRecord; onDone: () => void }) {
  const [typed, setTyped] = useState(object.name);
  return (
    <div className="field text">
      <input
        autoFocus
        aria-label={words.tree.nameOfObject}
        value={typed}
        maxLength={80}
        onFocus={event => event.currentTarget.select()}
        onChange={event => setTyped(event.currentTarget.value)}
        onBlur={() => {
          renameObject(object.id, typed);
          onDone();
        }}
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
