import type { Plan, Tracking } from "@twincell/core";
import { useEffect, useRef, useState } from "react";
import uPlot from "uplot";
import { useStore } from "zustand";
import { onFrame } from "../../runtime/jog/jog-frames.ts";
import { accuracyOverSpeed } from "../../runtime/planning/accuracy.ts";
import { viewStore } from "../../stores/view.ts";
import { say, words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";

const HEIGHT = 124;
const AXIS_PX = 46;

/**
 * Error over speed (row X-45): how far drives with a spring and a damper on every joint leave the flange off the plan,
 * at parts of the planned speed.
 */
export function AccuracyPlot({ plan }: { readonly plan: Plan }) {
  const [known, setKnown] = useState<Tracking | null>(null);
  const [done, setDone] = useState(0);
  const theme = useStore(viewStore, state => state.theme);
  const host = useRef<HTMLDivElement>(null);
  useEffect(() => {
    setKnown(null);
    setDone(0);
    return accuracyOverSpeed(plan, setDone, setKnown);
  }, [plan]);
  useEffect(() => {
    const element = host.current;
    if (!element || known?.kind !== "known") return undefined;
    const colour = (name: string): string => getComputedStyle(element).getPropertyValue(name);
    const curve = (label: string, stroke: string): uPlot.Series => ({
      label,
      stroke,
      width: 1.6,
      points: { show: true, size: 6 },
      value: (_plot, at) => (at === null ? "–" : `${fixed(at, 2)} mm`),
    });
    const axis = {
      stroke: colour("--text-3"),
      grid: { stroke: colour("--line"), width: 1 },
      ticks: { stroke: colour("--line") },
      font: "11px Inter Variable",
    };
    const plot = new uPlot(
      {
        width: element.clientWidth,
        height: HEIGHT,
        legend: { show: true, live: true },
        cursor: { y: false, drag: { x: false, y: false } },
        padding: [8, 16, 0, 0],
        scales: { x: { time: false, range: () => [0, 105] }, y: { range: (_plot, _low, high) => [0, high * 1.1] } },
        series: [
          {
            label: words.time.speed,
            value: (_plot, at) => (at === null ? "" : `${fixed(at, 0)}${words.time.percent}`),
          },
          curve(words.time.worstError, "#e0665c"),
          curve(words.time.rmsError, "#4f8ff7"),
        ],
        axes: [
          { ...axis, size: 24, values: (_plot, ticks) => ticks.map(at => `${at} %`) },
          { ...axis, size: AXIS_PX },
        ],
      },
      [
        known.rows.map(({ override }) => 100 * override),
        known.rows.map(({ worst_m }) => 1000 * worst_m),
        known.rows.map(({ rms_m }) => 1000 * rms_m),
      ],
      element,
    );
    // Without a pointer the numbers are those at full speed.
    const full = known.rows.length - 1;
    const stop = onFrame(() => {
      if ((plot.cursor.left ?? -1) < 0 && plot.legend.idx !== full) plot.setLegend({ idx: full }, false);
    });
    const sizes = new ResizeObserver(() => plot.setSize({ width: element.clientWidth, height: HEIGHT }));
    sizes.observe(element);
    return () => {
      stop();
      sizes.disconnect();
      plot.destroy();
    };
  }, [known, theme]);
  if (known === null)
    return (
      <p className="empty" role="status">
        {words.time.accuracyWorking(Math.round(100 * done))}
      </p>
    );
  if (known.kind === "unknown") return <p className="empty">{say(known.sentence)}</p>;
  return (
    <>
      <div ref={host} className="plot-host" />
      <p className="small muted plot-note">{words.time.accuracyNote}</p>
    </>
  );
}
