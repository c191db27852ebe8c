import type { TextPoint } from "@twincell/languages";
import type { TextFile } from "@twincell/project";
import { useVirtualizer } from "@tanstack/react-virtual";
import { ArrowRight, CircleX, TriangleAlert } from "lucide-react";
import { useEffect, useMemo, useRef, type KeyboardEvent, type ReactNode } from "react";
import { strokes, syntaxOf, type Syntax } from "../../ui/syntax.ts";
import { words } from "../../messages/index.ts";
import { boxesIn, changeOf, lineSpans, shownText, type LineSpan } from "./lines.ts";

const LINE_PX = 24;

interface Props {
  readonly file: TextFile;
  readonly index: number;
  readonly language: string;
  /** Line of the cursor; 0 when it is in another file. */
  readonly cursor: number;
  readonly point: TextPoint | undefined;
  readonly base: string | undefined;
  readonly findings: ReadonlyMap<number, "bad" | "warn">;
  readonly onLine: (line: number) => void;
}

/** The lines of one file: change bar, mark, number, text; the point under the cursor is boxed wherever it stands. */
export function TextLines({ file, index, language, cursor, point, base, findings, onLine }: Props) {
  const scroller = useRef<HTMLDivElement>(null);
  const { text, encoding } = file;
  const spans = useMemo(() => lineSpans(text), [text]);
  const before = useMemo(
    () =>
      base === undefined || base === text ? undefined : lineSpans(base).map(({ start, end }) => base.slice(start, end)),
    [base, text],
  );
  const syntax = syntaxOf(language);
  const virtual = useVirtualizer({
    count: spans.length,
    getScrollElement: () => scroller.current,
    estimateSize: () => LINE_PX,
    overscan: 20,
  });
  useEffect(() => {
    if (cursor <= 0) return;
    // The card of a point takes room from the list when it appears: it is scrolled when that has happened.
    const frame = requestAnimationFrame(() => virtual.scrollToIndex(cursor - 1, { align: "auto" }));
    return () => cancelAnimationFrame(frame);
  }, [cursor, point, virtual]);
  const onKey = (event: KeyboardEvent): void => {
    const by: Readonly<Record<string, number>> = { ArrowDown: 1, ArrowUp: -1, PageDown: 20, PageUp: -20 };
    const step = by[event.key];
    const next =
      event.key === "Home" ? 1 : event.key === "End" ? spans.length : step === undefined ? undefined : cursor + step;
    if (next === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    onLine(Math.min(spans.length, Math.max(1, next)));
  };
  return (
    <div
      className="text-lines scroll"
      ref={scroller}
      role="listbox"
      aria-label={file.name}
      aria-activedescendant={cursor > 0 ? `text-line-${cursor}` : undefined}
      tabIndex={0}
      onKeyDown={onKey}
    >
      <div role="presentation" style={{ height: virtual.getTotalSize(), position: "relative" }}>
        {virtual.getVirtualItems().map(item => {
          const line = item.index + 1;
          const span = spans[item.index]!;
          const raw = text.slice(span.start, span.end);
          const old = before?.[item.index];
          const changed = before !== undefined && old !== raw;
          const finding = findings.get(line);
          const chip = changed ? changeOf(old, raw) : "";
          return (
            <div
              key={item.key}
              id={`text-line-${line}`}
              className="text-line"
              role="option"
              aria-selected={line === cursor}
              data-on={line === cursor}
              data-changed={changed}
              style={{ top: item.start, height: LINE_PX }}
              onClick={() => onLine(line)}
            >
              <span className="text-mark" aria-hidden>
                {finding === "bad" ? (
                  <CircleX className="bad" />
                ) : finding === "warn" ? (
                  <TriangleAlert className="near" />
                ) : line === cursor ? (
                  <ArrowRight className="here" />
                ) : null}
              </span>
              <span className="text-number" aria-hidden>
                {line}
              </span>
              <code data-finding={finding}>
                {pieces(raw, span.start, boxesIn(point, index, text, span), encoding, syntax)}
              </code>
              {chip !== "" && (
                <span className="text-chip" title={words.text.changed}>
                  {chip}
                </span>
              )}
            </div>
          );
        })}
      </div>
    </div>
  );
}

/** A line in the colours of its language, cut where boxes begin and end. */
function pieces(
  raw: string,
  start: number,
  boxes: readonly LineSpan[],
  encoding: TextFile["encoding"],
  syntax: Syntax,
): ReactNode {
  const inks: ReactNode[] = [];
  let at = 0;
  for (const { ink, text } of strokes(raw, syntax)) {
    const from = start + at;
    at += text.length;
    let done = 0;
    for (const box of boxes) {
      const a = Math.max(0, box.start - from);
      const b = Math.min(text.length, box.end - from);
      if (b <= a || a < done) continue;
      if (a > done) inks.push(inked(text.slice(done, a), ink, inks.length, encoding));
      inks.push(<mark key={inks.length}>{shownText(text.slice(a, b), encoding)}</mark>);
      done = b;
    }
    if (done < text.length) inks.push(inked(text.slice(done), ink, inks.length, encoding));
  }
  return inks;
}

function inked(text: string, ink: string, key: number, encoding: TextFile["encoding"]): ReactNode {
  const shown = shownText(text, encoding);
  switch (ink) {
    case "word":
      return <b key={key}>{shown}</b>;
    case "number":
      return <i key={key}>{shown}</i>;
    case "comment":
      return <em key={key}>{shown}</em>;
    default:
      return <span key={key}>{shown}</span>;
  }
}
