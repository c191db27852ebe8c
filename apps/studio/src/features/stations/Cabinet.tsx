import { useState } from "react";
import { atPendant } from "../../live/stations.ts";
import { notify } from "../../stores/notices.ts";
import type { StationState } from "../../stores/stations.ts";
import { Segments } from "../../ui/Choice.tsx";
import { words } from "../../words/index.ts";

const MODES = ["manual", "automatic", "remote"] as const;

/** What a person does before the cabinet of a virtual controller (rows T-26, T-27). */
export function Cabinet({ station: { id, name, mode } }: { readonly station: StationState }) {
  const [gate, setGate] = useState(false), [pressed, setPressed] = useState(false);
  const act = (what: Parameters<typeof atPendant>[1]): void => {
    void atPendant(id, what).then(outcome => { if (outcome.kind !== "done") notify("warn", `${name}: ${outcome.why.sentence}`, outcome.why.hint); });
  };
  return (
    <fieldset className="cabinet">
      <legend className="small dim">{words.stations.pendant}</legend>
      <Segments label={words.stations.key} value={mode} onChange={to => { act({ do: "mode", mode: to }); }} options={MODES.map(value => ({ value, words: words.control.modes[value] }))} />
      <div className="station-buttons">
        <button className="btn tight" aria-pressed={gate} onClick={() => { setGate(!gate); act({ do: "guard", open: !gate }); }}>{gate ? words.stations.gateClose : words.stations.gateOpen}</button>
        <button className="btn tight danger" aria-pressed={pressed} onClick={() => { setPressed(!pressed); act({ do: "emergency-stop", pressed: !pressed }); }}>{pressed ? words.stations.redOut : words.stations.red}</button>
        <button className="btn tight" onClick={() => { act({ do: "reboot" }); }}>{words.stations.reboot}</button>
      </div>
    </fieldset>
  );
}
