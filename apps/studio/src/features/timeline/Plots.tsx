import { samplePlan, torqueProfile, type Plan } from "@twincell/core";
import { useEffect, useMemo, useRef, useState } from "react";
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { useStore } from "zustand";
import { onFrame } from "../../runtime/jog/jog-frames.ts";
import { playheadNow } from "../../runtime/history/playhead.ts";
import { cellStore } from "../../stores/cell.ts";
import { programOf, robotOf } from "../../stores/document.ts";
import { seek } from "../../stores/seek.ts";
import { viewStore } from "../../stores/view.ts";
import { Segments } from "../../ui/Choice.tsx";
import { say, words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";
import { AccuracyPlot } from "./AccuracyPlot.tsx";
import { plotData } from "./plotData.ts";
import { speedPlot } from "./speedPlot.ts";
import { torquePlot } from "./torquePlot.ts";

type What = "angles" | "speeds" | "tcp" | "torques" | "accuracy";
const COLOURS = ["#4f8ff7", "#e0a12e", "#37a98f", "#c76bd6", "#e0665c", "#8a97a3", "#a3b53a"];
const HEIGHT = 124;
/** Room of the numbers at the left: the time line begins as far in, so that blocks and curves stand over each other. */
const AXIS_PX = 46;

/** Joint angles, speeds or torques over the whole plan; a click looks at that moment. */
export default function Plots({ plan }: { plan: Plan }) {
  const [what, setWhat] = useState<What>("angles");
  const host = useRef<HTMLDivElement>(null);
  const theme = useStore(viewStore, state => state.theme);
  const joints = useStore(cellStore, state => robotOf(state.document)?.arm.joints.length ?? 0);
  const torques = useMemo(() => {
    const { document } = cellStore.getState();
    const robot = robotOf(document);
    const program = programOf(document);
    return what === "torques" && document && robot && program
      ? torquePlot(plan, robot, program, document.robot.worldFromBase, torqueProfile)
      : null;
  }, [plan, what]);
  const speeds = useMemo(() => {
    const { document } = cellStore.getState();
    const robot = robotOf(document);
    const program = programOf(document);
    return what === "tcp" && document && robot && program
      ? speedPlot(plan, robot, program, document.robot.worldFromBase)
      : undefined;
  }, [plan, what]);
  useEffect(() => {
    const element = host.current;
    if (!element || what === "accuracy") return undefined;
    const style = getComputedStyle(element);
    const colour = (name: string): string => style.getPropertyValue(name);
    const unit = { angles: words.time.deg, speeds: words.time.degS, tcp: words.time.mmS, torques: words.time.percent }[
      what
    ];
    const data: uPlot.AlignedData | undefined =
      what === "tcp"
        ? speeds
        : what !== "torques"
          ? plotData(plan, joints, what, samplePlan)
          : torques?.kind === "known"
            ? torques.data
            : undefined;
    if (!data) return undefined;
    const value = (_plot: uPlot, at: number | null): string => (at === null ? "–" : `${fixed(at, 1)}${unit}`);
    const curve = (label: string, stroke: string): uPlot.Series => ({
      label,
      stroke,
      width: 1.4,
      points: { show: false },
      value,
    });
    const dashed = (label: string): uPlot.Series => ({
      ...curve(label, colour("--text-3")),
      width: 1,
      dash: [6, 4],
    });
    const curves =
      what === "tcp"
        ? [curve(words.time.tcpSpeed, COLOURS[0]!), dashed(words.time.programmed)]
        : [
            ...COLOURS.slice(0, joints).map((stroke, i) => curve(words.time.joint(i + 1), stroke)),
            ...Array.from({ length: data.length - 1 - joints }, () => dashed(words.time.limit)),
          ];
    const axis = {
      stroke: colour("--text-3"),
      grid: { stroke: colour("--line"), width: 1 },
      ticks: { stroke: colour("--line") },
      font: "11px Inter Variable",
      size: AXIS_PX,
    };
    const plot = new uPlot(
      {
        width: element.clientWidth,
        height: HEIGHT,
        legend: { show: true, live: true },
        cursor: { y: false, drag: { x: false, y: false } },
        padding: [8, 0, 0, 0],
        scales: { x: { time: false, range: () => [0, plan.duration_s] } },
        series: [
          {
            label: words.time.scrubber,
            value: (_plot, at) => (at === null ? "" : `${fixed(at, 2)} ${words.time.seconds}`),
          },
          ...curves,
        ],
        axes: [{ ...axis, size: 24 }, axis],
      },
      data,
      element,
    );
    const click = (): void => {
      const { idx } = plot.cursor;
      const at = idx == null ? undefined : plot.data[0][idx];
      if (at !== undefined) seek(at);
    };
    plot.over.addEventListener("click", click);
    const line = document.createElement("div");
    line.className = "plot-head";
    plot.over.append(line);
    let shown = -1;
    const stop = onFrame(() => {
      const at_s = playheadNow();
      line.style.left = `${plot.valToPos(at_s, "x")}px`;
      // Without a pointer in the plot the numbers are those at the playhead.
      if ((plot.cursor.left ?? -1) >= 0) shown = -1;
      else if (at_s !== shown) {
        shown = at_s;
        plot.setLegend({ idx: plot.valToIdx(at_s) }, false);
      }
    });
    const sizes = new ResizeObserver(() => plot.setSize({ width: element.clientWidth, height: HEIGHT }));
    sizes.observe(element);
    return () => {
      stop();
      sizes.disconnect();
      plot.destroy();
    };
  }, [plan, joints, what, theme, torques, speeds]);
  return (
    <div className="plots">
      <Segments<What>
        label={words.time.plots}
        value={what}
        onChange={setWhat}
        className="seg small-seg"
        options={[
          { value: "angles", words: words.time.angles },
          { value: "speeds", words: words.time.speeds },
          { value: "tcp", words: words.time.tcpSpeed },
          { value: "torques", words: words.time.torques },
          { value: "accuracy", words: words.time.accuracy },
        ]}
      />
      {what === "accuracy" ? (
        <AccuracyPlot plan={plan} />
      ) : torques?.kind === "unknown" ? (
        <p className="empty">{say(torques.sentence)}</p>
      ) : (
        <div ref={host} className="plot-host" />
      )}
    </div>
  );
}
