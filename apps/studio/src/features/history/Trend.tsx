import { useEffect, useRef } from "react";
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { useStore } from "zustand";
import { theHistory } from "../../runtime/robot/cell-control.ts";
import { viewStore } from "../../stores/view.ts";
import { clockOf } from "./times.ts";
import { fixed } from "../../messages/numbers.ts";

const COLOURS = ["#4f8ff7", "#e0a12e", "#37a98f", "#c76bd6", "#e0665c", "#8a97a3", "#a3b53a"];
const HEIGHT = 104;
/** Round steps of a clock [s]. */
const STEPS_S = [
  0.01, 0.1, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 10_800, 14_400, 21_600, 43_200, 86_400,
];

/** Lines over the time of the recording; a click looks at that moment. */
export function Trend({
  times_s,
  lines,
  labels,
  unit,
}: {
  readonly times_s: readonly number[];
  readonly lines: readonly (readonly number[])[];
  readonly labels: readonly string[];
  readonly unit: string;
}) {
  const host = useRef<HTMLDivElement>(null);
  const theme = useStore(viewStore, state => state.theme);
  useEffect(() => {
    const element = host.current;
    if (!element) return undefined;
    const style = getComputedStyle(element);
    const colour = (name: string): string => style.getPropertyValue(name);
    const axis = {
      stroke: colour("--text-3"),
      grid: { stroke: colour("--line"), width: 1 },
      ticks: { stroke: colour("--line") },
      font: "10px Inter Variable",
    };
    const value = (_plot: uPlot, at: number | null): string => (at === null ? "" : `${fixed(at, 1)}${unit}`);
    const plot = new uPlot(
      {
        width: element.clientWidth,
        height: HEIGHT,
        legend: { show: labels.length > 1 },
        cursor: { y: false, drag: { x: false, y: false } },
        scales: { x: { time: false } },
        series: [
          { label: "", value: (_plot, at) => (at === null ? "" : clockOf(at)) },
          ...labels.map((label, i) => ({
            label,
            stroke: COLOURS[i % COLOURS.length]!,
            width: 1.4,
            points: { show: times_s.length < 40, size: 4 },
            value,
          })),
        ],
        axes: [
          {
            ...axis,
            size: 30,
            space: 64,
            incrs: STEPS_S,
            values: (_plot, at) => at.map(each => clockOf(each).replace(/\.\d+( s)?$/, "$1")),
          },
          { ...axis, size: 42 },
        ],
      },
      [[...times_s], ...lines.map(line => [...line])],
      element,
    );
    const click = (): void => {
      const { idx } = plot.cursor;
      const at = idx == null ? undefined : times_s[idx];
      if (at !== undefined) theHistory.seek(Math.max(0, at));
    };
    plot.over.addEventListener("click", click);
    const sizes = new ResizeObserver(() => plot.setSize({ width: element.clientWidth, height: HEIGHT }));
    sizes.observe(element);
    return () => {
      sizes.disconnect();
      plot.destroy();
    };
  }, [times_s, lines, labels, unit, theme]);
  return <div ref={host} className="plot-host history-trend" />;
}
