import { useState } from "react";
import { useStore } from "zustand";
import type { CommandOutcome } from "@twincell/core";
import type { ConnectedRobot } from "../../runtime/robot/connected-robot.ts";
import { cellStore } from "../../stores/cell.ts";
import { programOf } from "../../stores/document.ts";
import { Chooser } from "../../ui/Choice.tsx";
import { words } from "../../messages/index.ts";

/** Writes the digital outputs that the program of the cell names; nothing is shown for a program without any. */
export function SignalControl({
  robot,
  may,
  tell,
}: {
  readonly robot: ConnectedRobot;
  readonly may: boolean;
  readonly tell: (outcome: Promise<CommandOutcome>) => void;
}) {
  const program = useStore(cellStore, state => programOf(state.document));
  const outputs = Object.entries(program?.signals ?? {}).flatMap(([name, { kind }]) =>
    kind === "digital-out" ? [name] : [],
  );
  const [chosen, setChosen] = useState("");
  const signal = outputs.includes(chosen) ? chosen : outputs[0];
  if (signal === undefined) return null;
  return (
    <div className="direct-buttons">
      <Chooser
        label={words.direct.signal}
        value={signal}
        options={outputs.map(name => ({ value: name, words: name }))}
        onChange={setChosen}
      />
      <button className="btn" disabled={!may} onClick={() => tell(robot.setSignal(signal, true))}>
        {words.direct.signalOn}
      </button>
      <button className="btn" disabled={!may} onClick={() => tell(robot.setSignal(signal, false))}>
        {words.direct.signalOff}
      </button>
    </div>
  );
}
