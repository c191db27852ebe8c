import { useEffect } from "react";
import { useStore } from "zustand";
import { shownInstead } from "../../live/shown.ts";
import { stationLive } from "../../live/stations.ts";
import type { Pose } from "@twincell/core";
import { runCommand } from "../../stores/commands.ts";
import { historyStore } from "../../stores/history.ts";
import { stationStore } from "../../stores/stations.ts";
import { viewStore } from "../../stores/view.ts";
import { ArmView } from "./arm-view.tsx";

/** The robots of the other controllers, each where it stands and as its last sample says. */
export function StationViews() {
  const stations = useStore(stationStore, state => state.stations), past = useStore(historyStore, state => state.past), lookingBack = useStore(viewStore, state => state.mode === "history");
  // All of them are to be seen, also the one that has just come.
  useEffect(() => { runCommand("view.fit"); }, [stations.length]);
  return stations.map(({ id, stand }) => {
    // Where the past of a robot is looked at, its presence would stand in the same place.
    if (lookingBack && past && samePlace(past, stand)) return null;
    const live = stationLive(id);
    return live ? <ArmView key={id} robot={live.robot} worldFromBase={stand} live={() => shownInstead(id) ?? live} prefix={`${id}/`} /> : null;
  });
}

const samePlace = (a: Pose<"world", "base">, b: Pose<"world", "base">): boolean => a.position.every((value, i) => Math.abs(value - b.position[i]!) < 1e-6);
