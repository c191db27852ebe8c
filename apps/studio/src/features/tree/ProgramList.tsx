import {
  closestCenter,
  DndContext,
  MouseSensor,
  TouchSensor,
  useSensor,
  useSensors,
  type DragEndEvent,
} from "@dnd-kit/core";
import { SortableContext, verticalListSortingStrategy } from "@dnd-kit/sortable";
import { useVirtualizer } from "@tanstack/react-virtual";
import { useEffect, useMemo, useRef, useState, type KeyboardEvent } from "react";
import { useStore } from "zustand";
import { cellStore } from "../../stores/cell.ts";
import { programOf } from "../../stores/document.ts";
import { playStore } from "../../stores/play.ts";
import { copySteps, deleteSteps, placeSteps, stepWords } from "../../stores/program.ts";
import { select, selectionStore } from "../../stores/selection.ts";
import { seekStep } from "../../stores/seek.ts";
import { words } from "../../messages/index.ts";
import { ProgramSwitch } from "./ProgramSwitch.tsx";
import { ProgramRowView } from "./ProgramRowView.tsx";
import { anchorOf, behind, foundRows, idsOf, programRows, type ProgramRow } from "./rows.ts";

const rowName = (row: ProgramRow): string => (row.kind === "step" ? stepWords(row.step, row.index) : row.name);

/** What moved is said by the list itself, in the person's language. */
const SPOKEN = {
  screenReaderInstructions: { draggable: words.tree.reorderHint },
  announcements: {
    onDragStart: () => undefined,
    onDragOver: () => undefined,
    onDragEnd: () => undefined,
    onDragCancel: () => undefined,
  },
};

