import { ChartSpline, Pause, Play, SkipBack, SkipForward, Weight } from "lucide-react";
import { lazy, Suspense, useEffect, useMemo, useRef, type KeyboardEvent, type PointerEvent } from "react";
import type { Program } from "@twincell/core";
import { selectedProgram } from "@twincell/project";
import { useStore } from "zustand";
import { onFrame } from "../../runtime/jog/jog-frames.ts";
import { physicsNow } from "../../runtime/physics/physics.ts";
import { playheadNow } from "../../runtime/history/playhead.ts";
import { cellStore } from "../../stores/cell.ts";
import { runCommand } from "../../stores/commands.ts";
import { programOf, robotOf } from "../../stores/document.ts";
import { languageOf, languageStore } from "../../stores/languages.ts";
import { physicsStore } from "../../stores/physics.ts";
import { playStore } from "../../stores/play.ts";
import { findStep, stepsToRepair, stepWords } from "../../stores/program.ts";
import { seek } from "../../stores/seek.ts";
import { select, selectionStore } from "../../stores/selection.ts";
import { viewStore } from "../../stores/view.ts";
import { Tip } from "../../ui/Tip.tsx";
import { words } from "../../messages/index.ts";
import { laneBars, type LaneBar } from "./lanes.ts";
import { timelineBlocks, type Block } from "./blocks.ts";
import "./timeline.css";

const Plots = lazy(() => import("./Plots.tsx"));

/** Bottom: the program as blocks in time, a scrubber, and the plots drawer. */
export function Timeline() {
  const plan = useStore(playStore, state => state.plan);
  const verdict = useStore(playStore, state => state.verdict);
  const path = useStore(playStore, state => state.path);
  const program = useStore(cellStore, state => programOf(state.document));
  const plots = useStore(viewStore, state => state.plots);
  const blocks = useMemo(
    () => (plan && program ? timelineBlocks(program, plan, verdict, path) : []),
    [program, plan, verdict, path],
  );
  const lanes = useMemo(() => (plan && program ? laneBars(program, plan) : []), [program, plan]);
  return (
    <div className="timeline" data-plots={plots && plan && plan.duration_s > 0 ? true : undefined}>
      <Transport hasPlan={plan !== null && plan.duration_s > 0} />
      {plan && plan.duration_s > 0 ? (
        <div className="track-area">
          {lanes.length > 0 && program && <Lanes bars={lanes} duration_s={plan.duration_s} program={program} />}
          <Track blocks={blocks} duration_s={plan.duration_s} />
        </div>
      ) : (
        <p className="timeline-empty">{words.time.empty}</p>
      )}
      {plots && plan && plan.duration_s > 0 && (
        <Suspense fallback={<div className="plots" />}>
          <Plots plan={plan} />
        </Suspense>
      )}
    </div>
  );
}

function Transport({ hasPlan }: { hasPlan: boolean }) {
  const physics = useStore(physicsStore, state => state.on);
  const moving = useStore(
    physicsStore,
    ({ status }) => status === "running" || status === "stopped" || status === "loading",
  );
  const playing = useStore(playStore, state => (physics ? moving : state.playing));
  const duration = useStore(playStore, state => state.plan?.duration_s ?? 0);
  const repairs = useStore(playStore, state => stepsToRepair(state.verdict));
  const ours = useStore(cellStore, ({ document }) => document !== null && selectedProgram(document) !== undefined);
  const plots = useStore(viewStore, state => state.plots);
  const checking = useStore(playStore, state => state.checking);
  const robot = useStore(cellStore, state => robotOf(state.document));
  const language = useStore(languageStore, state => languageOf(robot, state)?.name ?? "");
  const clock = useRef<HTMLSpanElement>(null);
  useEffect(
    () =>
      onFrame(() => {
        const text = words.time.s(physicsStore.getState().on ? (physicsNow()?.t_s ?? 0) : playheadNow());
        if (clock.current && clock.current.textContent !== text) clock.current.textContent = text;
      }),
    [],
  );
  return (
    <div className="transport">
      <button className="btn primary" disabled={!hasPlan} onClick={() => runCommand("play.toggle")}>
        {playing ? <Pause /> : <Play />}
        {playing ? words.time.pause : words.time.play}
      </button>
      <Tip words={words.time.back} keys="ArrowLeft">
        <button
          className="btn icon"
          aria-label={words.time.back}
          disabled={!hasPlan}
          onClick={() => runCommand("play.back")}
        >
          <SkipBack />
        </button>
      </Tip>
      <Tip words={words.time.step} keys="ArrowRight">
        <button
          className="btn icon"
          aria-label={words.time.step}
          disabled={!hasPlan}
          onClick={() => runCommand("play.step")}
        >
          <SkipForward />
        </button>
      </Tip>
      <span className="clock">
        <span ref={clock}>0.00</span> s{" "}
        <span className="dim">
          {words.time.of} {words.time.s(duration)} s
        </span>
      </span>
      <span className="grow" />
      {checking !== null && (
        <span className="row-flex small muted" role="status">
          <span className="progress checking-bar">
            <i style={{ width: `${checking * 100}%` }} />
          </span>
          {words.check.percent(Math.round(checking * 100))}
          <button className="btn quiet tight" onClick={() => runCommand("check.cancel")}>
            {words.common.cancel}
          </button>
        </span>
      )}
      <Tip words={words.physics.tip}>
        <button className="btn quiet" aria-pressed={physics} onClick={() => runCommand("play.physics")}>
          <Weight />
          {words.physics.toggle}
        </button>
      </Tip>
      <Tip words={words.time.plots}>
        <button className="btn quiet" aria-pressed={plots} onClick={() => runCommand("view.plots")}>
          <ChartSpline />
          {words.time.plots}
        </button>
      </Tip>
      {ours && repairs > 0 && (
        <button className="btn" onClick={() => runCommand("check.repair-all")}>
          {words.check.repairAll(repairs)}
        </button>
      )}
      <button className="btn" onClick={() => runCommand("export.open")}>
        {language === "" ? words.export.buttonNone : words.export.button(language)}
      </button>
    </div>
  );
}

