import { Play, RotateCcw } from "lucide-react";
import { useStore } from "zustand";
import { cellStore } from "../../stores/cell.ts";
import { runCommand } from "../../stores/commands.ts";
import { physicsStore } from "../../stores/physics.ts";
import { viewStore } from "../../stores/view.ts";
import { say, words } from "../../messages/index.ts";
import "./physics.css";

const SHOWN = 4;

/** What happens while a program is played with contact: how it stands, which sensors are lit, what was said last. */
export function Physics() {
  const on = useStore(physicsStore, state => state.on);
  const history = useStore(viewStore, state => state.mode === "history");
  return on && !history ? <Panel /> : null;
}

function Panel() {
  const { status, said, tripped, assumptions } = useStore(physicsStore);
  const sensors = useStore(cellStore, state => state.document?.sensors) ?? [];
  return (
    <section className="physics float" aria-label={words.physics.title} data-status={status}>
      <p className="physics-state" role="status">
        <i className="physics-lamp" aria-hidden />
        {words.physics.status[status]}
      </p>
      {sensors.length > 0 && status !== "idle" && (
        <ul className="physics-sensors" aria-label={words.physics.sensors}>
          {sensors.map(({ id, name }) => (
            <li key={id} data-tripped={tripped.includes(id)}>
              <i aria-hidden />
              {name} <span className="dim">{tripped.includes(id) ? words.physics.tripped : words.physics.free}</span>
            </li>
          ))}
        </ul>
      )}
      {said.length > 0 && (
        <ol className="physics-said">
          {said.slice(0, SHOWN).map((sentence, i) => (
            <li key={`${said.length - i} ${sentence}`}>{say(sentence)}</li>
          ))}
        </ol>
      )}
      {status === "stopped" && (
        <button className="btn primary" onClick={() => runCommand("play.resume")}>
          <Play />
          {words.physics.go}
        </button>
      )}
      {(status === "done" || status === "paused") && (
        <button className="btn" onClick={() => runCommand("play.toggle")}>
          <RotateCcw />
          {words.physics.again}
        </button>
      )}
      {assumptions.length > 0 && status !== "idle" && (
        <details className="small muted">
          <summary>{words.physics.restsOn}</summary>
          <p>{assumptions.map(say).join(" ")}</p>
        </details>
      )}
    </section>
  );
}
