import { useVirtualizer } from "@tanstack/react-virtual";
import { useEffect, useRef, type ReactNode } from "react";
import { strokes, syntaxOf, type Syntax } from "./syntax.ts";
import "./code.css";

const LINE_PX = 20;

interface Props {
  readonly text: string;
  readonly label: string;
  /** The language whose words are coloured. */
  readonly dialect?: string;
  readonly current?: number;
  readonly marked?: (line: number) => boolean;
  readonly wrong?: (line: number) => boolean;
  readonly onLine?: (line: number) => void;
  /** Breakpoints: whether a line has one, and what a click on its number does. */
  readonly stops?: {
    readonly at: (line: number) => boolean;
    readonly toggle: (line: number) => void;
    readonly words: (line: number) => string;
  };
  readonly height?: number | string;
}

/** A program text, line by line: virtual, one line marked, a click tells which. */
export function CodeView({ text, label, dialect = "", current = 0, marked, wrong, onLine, stops, height }: Props) {
  const scroller = useRef<HTMLDivElement>(null);
  const lines = text.replaceAll("\r", "").split("\n");
  const syntax = syntaxOf(dialect);
  const virtual = useVirtualizer({
    count: lines.length,
    getScrollElement: () => scroller.current,
    estimateSize: () => LINE_PX,
    overscan: 20,
  });
  useEffect(() => {
    if (current > 0) virtual.scrollToIndex(current - 1, { align: "auto" });
  }, [current, virtual]);
  return (
    <div className="code scroll" ref={scroller} role="region" aria-label={label} tabIndex={0} style={{ height }}>
      <div style={{ height: virtual.getTotalSize(), position: "relative" }}>
        {virtual.getVirtualItems().map(item => {
          const line = item.index + 1;
          return (
            <div
              key={item.key}
              className="code-line"
              data-on={line === current}
              data-marked={marked?.(line) ?? false}
              data-wrong={wrong?.(line) ?? false}
              aria-current={line === current ? "step" : undefined}
              style={{ top: item.start, height: LINE_PX }}
              onClick={() => onLine?.(line)}
            >
              {stops ? (
                <button
                  type="button"
                  className="code-number code-stop"
                  aria-pressed={stops.at(line)}
                  aria-label={stops.words(line)}
                  onClick={event => {
                    event.stopPropagation();
                    stops.toggle(line);
                  }}
                >
                  {line}
                </button>
              ) : (
                <span className="code-number" aria-hidden>
                  {line}
                </span>
              )}
              <code translate="no">{painted(lines[item.index] ?? "", syntax)}</code>
            </div>
          );
        })}
      </div>
    </div>
  );
}

/** Words, numbers and comments each in their own colour. */
const painted = (line: string, syntax: Syntax): ReactNode =>
  strokes(line, syntax).map(({ ink, text }, i) => {
    switch (ink) {
      case "word":
        return <b key={i}>{text}</b>;
      case "number":
        return <i key={i}>{text}</i>;
      case "comment":
        return <em key={i}>{text}</em>;
      case "plain":
        return text;
    }
  });
