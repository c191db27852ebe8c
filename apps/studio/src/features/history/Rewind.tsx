import { Pause, Play } from "lucide-react";
import { useStore } from "zustand";
import { runCommand } from "../../stores/commands.ts";
import { historyStore } from "../../stores/history.ts";
import { theTravel } from "../../stores/travel.ts";
import { Segments } from "../../ui/Choice.tsx";
import { Slide } from "../../ui/Slide.tsx";
import { words } from "../../words/index.ts";
import "./history.css";

/** The timeline of a recorded run. */
export function Rewind() {
  const { open, duration_s, t_s, playing, speed, step } = useStore(historyStore);
  if (!open) return <div className="rewind"><p className="timeline-empty">{words.history.choose}</p></div>;
  return (
    <div className="rewind">
      <div className="transport">
        <button className="btn primary" onClick={() => runCommand("history.play")}>{playing ? <Pause /> : <Play />}{playing ? words.time.pause : words.time.play}</button>
        <span className="clock">{words.time.s(t_s)} s <span className="dim">/ {words.time.s(duration_s)} s</span></span>
        <span className="grow muted small">{step}</span>
        <Segments label={words.time.speed} className="seg small-seg" value={String(speed)} onChange={value => theTravel()?.setSpeed(Number(value))} options={["0.25", "0.5", "1", "4"].map(value => ({ value, words: `${value}×` }))} />
      </div>
      <Slide label={words.time.scrubber} value={t_s} max={Math.max(0.01, duration_s)} step={0.01} says={`${words.time.s(t_s)} s`} onChange={to => theTravel()?.seek(to)} />
    </div>
  );
}
