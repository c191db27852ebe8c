import { useSortable } from "@dnd-kit/sortable";
import type { Step } from "@twincell/core";
import {
  ChevronRight,
  Clock3,
  CornerDownRight,
  GitBranch,
  Grid3x3,
  Grip,
  Hourglass,
  MessageCircle,
  MessageSquare,
  MoreVertical,
  Octagon,
  RefreshCw,
  Repeat,
  Variable,
  Weight,
  Zap,
  type LucideIcon,
} from "lucide-react";
import { ContextMenu, DropdownMenu } from "radix-ui";
import { useState, type CSSProperties, type KeyboardEvent } from "react";
import { useStore } from "zustand";
import { cellStore } from "../../stores/cell.ts";
import { openComments } from "../../stores/comments.ts";
import { colourOf, togetherStore } from "../../stores/together.ts";
import { commit, withProgram } from "../../stores/document.ts";
import { copySteps, deleteSteps, renameStep, stepWords } from "../../stores/program.ts";
import { words } from "../../messages/index.ts";
import { idsOf, pathOf, type ProgramRow } from "./rows.ts";

interface Props {
  readonly row: ProgramRow;
  readonly index: number;
  readonly top: number;
  readonly on: boolean;
  readonly renaming: boolean;
  readonly place: string;
  readonly count: number;
  readonly onChoose: () => void;
  readonly onToggle: () => void;
  readonly onKey: (event: KeyboardEvent) => void;
  readonly onRename: (wanted: boolean) => void;
  readonly onShift: (by: 1 | -1) => void;
}

/** One line: what it is called, how it moves, how it was judged. */
export function ProgramRowView(props: Props) {
  const { row, index, top, on, renaming } = props;
  const { attributes, listeners, setNodeRef, transform, transition, isDragging } = useSortable({
    id: row.key,
    attributes: { roleDescription: words.tree.sortable },
  });
  const name = row.kind === "step" ? stepWords(row.step, row.index) : row.name;
  const path = pathOf(row);
  const style: CSSProperties = {
    position: "absolute",
    insetInline: 0,
    top,
    transform: transform ? `translate3d(0, ${transform.y}px, 0)` : undefined,
    transition,
    zIndex: isDragging ? 3 : undefined,
  };
  const actions = <Actions {...props} />;
  return (
    <ContextMenu.Root modal={false}>
      <ContextMenu.Trigger asChild>
        <li
          ref={setNodeRef}
          style={style}
          data-index={index}
          data-dragging={isDragging}
          className="program-row"
          aria-posinset={index + 1}
          aria-setsize={props.count}
        >
          {renaming ? (
            <Rename row={row} name={name} onDone={() => props.onRename(false)} />
          ) : (
            <button
              {...listeners}
              className="row"
              data-on={on}
              data-step={row.kind === "step" ? row.step.id : undefined}
              aria-pressed={on}
              aria-roledescription={attributes["aria-roledescription"]}
              aria-describedby="reorder-hint"
              {...(row.kind === "group" ? { "aria-expanded": row.open } : {})}
              data-comment={row.kind === "head" || (row.kind === "step" && row.step.type === "comment") || undefined}
              style={
                row.depth > 0 || (row.kind === "step" && row.inside)
                  ? { paddingLeft: INDENT * row.depth + (row.kind === "step" && row.inside ? 30 : 16) }
                  : undefined
              }
              onClick={props.onChoose}
              onKeyDown={props.onKey}
              onDoubleClick={() => {
                if (row.kind !== "head") props.onRename(true);
              }}
            >
              <Glyph row={row} />
              <span className="name">{name}</span>
              {row.kind === "step" && <Others step={row.step.id} />}
              <span className="visually-hidden">{words.tree.verdicts[row.verdict]}</span>
              {row.kind === "group" ? (
                <span className="kind">{words.tree.points(row.steps.length)}</span>
              ) : (
                path && <span className="kind">{words.step.path[path]}</span>
              )}
            </button>
          )}
          {row.kind === "group" && (
            <button
              className="btn quiet icon tight row-toggle"
              data-open={row.open}
              tabIndex={-1}
              aria-label={row.open ? words.tree.collapse : words.tree.expand}
              onClick={props.onToggle}
            >
              <ChevronRight />
            </button>
          )}
          {row.kind !== "head" && (
            <DropdownMenu.Root modal={false}>
              <DropdownMenu.Trigger asChild>
                <button
                  className="btn quiet icon tight row-more"
                  tabIndex={-1}
                  aria-label={`${words.tree.stepActions}: ${name}`}
                >
                  <MoreVertical />
                </button>
              </DropdownMenu.Trigger>
              <DropdownMenu.Portal>
                <DropdownMenu.Content className="menu" align="end">
                  {actions}
                </DropdownMenu.Content>
              </DropdownMenu.Portal>
            </DropdownMenu.Root>
          )}
        </li>
      </ContextMenu.Trigger>
      {row.kind !== "head" && (
        <ContextMenu.Portal>
          <ContextMenu.Content className="menu">
            <ContextActions {...props} />
          </ContextMenu.Content>
        </ContextMenu.Portal>
      )}
    </ContextMenu.Root>
  );
}

