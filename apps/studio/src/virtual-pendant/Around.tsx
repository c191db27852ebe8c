import { DoorOpen, OctagonAlert, PersonStanding, RotateCcw } from "lucide-react";
import { useStore } from "zustand";
import { words } from "../messages/index.ts";
import type { VirtualPendantLink } from "./link.ts";

/** What happens around the robot, what the controller makes of it, and the way out. */
export function Around({ link }: { readonly link: VirtualPendantLink }) {
  const told = useStore(link.view, state => state.words)!;
  const { near, gateOpen, alarms, safety, running, program } = useStore(link.view, state => state.lamps)!;
  return (
    <section className="desk-around stack" aria-label={words.cabinet.around}>
      <div className="desk-buttons">
        <button
          className="btn"
          aria-pressed={near}
          onClick={() => {
            link.act({ do: "near", somebody: !near });
          }}
        >
          <PersonStanding />
          {words.cabinet.near}
        </button>
        <button
          className="btn"
          aria-pressed={gateOpen}
          onClick={() => {
            link.act({ do: "guard", open: !gateOpen });
          }}
        >
          <DoorOpen />
          {words.cabinet.gate}
        </button>
        <button
          className="btn"
          onClick={() => {
            link.act({ do: "protective-stop", because: words.cabinet.because });
          }}
        >
          <OctagonAlert />
          {words.cabinet.protective}
        </button>
      </div>
      <div className="desk-alarms" data-any={alarms.length > 0 || safety !== "normal"}>
        {alarms.length === 0 ? (
          <p className="small muted">
            {safety === "normal" ? words.cabinet.noAlarms : words.control.safetyStates[safety]}
          </p>
        ) : (
          <ul role="alert">
            {alarms.map((alarm, i) => (
              <li key={`${i} ${alarm}`}>{alarm}</li>
            ))}
          </ul>
        )}
        <button
          className="btn tight"
          onClick={() => {
            link.act({ do: "reset" });
          }}
        >
          <RotateCcw />
          {told.labels.reset}
        </button>
      </div>
      <p className="small muted">
        <span className="lamp" data-on={running} aria-hidden />{" "}
        {program === "" ? words.cabinet.noProgram : words.cabinet.program(program, running)}
      </p>
    </section>
  );
}
