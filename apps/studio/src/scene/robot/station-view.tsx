import { Fragment, useEffect } from "react";
import { useStore } from "zustand";
import { shownInstead } from "../../runtime/robot/drawn-robots.ts";
import { stationLive } from "../../runtime/robot/stations.ts";
import type { Pose } from "@twincell/core";
import { cellStore } from "../../stores/cell.ts";
import { runCommand } from "../../stores/commands.ts";
import { connectionStore } from "../../stores/connection.ts";
import { historyStore } from "../../stores/history.ts";
import { stationStore } from "../../stores/stations.ts";
import { viewStore } from "../../stores/view.ts";
import { ArmView } from "./arm-view.tsx";

/** Of the ghost that runs ahead: its way is free, or something is met on it. */
const FREE = "#3fb8b3";
const BLOCKED = "#ff6157";
/** Of the twin while its clone is programmed in a headset: it stands in the same place and must not hide it. */
const TWIN = "#8b969c";

/** The robots of the other controllers, each where it stands and as its last sample says. */
export function StationViews() {
  const stations = useStore(stationStore, state => state.stations);
  const cell = useStore(connectionStore, state => state.station);
  const view = useStore(connectionStore, state => state.view);
  const base = useStore(cellStore, state => state.document?.robot.worldFromBase);
  const past = useStore(historyStore, state => state.past);
  const lookingBack = useStore(viewStore, state => state.mode === "history");
  const inHeadset = useStore(viewStore, state => state.inHeadset);
  // All of them are to be seen, also the one that has just come.
  useEffect(() => {
    runCommand("view.fit");
  }, [stations.length]);
  return stations.map(({ id, stand: own, ghost }) => {
    // The robot of the cell stands where the cell says.
    const stand = id === cell ? (base ?? own) : own;
    // Where the past of a robot is looked at, its presence would stand in the same place.
    if (lookingBack && past && samePlace(past, stand)) return null;
    const live = stationLive(id);
    if (!live) return null;
    return (
      <Fragment key={id}>
        {(id !== cell || view === "clone") && (
          <ArmView
            key={id === cell && inHeadset ? "ghost" : "solid"}
            robot={live.robot}
            worldFromBase={stand}
            live={() => shownInstead(id) ?? live}
            prefix={`${id}/`}
            ghost={id === cell && inHeadset ? TWIN : undefined}
          />
        )}
        {ghost !== "none" && (
          <ArmView
            robot={live.robot}
            worldFromBase={stand}
            live={() => live.ahead}
            prefix={`${id}/ahead/`}
            ghost={ghost === "blocked" ? BLOCKED : FREE}
          />
        )}
      </Fragment>
    );
  });
}

const samePlace = (a: Pose<"world", "base">, b: Pose<"world", "base">): boolean =>
  a.position.every((value, i) => Math.abs(value - b.position[i]!) < 1e-6);
