import { useRef, useState } from "react";
import { useStore } from "zustand";
import {
  connectCellRobot,
  disconnectCellRobot,
  fetchFromThere,
  sendThere,
  setEnabled,
  showAs,
  tellRefused,
} from "../../runtime/robot/cell-connection.ts";
import { DRIVER_LIST } from "../../runtime/robot/driver-list.ts";
import { cellStore } from "../../stores/cell.ts";
import { connectionStore } from "../../stores/connection.ts";
import { openRealController } from "../../stores/dialogs.ts";
import { notify } from "../../stores/notices.ts";
import { isCarryingOut, stationStore } from "../../stores/stations.ts";
import { Chooser, Segments } from "../../ui/Choice.tsx";
import { EnablingSwitch } from "../../ui/EnablingSwitch.tsx";
import { Tip } from "../../ui/Tip.tsx";
import { useEnablingSwitch } from "../../ui/useEnablingSwitch.ts";
import { words } from "../../messages/index.ts";

const SIMULATED = "simulated";
const REAL = "real";

/** The one connection of the robot of the cell: its controller, live or clone, and the enabling switch. */
export function Connection() {
  const robot = useStore(cellStore, state => state.document?.robot.id ?? "");
  const id = useStore(connectionStore, state => state.station);
  const station = useStore(stationStore, state => state.stations.find(each => each.id === id));
  const [busy, setBusy] = useState(false);
  const drivers = DRIVER_LIST.filter(({ port, robots }) => port === null && robots.some(each => each.id === robot));
  const value = id === null ? SIMULATED : station && !station.virtual ? REAL : (station?.brand ?? SIMULATED);
  const choose = async (next: string): Promise<void> => {
    if (next === REAL) {
      openRealController();
      return;
    }
    setBusy(true);
    if (next === SIMULATED) await disconnectCellRobot();
    else {
      const outcome = await connectCellRobot(next, "page");
      if (outcome.kind !== "done") notify("bad", outcome.why.sentence, outcome.why.hint);
    }
    setBusy(false);
  };
  return (
    <div className="connection" aria-busy={busy}>
      <div className="pair">
        <span className="label">{words.connection.title}</span>
        <Chooser
          label={words.connection.title}
          value={value}
          options={[
            { value: SIMULATED, words: words.connection.simulated },
            ...drivers.map(driver => ({ value: driver.id, words: words.connection.virtual(driver.name) })),
            { value: REAL, words: words.connection.real },
          ]}
          onChange={next => void choose(next)}
        />
      </div>
      {station && (
        <Connected ready={station.link.state === "open" && !station.guard.watching && !isCarryingOut(station)} />
      )}
    </div>
  );
}

function Connected({ ready }: { readonly ready: boolean }) {
  const view = useStore(connectionStore, state => state.view);
  // Space holds wherever the focus is, but not in a field.
  const page = useRef(document.body);
  const enabling = useEnablingSwitch(page, setEnabled);
  return (
    <>
      <Segments
        label={words.connection.view}
        className={`seg fill small-seg connection-view ${view}`}
        value={view}
        onChange={showAs}
        options={[
          { value: "live", words: words.connection.live },
          { value: "clone", words: words.connection.clone },
        ]}
      />
      {view === "clone" && (
        <div className="row-flex connection-send">
          <Tip words={words.connection.sendTip}>
            <button className="btn" disabled={!ready || !enabling.enabled} onClick={() => tellRefused(sendThere())}>
              {words.connection.send}
            </button>
          </Tip>
          <Tip words={words.connection.fetchTip}>
            <button className="btn" onClick={fetchFromThere}>
              {words.connection.fetch}
            </button>
          </Tip>
        </div>
      )}
      <EnablingSwitch of={enabling} disabled={!ready} />
    </>
  );
}
