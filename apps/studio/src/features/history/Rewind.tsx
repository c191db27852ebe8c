import { Pause, Play } from "lucide-react";
import { useStore } from "zustand";
import { theHistory } from "../../runtime/robot/cell-control.ts";
import { historyStore, zoomTo } from "../../stores/history.ts";
import { Slide } from "../../ui/Slide.tsx";
import { words } from "../../messages/index.ts";
import { clockOf } from "./times.ts";
import "./history.css";

const SPEEDS = [0.25, 1, 4, 60] as const;
const ZOOMS = [
  ["all", null],
  ["hour", 3600],
  ["tenMinutes", 600],
  ["minute", 60],
  ["ten", 10],
] as const;
const MOST_TICKS = 300;
/** What one key press moves by: some thousandth of what is shown, a round number, 1 ms at least. */
const stepOf = (shown_s: number): number => Math.max(0.001, 10 ** Math.floor(Math.log10(shown_s / 5000)));

/**
 * The timeline of what is open: any moment of it, at any pace, with a mark where something happened. Long recordings
 * are looked at part by part.
 */
export default function Rewind() {
  const { open, name, opening, t_s, duration_s, playing, speed, marks, window } = useStore(historyStore);
  if (open === null && name === "") return <p className="timeline-empty rewind-empty">{words.history.choose}</p>;
  if (opening)
    return (
      <p className="timeline-empty rewind-empty" role="status">
        {words.history.loading}
      </p>
    );
  const whole_s = Math.max(duration_s, 0.001);
  const shown_s = Math.max(window.to_s - window.from_s, 0.001);
  const ticks = marks.filter(mark => mark.at_s >= window.from_s && mark.at_s <= window.to_s);
  const every = Math.ceil(ticks.length / MOST_TICKS);
  const zooms = ZOOMS.filter(([, length_s]) => length_s === null || length_s < duration_s);
  return (
    <div className="rewind">
      <div className="rewind-transport">
        <button
          className="btn primary"
          onClick={() => {
            if (playing) theHistory.pause();
            else theHistory.play();
          }}
        >
          {playing ? <Pause /> : <Play />}
          {playing ? words.time.pause : words.time.play}
        </button>
        <span className="clock">
          {clockOf(t_s)}{" "}
          <span className="dim">
            {words.time.of} {clockOf(duration_s)}
          </span>
        </span>
        <span className="grow" />
        {zooms.length > 1 && (
          <span className="rewind-speeds" role="group" aria-label={words.history.zoom}>
            {zooms.map(([key, length_s]) => (
              <button
                key={key}
                className="btn tight"
                aria-pressed={Math.abs(shown_s - (length_s ?? whole_s)) < 1e-6}
                onClick={() => {
                  zoomTo(length_s);
                }}
              >
                {words.history.zooms[key]}
              </button>
            ))}
          </span>
        )}
        <span className="rewind-speeds" role="group" aria-label={words.time.speed}>
          {SPEEDS.map(factor => (
            <button
              key={factor}
              className="btn tight"
              aria-pressed={speed === factor}
              onClick={() => {
                theHistory.setSpeed(factor);
              }}
            >
              {factor} ×
            </button>
          ))}
        </span>
      </div>
      {shown_s < whole_s - 1e-6 && (
        <button
          className="rewind-overview"
          aria-label={words.history.overview}
          onClick={event => {
            const box = event.currentTarget.getBoundingClientRect();
            theHistory.seek(((event.clientX - box.left) / box.width) * whole_s);
          }}
        >
          <i
            className="rewind-window"
            style={{
              left: `${(100 * window.from_s) / whole_s}%`,
              width: `${Math.max(0.5, (100 * shown_s) / whole_s)}%`,
            }}
          />
          <i className="rewind-now" style={{ left: `${(100 * t_s) / whole_s}%` }} />
        </button>
      )}
      <div className="rewind-track">
        <Slide
          label={words.history.moment}
          value={t_s}
          min={window.from_s}
          max={window.from_s + shown_s}
          step={stepOf(shown_s)}
          says={clockOf(t_s)}
          onChange={theHistory.seek}
        />
        {ticks
          .filter((mark, i) => mark.level === "error" || i % every === 0)
          .slice(0, 2 * MOST_TICKS)
          .map((mark, i) => (
            <i
              key={i}
              className="rewind-mark"
              data-level={mark.level}
              aria-hidden
              style={{ left: `calc(8px + (100% - 16px) * ${(mark.at_s - window.from_s) / shown_s})` }}
            />
          ))}
      </div>
    </div>
  );
}
