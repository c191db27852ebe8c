import { Users } from "lucide-react";
import { useState } from "react";
import { startSynchronized } from "../../runtime/robot/stations.ts";
import { askBeforeSending } from "../../runtime/run/ask-before-run.ts";
import { notify } from "../../stores/notices.ts";
import type { StationState } from "../../stores/stations.ts";
import { Tip } from "../../ui/Tip.tsx";
import { words } from "../../messages/index.ts";

/** Which of the controllers start together, and the start. */
export function SynchronizedStart({ stations }: { readonly stations: readonly StationState[] }) {
  const [left, setLeft] = useState<readonly string[]>([]);
  const running = stations.some(station => station.running);
  const able = stations.filter(({ link, guard }) => link.state === "open" && !guard.watching);
  const chosen = able.filter(({ id }) => !left.includes(id));
  const start = (): void => {
    const ids = chosen.map(({ id }) => id);
    askBeforeSending(ids, () => {
      void startSynchronized(ids).then(outcome => {
        if (outcome.kind === "done") notify("done", words.stations.togetherDone);
        else notify(outcome.kind === "stopped" ? "warn" : "bad", outcome.why.sentence, outcome.why.hint);
      });
    });
  };
  return (
    <fieldset className="together">
      <legend className="small dim">{words.stations.togetherOf}</legend>
      {stations.map(({ id, name }) => {
        const may = able.some(each => each.id === id);
        return (
          <label key={id} className="row-flex small">
            <input
              type="checkbox"
              disabled={!may || running}
              checked={may && !left.includes(id)}
              onChange={event => {
                setLeft(event.currentTarget.checked ? left.filter(each => each !== id) : [...left, id]);
              }}
            />
            {name}
          </label>
        );
      })}
      <Tip words={words.stations.togetherTip}>
        <button className="btn primary" disabled={chosen.length < 2 || running} onClick={start}>
          <Users />
          {words.stations.together}
        </button>
      </Tip>
    </fieldset>
  );
}
