import type { FleetEntry } from "@twincell/protocol";
import { useState } from "react";
import { Segments } from "../../ui/Choice.tsx";
import { words } from "../../messages/index.ts";
import { keyOf, shownRobots } from "./order.ts";
import { openTwin } from "./FleetCard.tsx";

type Colour = "state" | "use" | "link";
/** Beyond this a link is as slow as the map can show [s]. */
const SLOW_S = 0.1;
const shareOf = (robot: FleetEntry, colour: Colour): number =>
  colour === "use" ? robot.use : Math.min(1, (robot.roundTrip_s ?? 0) / SLOW_S);

/** A square for each robot, those of a site together; names only of what needs somebody. */
export function FleetMap({
  robots,
  lit,
  onLight,
}: {
  readonly robots: readonly FleetEntry[];
  readonly lit: string | null;
  readonly onLight: (key: string | null) => void;
}) {
  const [colour, setColour] = useState<Colour>("state");
  const sites = [...new Set(robots.map(({ site }) => site))].sort();
  return (
    <section className="fleet-map" aria-label={words.fleet.map}>
      <h3>
        <span className="grow">{words.fleet.map}</span>
        <Segments
          className="seg small-seg"
          label={words.fleet.colour}
          value={colour}
          onChange={setColour}
          options={(["state", "use", "link"] as const).map(value => ({ value, words: words.fleet.colours[value] }))}
        />
      </h3>
      {sites.map(site => (
        <div key={site} className="fleet-site">
          <span className="small muted">{site}</span>
          <div className="fleet-places">
            {shownRobots(robots, { query: "", state: null, site, order: "name" }).map(robot => (
              <button
                key={keyOf(robot)}
                className="fleet-place"
                data-state={robot.state}
                data-colour={colour}
                data-lit={lit === keyOf(robot)}
                style={colour === "state" ? undefined : { ["--share" as string]: shareOf(robot, colour) }}
                aria-label={`${robot.name}: ${words.fleet.states[robot.state]}`}
                title={robot.name}
                onPointerEnter={() => onLight(keyOf(robot))}
                onPointerLeave={() => onLight(null)}
                onClick={() => void openTwin(robot)}
              >
                {(robot.state === "stopped" || robot.state === "attention") && <span>{robot.name}</span>}
              </button>
            ))}
          </div>
        </div>
      ))}
    </section>
  );
}
