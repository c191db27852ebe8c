import { useVirtualizer } from "@tanstack/react-virtual";
import { useMemo, useRef } from "react";
import { useStore } from "zustand";
import type { EmittedFile, Program } from "@twincell/core";
import { select, selectionStore } from "../../stores/selection.ts";
import { words } from "../../words/index.ts";

const LINE_PX = 18;

/** The text line by line: click a line to select the step it was written for; the selected step's lines are lit. */
export function Text({ file, program }: { readonly file: EmittedFile; readonly program: Program }) {
  const lines = useMemo(() => file.text.replace(/\r/g, "").replace(/\n$/, "").split("\n"), [file]);
  const names = useMemo(() => new Map(program.steps.map(step => [step.id, step.name ?? step.id])), [program]);
  const selected = useStore(selectionStore, state => (state.selected?.kind === "step" ? state.selected.id : null));
  const box = useRef<HTMLDivElement>(null);
  const rows = useVirtualizer({ count: lines.length, getScrollElement: () => box.current, estimateSize: () => LINE_PX, overscan: 20 });
  return (
    <div ref={box} className="export-text" tabIndex={0} aria-label={`${words.export.text} ${file.name}`}>
      <div style={{ height: rows.getTotalSize(), position: "relative" }}>
        {rows.getVirtualItems().map(row => {
          const step = file.lines[row.index] ?? "", says = lines[row.index]!;
          return (
            <div
              key={row.key} className="export-line" data-lit={(step !== "" && step === selected) || undefined} data-step={step || undefined}
              title={step ? words.export.step(names.get(step) ?? step) : undefined} style={{ transform: `translateY(${row.start}px)` }}
              onClick={() => { if (step) select({ kind: "step", id: step }); }}
            >
              <span className="export-number">{row.index + 1}</span><code><Coloured text={says} /></code>
            </div>
          );
        })}
      </div>
    </div>
  );
}

const PIECES = /(;.*$)|(\.(?:PROGRAM|END)\b|\b(?:DO|DECOMPOSE|MOVES?|APPROS?|DEPARTS?|SPEED|ALWAYS|BREAK|TOOL|DELAY|OPENI|CLOSEI|MMPS|SET|RETURN|ACCEL|CPON|CPOFF|ENABLE|DISABLE|MONITOR)\b)|(#?\b(?:PPOINT|TRANS)\b)|(-?\d+(?:\.\d+)?)/gi;
const KINDS = ["note", "word", "place", "number"] as const;

/** Comment, statement word, location and number in their own colours. */
function Coloured({ text }: { readonly text: string }) {
  const pieces: { readonly says: string; readonly kind: string }[] = [];
  let at = 0;
  for (const match of text.matchAll(PIECES)) {
    if (match.index > at) pieces.push({ says: text.slice(at, match.index), kind: "" });
    pieces.push({ says: match[0], kind: KINDS[match.slice(1).findIndex(group => group !== undefined)] ?? "" });
    at = match.index + match[0].length;
  }
  if (at < text.length) pieces.push({ says: text.slice(at), kind: "" });
  return <>{pieces.map(({ says, kind }, i) => (kind ? <span key={i} className={`say-${kind}`}>{says}</span> : says))}</>;
}
