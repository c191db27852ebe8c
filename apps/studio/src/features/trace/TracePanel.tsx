import { X } from "lucide-react";
import { useStore } from "zustand";
import { runCommand } from "../../stores/commands.ts";
import { PROCESS_NAMES, PROCESSES, processOf, type ProcessName } from "../../stores/processes.ts";
import { traceStore, type TraceOptions } from "../../stores/trace.ts";
import { Chooser, Segments } from "../../ui/Choice.tsx";
import { showNumber } from "../../ui/expression.ts";
import { NumberField } from "../../ui/NumberField.tsx";
import { showKeys } from "../../ui/keys.ts";
import { words } from "../../messages/index.ts";
import "./trace.css";

const change = (next: Partial<TraceOptions>): void =>
  traceStore.setState(({ options }) => ({ options: { ...options, ...next } }));
const length = (polyline: readonly (readonly number[])[]): number =>
  polyline
    .slice(1)
    .reduce((sum, point, i) => sum + Math.hypot(...point.map((value, k) => value - polyline[i]![k]!)), 0);

/** Which edges, with which tool angle and tolerances; one button makes the points. */
export function TracePanel() {
  const { chosen, options, wholeLoop, working, last } = useStore(traceStore);
  return (
    <section className="trace" aria-label={words.trace.title} aria-busy={working}>
      <h2 className="heading">
        <span className="grow">{words.trace.title}</span>
        <button className="btn quiet tight" onClick={() => runCommand("trace.toggle")}>
          {words.trace.leave}
        </button>
      </h2>
      <div className="section stack">
        <label className="row-flex">
          <input
            type="checkbox"
            checked={wholeLoop}
            onChange={event => traceStore.setState({ wholeLoop: event.currentTarget.checked })}
          />
          {words.trace.loop}
          <span className="grow" />
          <span className="kbd" aria-hidden>
            {showKeys("Shift")}
          </span>
        </label>
        {chosen.length === 0 ? (
          <p className="small muted">{words.trace.none}</p>
        ) : (
          <ol className="trace-edges" aria-label={words.trace.chosen}>
            {chosen.map((edge, i) => (
              <li key={`${edge.object} ${edge.edge} ${i}`}>
                <i className="mark" data-verdict="ok" aria-hidden />
                <span className="grow">{words.trace.edge(i + 1, showNumber(length(edge.polyline), "length", 0))}</span>
                <button
                  className="btn quiet icon tight"
                  aria-label={words.trace.remove(i + 1)}
                  onClick={() => traceStore.setState({ chosen: chosen.toSpliced(i, 1) })}
                >
                  <X />
                </button>
              </li>
            ))}
          </ol>
        )}
        <div className="row-flex">
          {working ? (
            <button className="btn grow" onClick={() => runCommand("trace.cancel")}>
              {words.trace.working} {words.common.cancel}
            </button>
          ) : (
            <button
              className="btn primary grow"
              disabled={chosen.length === 0}
              onClick={() => runCommand("trace.make")}
            >
              {words.trace.make}
            </button>
          )}
          <button
            className="btn"
            disabled={chosen.length === 0 || working}
            onClick={() => traceStore.setState({ chosen: [] })}
          >
            {words.trace.clear}
          </button>
        </div>
        {last && (
          <p className="small muted" role="status">
            {words.trace.made(last.points, last.edges, last.inserted)}{" "}
            {options.motion === "joint" &&
              words.trace.deviation(
                showNumber(last.deviation_m, "length", 3),
                showNumber(options.pathTolerance_m, "length", 2),
              )}
          </p>
        )}
        <details open={chosen.length === 0 && !last}>
          <summary className="small muted">{words.trace.options}</summary>
          <Line name={words.trace.process}>
            <Process options={options} />
          </Line>
          <p className="small dim">{words.trace.processSays}</p>
          <Line name={words.trace.tilt}>
            <NumberField
              label={words.trace.tilt}
              quantity="angle"
              decimals={1}
              value={options.tilt_rad}
              min={0}
              max={Math.PI / 2}
              onChange={tilt_rad => change({ tilt_rad })}
            />
          </Line>
          <Line name={words.trace.leadIn}>
            <NumberField
              label={words.trace.leadIn}
              quantity="length"
              decimals={1}
              value={options.leadIn_m}
              min={0}
              max={0.5}
              onChange={leadIn_m => change({ leadIn_m })}
            />
          </Line>
          <Line name={words.trace.leadOut}>
            <NumberField
              label={words.trace.leadOut}
              quantity="length"
              decimals={1}
              value={options.leadOut_m}
              min={0}
              max={0.5}
              onChange={leadOut_m => change({ leadOut_m })}
            />
          </Line>
          <Line name={words.trace.motion}>
            <Segments<TraceOptions["motion"]>
              label={words.trace.motion}
              value={options.motion}
              onChange={motion => change({ motion })}
              options={[
                { value: "joint", words: words.trace.joint },
                { value: "straight", words: words.trace.straight },
              ]}
            />
          </Line>
          <Line name={words.trace.tolerance}>
            <NumberField
              label={words.trace.tolerance}
              quantity="length"
              value={options.pathTolerance_m}
              min={0.00005}
              max={0.05}
              onChange={pathTolerance_m => change({ pathTolerance_m })}
            />
          </Line>
          <Line name={words.trace.chord}>
            <NumberField
              label={words.trace.chord}
              quantity="length"
              value={options.chordTolerance_m}
              min={0.00001}
              max={0.05}
              onChange={chordTolerance_m => change({ chordTolerance_m })}
            />
          </Line>
          <Line name={words.trace.speed}>
            <NumberField
              label={words.trace.speed}
              quantity="speed"
              decimals={0}
              value={options.speed_mps}
              min={0.001}
              max={2}
              onChange={speed_mps => change({ speed_mps })}
            />
          </Line>
        </details>
      </div>
    </section>
  );
}
const CHOICES = PROCESS_NAMES.map(value => ({ value, words: words.trace.processes[value] }));
/** Fills in the values of a process; a changed value belongs to none. */
function Process({ options }: { options: TraceOptions }) {
  const now = processOf(options);
  return (
    <Chooser<ProcessName | "own">
      label={words.trace.process}
      value={now ?? "own"}
      options={now ? CHOICES : [{ value: "own", words: words.trace.processNone }, ...CHOICES]}
      onChange={name => {
        if (name !== "own") change(PROCESSES[name]);
      }}
    />
  );
}
const Line = ({ name, children }: { name: string; children: React.ReactNode }) => (
  <div className="pair">
    <span className="label">{name}</span>
    {children}
  </div>
);
