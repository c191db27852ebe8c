import { Pause, Play } from "lucide-react";
import { useStore } from "zustand";
import { theHistory } from "../../live/cell-control.ts";
import { historyStore } from "../../stores/history.ts";
import { Slide } from "../../ui/Slide.tsx";
import { words } from "../../words/index.ts";
import "./history.css";

const SPEEDS = [0.25, 1, 4] as const;
const seconds = (t_s: number): string => `${t_s.toFixed(2)} s`;

/** The timeline of the open run: any moment of it, at any pace, with a mark where something happened. */
export default function Rewind() {
  const { open, opening, t_s, duration_s, playing, speed, events } = useStore(historyStore);
  if (open === null) return <p className="timeline-empty rewind-empty">{words.history.choose}</p>;
  if (opening) return <p className="timeline-empty rewind-empty" role="status">{words.history.loading}</p>;
  const whole_s = Math.max(duration_s, 0.001);
  return (
    <div className="rewind">
      <div className="rewind-transport">
        <button className="btn primary" onClick={() => { if (playing) theHistory.pause(); else theHistory.play(); }}>{playing ? <Pause /> : <Play />}{playing ? words.time.pause : words.time.play}</button>
        <span className="clock">{seconds(t_s)} <span className="dim">{words.time.of} {seconds(duration_s)}</span></span>
        <span className="grow" />
        <span className="rewind-speeds" role="group" aria-label={words.time.speed}>
          {SPEEDS.map(factor => <button key={factor} className="btn tight" aria-pressed={speed === factor} onClick={() => { theHistory.setSpeed(factor); }}>{factor} ×</button>)}
        </span>
      </div>
      <div className="rewind-track">
        <Slide label={words.history.moment} value={t_s} min={0} max={whole_s} step={0.001} says={seconds(t_s)} onChange={theHistory.seek} />
        {events.map((event, i) => <i key={i} className="rewind-mark" data-level={event.level} aria-hidden style={{ left: `calc(8px + (100% - 16px) * ${event.at_s / whole_s})` }} />)}
      </div>
    </div>
  );
}
