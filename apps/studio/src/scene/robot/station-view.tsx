import { useStore } from "zustand";
import { stationLive } from "../../live/stations.ts";
import { stationStore } from "../../stores/stations.ts";
import { ArmView } from "./arm-view.tsx";

/** The robots of the other controllers, each where it stands and as its last sample says. */
export function StationViews() {
  const stations = useStore(stationStore, state => state.stations);
  return stations.map(({ id, stand }) => {
    const live = stationLive(id);
    return live ? <ArmView key={id} robot={live.robot} worldFromBase={stand} live={() => live} prefix={`${id}/`} /> : null;
  });
}