/** The steps in order: grouped, virtual, reordered by drag or Alt + ↑ ↓. */
export function ProgramList() {
  const program = useStore(cellStore, state => programOf(state.document));
  const verdict = useStore(playStore, state => state.verdict);
  const selected = useStore(selectionStore, state => (state.selected?.kind === "step" ? state.selected.id : null));
  const routine = useStore(selectionStore, state => (state.selected?.kind === "routine" ? state.selected.name : null));
  const [query, setQuery] = useState<string | null>(null);
  const [open, setOpen] = useState<ReadonlySet<string>>(new Set());
  const [renaming, setRenaming] = useState<string | null>(null);
  const [said, setSaid] = useState("");
  const scroller = useRef<HTMLDivElement>(null);
  const isSearching = query !== null && query.trim() !== "";
  const rows = useMemo(() => {
    if (!program) return [];
    return isSearching ? foundRows(program, verdict, query) : programRows(program, verdict, open);
  }, [program, verdict, open, isSearching, query]);
  const sensors = useSensors(
    useSensor(MouseSensor, { activationConstraint: { distance: 5 } }),
    useSensor(TouchSensor, { activationConstraint: { delay: 250, tolerance: 6 } }),
  );
  const size = useRowHeight(scroller);
  const virtual = useVirtualizer({
    count: rows.length,
    getScrollElement: () => scroller.current,
    estimateSize: () => size,
    overscan: 12,
    getItemKey: i => rows[i]?.key ?? i,
  });
  useEffect(() => {
    virtual.measure();
  }, [size, virtual]);
  const isOn = (row: ProgramRow): boolean =>
    (row.kind === "head" && row.routine !== undefined && row.routine === routine) ||
    (selected !== null &&
      (row.kind === "step"
        ? row.step.id === selected
        : row.kind === "group" && !row.open && row.steps.some(step => step.id === selected)));
  const current = rows.findIndex(isOn);
  useEffect(() => {
    if (current >= 0) virtual.scrollToIndex(current, { align: "auto" });
  }, [current, virtual]);

  const toggle = (row: ProgramRow): void => {
    if (row.kind !== "group") return;
    const id = row.steps[0]!.id;
    const next = new Set(open);
    if (!next.delete(id)) next.add(id);
    setOpen(next);
  };
  const choose = (row: ProgramRow): void => {
    if (row.kind === "head" && row.routine !== undefined) {
      select({ kind: "routine", name: row.routine });
      return;
    }
    const [id] = idsOf(row);
    if (id === undefined) return;
    select({ kind: "step", id });
    seekStep(id);
  };
  const focusRow = (index: number): void => {
    const row = rows[index];
    if (!row) return;
    choose(row);
    virtual.scrollToIndex(index, { align: "auto" });
    requestAnimationFrame(() => scroller.current?.querySelector<HTMLElement>(`[data-index="${index}"] .row`)?.focus());
  };
  const shift = (index: number, by: 1 | -1): void => {
    const row = rows[index];
    if (!row || !program || isSearching) return;
    const ids = idsOf(row);
    // One line up or down; a closed group is one line, a block goes with what is inside it, and lines lead into blocks
    // and out of them.
    const next = by < 0 ? index - 1 : behind(rows, index);
    if (!rows[next]) return;
    if (placeSteps(ids, anchorOf(rows[by < 0 ? next : next + 1]))) {
      setSaid(words.tree.moved(rowName(row), index + 1 + by, rows.length));
      requestAnimationFrame(() =>
        scroller.current?.querySelector<HTMLElement>(`[data-index="${index + by}"] .row`)?.focus(),
      );
    }
  };
  const onKey = (event: KeyboardEvent, index: number): void => {
    const row = rows[index];
    if (!row || renaming !== null) return;
    const act: Readonly<Record<string, () => void>> = {
      ArrowUp: () => (event.altKey ? shift(index, -1) : focusRow(index - 1)),
      ArrowDown: () => (event.altKey ? shift(index, 1) : focusRow(index + 1)),
      Home: () => focusRow(0),
      End: () => focusRow(rows.length - 1),
      ArrowRight: () => {
        if (row.kind === "group" && !row.open) toggle(row);
      },
      ArrowLeft: () => {
        if (row.kind === "group" && row.open) toggle(row);
      },
      Delete: () => {
        deleteSteps(idsOf(row));
      },
      F2: () => setRenaming(row.key),
      Enter: () => choose(row),
      ...(event.ctrlKey || event.metaKey
        ? {
            d: () => {
              copySteps(idsOf(row));
            },
          }
        : {}),
    };
    const chosen = act[event.key];
    if (!chosen) return;
    event.preventDefault();
    event.stopPropagation();
    chosen();
  };
  const onDragEnd = ({ active, over }: DragEndEvent): void => {
    if (!over || active.id === over.id || isSearching) return;
    const from = rows.findIndex(row => row.key === active.id);
    const to = rows.findIndex(row => row.key === over.id);
    const row = rows[from];
    if (!row || to < 0) return;
    placeSteps(idsOf(row), anchorOf(to > from ? rows[to + 1] : rows[to]));
  };

  return (
    <section className="program" aria-label={words.tree.program} id="program">
      <ProgramSwitch onSearch={() => setQuery(before => (before === null ? "" : null))} />
      {query !== null && (
        <div className="program-search" role="search">
          <span className="field text">
            <input
              autoFocus
              type="search"
              aria-label={words.editor.search}
              placeholder={words.editor.searchHint}
              value={query}
              maxLength={60}
              onChange={event => setQuery(event.currentTarget.value)}
              onKeyDown={event => {
                if (event.key === "Escape") {
                  event.stopPropagation();
                  setQuery(null);
                }
                if (event.key === "Enter" || event.key === "ArrowDown") {
                  event.preventDefault();
                  focusRow(event.key === "Enter" ? (current + 1) % Math.max(1, rows.length) : 0);
                }
              }}
            />
          </span>
          <span className="small dim" role="status">
            {isSearching ? words.editor.found(rows.length) : ""}
          </span>
        </div>
      )}
      {program && program.steps.length === 0 && <p className="empty">{words.tree.empty}</p>}
      <DndContext sensors={sensors} collisionDetection={closestCenter} onDragEnd={onDragEnd} accessibility={SPOKEN}>
        <SortableContext items={rows.map(row => row.key)} strategy={verticalListSortingStrategy}>
          <div className="scroll program-scroll" ref={scroller}>
            <ol style={{ height: virtual.getTotalSize(), position: "relative" }}>
              {virtual.getVirtualItems().map(item => {
                const row = rows[item.index];
                return (
                  row && (
                    <ProgramRowView
                      key={row.key}
                      row={row}
                      index={item.index}
                      top={item.start}
                      on={isOn(row)}
                      renaming={renaming === row.key}
                      place={`${item.index + 1}`}
                      count={rows.length}
                      onChoose={() => choose(row)}
                      onToggle={() => toggle(row)}
                      onKey={event => onKey(event, item.index)}
                      onRename={wanted => setRenaming(wanted ? row.key : null)}
                      onShift={by => shift(item.index, by)}
                    />
                  )
                );
              })}
            </ol>
          </div>
        </SortableContext>
      </DndContext>
      <p className="visually-hidden" aria-live="polite">
        {said}
      </p>
    </section>
  );
}

/** The row height of the style sheet, which is larger for fingers. */
function useRowHeight(element: React.RefObject<HTMLElement | null>): number {
  const [height, setHeight] = useState(28);
  useEffect(() => {
    const read = (): void => {
      const value = element.current ? parseFloat(getComputedStyle(element.current).getPropertyValue("--row")) : NaN;
      if (Number.isFinite(value)) setHeight(value);
    };
    read();
    window.addEventListener("resize", read);
    return () => window.removeEventListener("resize", read);
  }, [element]);
  return height;
}
