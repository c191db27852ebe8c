import { useVirtualizer } from "@tanstack/react-virtual";
import { useEffect, useRef, type ReactNode } from "react";
import "./code.css";

const LINE_PX = 20;
const KEYWORDS = /^(MOVES?|MOVET|SPEED|ACCEL|DELAY|TOOL|SET|BREAK|OPENI?|CLOSEI?|CALL|DO|DECOMPOSE|BASE|IF|THEN|ELSE|END|FOR|TO|WHILE|RETURN|ALWAYS|MMPS|TRANS|PPOINT|RIGHTY|LEFTY|ABOVE|BELOW|FLIP|NOFLIP|SINGLE|MULTIPLE|DURATION|APPROS?|DEPARTS?|WAIT|SIGNAL)$/;

/** A program text, line by line: virtual, one line marked, a click tells which. */
export function CodeView({ text, label, current = 0, marked, onLine, height }: { text: string; label: string; current?: number; marked?: (line: number) => boolean; onLine?: (line: number) => void; height?: number | string }) {
  const scroller = useRef<HTMLDivElement>(null), lines = text.replaceAll("\r", "").split("\n");
  const virtual = useVirtualizer({ count: lines.length, getScrollElement: () => scroller.current, estimateSize: () => LINE_PX, overscan: 20 });
  useEffect(() => { if (current > 0) virtual.scrollToIndex(current - 1, { align: "auto" }); }, [current, virtual]);
  return (
    <div className="code scroll" ref={scroller} role="region" aria-label={label} tabIndex={0} style={{ height }}>
      <div style={{ height: virtual.getTotalSize(), position: "relative" }}>
        {virtual.getVirtualItems().map(item => (
          <div key={item.key} className="code-line" data-on={item.index + 1 === current} data-marked={marked?.(item.index + 1) ?? false} aria-current={item.index + 1 === current ? "step" : undefined} style={{ top: item.start, height: LINE_PX }} onClick={() => onLine?.(item.index + 1)}>
            <span className="code-number" aria-hidden>{item.index + 1}</span><code>{painted(lines[item.index] ?? "")}</code>
          </div>
        ))}
      </div>
    </div>
  );
}

/** Keywords, numbers and comments of V+ each in their own colour. */
function painted(line: string): ReactNode {
  const [code, ...comment] = line.split(";");
  return (
    <>
      {(code ?? "").split(/([A-Za-z_.#][\w.]*|-?\d+\.?\d*)/).map((word, i) => (KEYWORDS.test(word.replace("#", "")) || word.startsWith(".") && word.length > 1 ? <b key={i}>{word}</b> : /^-?\d/.test(word) ? <i key={i}>{word}</i> : word))}
      {comment.length > 0 && <em>;{comment.join(";")}</em>}
    </>
  );
}