/** Loops and pallets over the steps that they hold, with a tick where each pass begins; a click selects the block. */
function Lanes({
  bars,
  duration_s,
  program,
}: {
  readonly bars: readonly LaneBar[];
  readonly duration_s: number;
  readonly program: Program;
}) {
  const selected = useStore(selectionStore, state => (state.selected?.kind === "step" ? state.selected.id : null));
  const deepest = Math.min(MOST_LANES, 1 + Math.max(...bars.map(({ depth }) => depth)));
  const percent = (t_s: number): string => `${(100 * t_s) / duration_s}%`;
  return (
    <div className="lanes" style={{ height: deepest * LANE_PX }}>
      {bars
        .filter(({ depth }) => depth < MOST_LANES)
        .map(({ key, step, depth, start_s, end_s, passes_s }) => {
          const found = findStep(program, step);
          const name = found ? stepWords(found.step, found.index) : step;
          const says = passes_s.length > 1 ? words.time.passes(name, passes_s.length) : name;
          return (
            <button
              key={key}
              className="lane"
              data-on={step === selected}
              title={says}
              style={{ top: depth * LANE_PX, left: percent(start_s), width: percent(end_s - start_s) }}
              onClick={() => select({ kind: "step", id: step })}
            >
              {passes_s.slice(1).map(at_s => (
                <i key={at_s} style={{ left: `${(100 * (at_s - start_s)) / (end_s - start_s)}%` }} aria-hidden />
              ))}
              <span>{says}</span>
            </button>
          );
        })}
    </div>
  );
}
const LANE_PX = 18;
/** Blocks nested deeper are in the list of steps alone. */
const MOST_LANES = 3;

/** Blocks and the playhead. The playhead is moved by style in the frame loop, not by React. */
function Track({ blocks, duration_s }: { blocks: readonly Block[]; duration_s: number }) {
  const track = useRef<HTMLDivElement>(null);
  const head = useRef<HTMLDivElement>(null);
  const selected = useStore(selectionStore, state => (state.selected?.kind === "step" ? state.selected.id : null));
  useEffect(() => {
    let shown = -1;
    return onFrame(() => {
      const t = playheadNow();
      if (t === shown || !head.current) return;
      shown = t;
      head.current.style.left = `${(t / duration_s) * 100}%`;
      head.current.setAttribute("aria-valuenow", t.toFixed(2));
    });
  }, [duration_s]);
  const at = (event: PointerEvent<HTMLElement>): void => {
    const box = track.current?.getBoundingClientRect();
    if (box) seek(((event.clientX - box.left) / box.width) * duration_s);
  };
  const onKey = (event: KeyboardEvent): void => {
    const step = event.shiftKey ? 1 : 0.1;
    const to =
      event.key === "ArrowLeft"
        ? playheadNow() - step
        : event.key === "ArrowRight"
          ? playheadNow() + step
          : event.key === "Home"
            ? 0
            : event.key === "End"
              ? duration_s
              : null;
    if (to === null) return;
    event.preventDefault();
    event.stopPropagation();
    seek(to);
  };
  return (
    <div
      className="track"
      ref={track}
      onPointerDown={event => {
        event.currentTarget.setPointerCapture(event.pointerId);
        at(event);
        const under = document.elementFromPoint(event.clientX, event.clientY)?.closest<HTMLElement>("[data-block]");
        if (under?.dataset.block) select({ kind: "step", id: under.dataset.block });
      }}
      onPointerMove={event => {
        if (event.currentTarget.hasPointerCapture(event.pointerId)) at(event);
      }}
    >
      {blocks.map(block => (
        <div
          key={block.key}
          className="block"
          data-block={block.step}
          data-verdict={block.rest && block.verdict !== "bad" ? "rest" : block.verdict}
          data-parts={block.pieces.length > 0 ? true : undefined}
          data-on={block.step === selected}
          title={block.name}
          style={{ left: `${(block.start_s / duration_s) * 100}%`, width: `${(block.duration_s / duration_s) * 100}%` }}
        >
          <span>
            {block.pieces.map(({ from, to, verdict }) => (
              <i
                key={from}
                className="block-piece"
                data-verdict={verdict}
                style={{ left: `${from * 100}%`, width: `${(to - from) * 100}%` }}
                aria-hidden
              />
            ))}
            <i className="mark" data-verdict={block.verdict} aria-hidden />
            <span className="block-name">
              {block.findings > 0 ? words.time.over(block.name, block.findings) : block.name}
            </span>
          </span>
        </div>
      ))}
      <div
        className="playhead"
        ref={head}
        role="slider"
        tabIndex={0}
        aria-label={words.time.scrubber}
        aria-valuemin={0}
        aria-valuemax={Number(duration_s.toFixed(2))}
        aria-valuenow={0}
        onKeyDown={onKey}
      />
    </div>
  );
}