/** Who else has that step selected, and how many comments on it are open. */
function Others({ step }: { readonly step: string }) {
  const program = useStore(cellStore, state => state.document?.program);
  const editors = useStore(togetherStore, state => state.editors);
  const comments = useStore(cellStore, state => openComments(state, step));
  const here = editors.filter(
    ({ presence }) =>
      presence?.program === program && presence?.selected?.kind === "step" && presence.selected.id === step,
  );
  return (
    <>
      {here.map(editor => (
        <i
          key={editor.connection}
          className="row-editor"
          role="img"
          aria-label={words.together.selects(editor.who)}
          title={words.together.selects(editor.who)}
          style={{ background: colourOf(editor) }}
        />
      ))}
      {comments > 0 && (
        <span className="row-comments" title={words.together.count(comments)}>
          <MessageCircle aria-hidden />
          {comments}
          <span className="visually-hidden">{words.together.count(comments)}</span>
        </span>
      )}
    </>
  );
}

/** From one block to the steps inside it [px]. */
const INDENT = 14;
const GLYPHS: Readonly<Partial<Record<Step["type"], LucideIcon>>> = {
  wait: Clock3,
  gripper: Grip,
  set: Zap,
  "wait-for": Hourglass,
  payload: Weight,
  message: MessageSquare,
  stop: Octagon,
  call: CornerDownRight,
  assign: Variable,
  repeat: Repeat,
  while: RefreshCw,
  if: GitBranch,
  pallet: Grid3x3,
};

function Glyph({ row }: { row: ProgramRow }) {
  if (row.kind === "head" || (row.kind === "step" && row.step.type === "comment"))
    return <span className="glyph" aria-hidden />;
  const Icon = row.kind === "step" ? GLYPHS[row.step.type] : undefined;
  // What is wrong with a step says more than what sort it is.
  if (Icon && row.verdict !== "bad" && row.verdict !== "warn")
    return (
      <span className="glyph" aria-hidden>
        <Icon />
      </span>
    );
  return (
    <span className="glyph" aria-hidden>
      <i className="mark" data-verdict={row.verdict} />
    </span>
  );
}

interface Action {
  readonly words: string;
  readonly keys?: string;
  readonly danger?: boolean;
  readonly run: () => void;
}
const actionsOf = ({ row, onRename, onShift }: Props): readonly Action[] => [
  { words: words.common.rename, keys: "F2", run: () => onRename(true) },
  {
    words: words.common.duplicate,
    keys: "Ctrl D",
    run: () => {
      copySteps(idsOf(row));
    },
  },
  { words: words.tree.up, keys: "Alt ↑", run: () => onShift(-1) },
  { words: words.tree.down, keys: "Alt ↓", run: () => onShift(1) },
  {
    words: words.common.remove,
    keys: "Del",
    danger: true,
    run: () => {
      deleteSteps(idsOf(row));
    },
  },
];
const Actions = (props: Props) =>
  actionsOf(props).map(action => (
    <DropdownMenu.Item
      key={action.words}
      className={action.danger ? "menu-item danger" : "menu-item"}
      onSelect={action.run}
    >
      {action.words}
      <span className="kbd">{action.keys}</span>
    </DropdownMenu.Item>
  ));
const ContextActions = (props: Props) =>
  actionsOf(props).map(action => (
    <ContextMenu.Item
      key={action.words}
      className={action.danger ? "menu-item danger" : "menu-item"}
      onSelect={action.run}
    >
      {action.words}
      <span className="kbd">{action.keys}</span>
    </ContextMenu.Item>
  ));

function Rename({ row, name, onDone }: { row: ProgramRow; name: string; onDone: () => void }) {
  const [typed, setTyped] = useState(name);
  const take = (): void => {
    if (typed.trim() !== name) {
      if (row.kind === "step") renameStep(row.step.id, typed);
      else if (row.kind === "group" && typed.trim())
        commit(words.undo.rename, document =>
          withProgram(document, program => ({
            ...program,
            groups: { ...program.groups, [row.group]: { ...program.groups[row.group], name: typed.trim() } },
          })),
        );
    }
    onDone();
  };
  return (
    <div className="row" data-on>
      <span className="field text grow">
        <input
          aria-label={words.step.name}
          autoFocus
          value={typed}
          maxLength={60}
          onFocus={event => event.currentTarget.select()}
          onChange={event => setTyped(event.currentTarget.value)}
          onBlur={take}
          onKeyDown={event => {
            event.stopPropagation();
            if (event.key === "Enter") event.currentTarget.blur();
            if (event.key === "Escape") onDone();
          }}
        />
      </span>
    </div>
  );
}
