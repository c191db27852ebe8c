import { useVirtualizer } from "@tanstack/react-virtual";
import { useRef, useState } from "react";
import { useStore } from "zustand";
import { theHistory } from "../../runtime/robot/cell-control.ts";
import { cellStore } from "../../stores/cell.ts";
import { flangeFromTcpOf } from "../../stores/document.ts";
import { historyStore } from "../../stores/history.ts";
import { words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";
import { clockOf } from "./times.ts";

const ROW_PX = 44;
const mm = (m: number): string => fixed(m * 1000, m < 0.01 ? 2 : 1);

/** Every cycle of what is open; two of them laid over each other in the view. */
export function Cycles() {
  const cycles = useStore(historyStore, state => state.cycles);
  const overlay = useStore(historyStore, state => state.overlay);
  const [first, setFirst] = useState<number | null>(overlay?.first ?? null);
  const box = useRef<HTMLDivElement>(null);
  const rows = useVirtualizer({
    count: cycles.length,
    getScrollElement: () => box.current,
    estimateSize: () => ROW_PX,
    overscan: 6,
  });
  if (cycles.length === 0) return <p className="small muted">{words.history.noCycles}</p>;
  const choose = (index: number): void => {
    if (first === null || overlay) {
      setFirst(index);
      historyStore.setState({ overlay: null });
      return;
    }
    if (first === index) {
      setFirst(null);
      return;
    }
    const { document } = cellStore.getState();
    if (document)
      void theHistory.overlay(first, index, {
        worldFromBase: document.robot.worldFromBase,
        flangeFromTcp: flangeFromTcpOf(document),
      });
  };
  const mark = (index: number): "first" | "second" | undefined =>
    index === (overlay?.first ?? first) ? "first" : index === overlay?.second ? "second" : undefined;
  return (
    <div className="history-moment">
      <p className="small muted">{words.history.overlaySays}</p>
      {overlay?.comparison && <Difference />}
      <div ref={box} className="history-list" role="list" aria-label={words.history.cyclesView}>
        <div style={{ height: rows.getTotalSize(), position: "relative" }}>
          {rows.getVirtualItems().map(({ index, start }) => {
            const cycle = cycles[index]!;
            const as = mark(index);
            return (
              <div
                key={index}
                role="listitem"
                className="history-row cycle-row"
                style={{ transform: `translateY(${start}px)` }}
              >
                <button
                  className="btn tight cycle-pick"
                  data-as={as}
                  aria-pressed={as !== undefined}
                  onClick={() => {
                    choose(index);
                  }}
                >
                  {as ? words.history[as] : words.history.cycle(index + 1)}
                </button>
                <button
                  className="link"
                  onClick={() => {
                    theHistory.seek(cycle.from_s);
                  }}
                >
                  {clockOf(Math.max(0, cycle.from_s))}
                </button>
                <span className="grow small muted">
                  {fixed(cycle.to_s - cycle.from_s, 2)} s · {words.history.cycleEnds[cycle.ending]}
                </span>
              </div>
            );
          })}
        </div>
      </div>
    </div>
  );
}

function Difference() {
  const comparison = useStore(historyStore, state => state.overlay?.comparison);
  if (!comparison) return null;
  const { longer_s, apart_m, apartAt_s, offPath_m } = comparison;
  const by = fixed(Math.abs(longer_s), 2);
  return (
    <div className="history-difference" role="status">
      <p>
        {by === "0.00" ? words.history.asLong : longer_s > 0 ? words.history.longer(by) : words.history.shorter(by)}
      </p>
      <p>{words.history.apart(mm(apart_m), fixed(apartAt_s, 2))}</p>
      <p>{words.history.offPath(mm(offPath_m))}</p>
      <button
        className="btn tight"
        onClick={() => {
          historyStore.setState({ overlay: null });
        }}
      >
        {words.history.endOverlay}
      </button>
    </div>
  );
}
