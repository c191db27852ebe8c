import { Box, History, Plus } from "lucide-react";
import { useEffect, useState } from "react";
import { useStore } from "zustand";
import type { FleetEntry } from "@twincell/protocol";
import { fleetStore, watchFleet } from "../../runtime/fleet.ts";
import { closeDialog, dialogStore, openDialog } from "../../stores/dialogs.ts";
import { Segments } from "../../ui/Choice.tsx";
import { Frame } from "../../ui/Frame.tsx";
import { words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";
import { FleetCard, FleetRow, openHistory, openTwin, timeOf } from "./FleetCard.tsx";
import { FleetMap } from "./FleetMap.tsx";
import { figuresOf, inPlace, keyOf, needing, shownRobots, STATES, type FleetState, type Order } from "./order.ts";
import "./fleet.css";

/** All robots of a plant: states, alarms, use, and the way to the twin and the history of each. Commands nothing. */
export default function Fleet() {
  const open = useStore(dialogStore, state => state.open === "fleet");
  return (
    <Frame open={open} title={words.fleet.title} onClose={closeDialog} width={1400}>
      {open && <Page />}
    </Frame>
  );
}

function Page() {
  const { robots, sentence, asked_ms } = useStore(fleetStore);
  useEffect(watchFleet, []);
  if (sentence !== "") return <p className="empty">{words.fleet.noServer}</p>;
  if (asked_ms === null) return <div className="fleet-waiting" aria-busy="true" />;
  if (robots.length === 0)
    return (
      <p className="empty">
        {words.fleet.none} {words.fleet.noneSays}{" "}
        <button className="btn primary" onClick={() => openDialog("station")}>
          <Plus aria-hidden />
          {words.fleet.add}
        </button>
      </p>
    );
  return <Robots robots={robots} />;
}

function Robots({ robots }: { readonly robots: readonly FleetEntry[] }) {
  const [query, setQuery] = useState("");
  const [state, setState] = useState<FleetState | null>(null);
  const [site, setSite] = useState("");
  const [order, setOrder] = useState<Order>("site");
  const [layout, setLayout] = useState<"cards" | "list">("cards");
  const [lit, setLit] = useState<string | null>(null);
  // The order as it was when the pointer came: nothing jumps under it.
  const [places, setPlaces] = useState<readonly string[] | null>(null);
  const sorted = shownRobots(robots, { query, state, site, order });
  const shown = places === null ? sorted : inPlace(sorted, places);
  const { count } = figuresOf(robots);
  const sites = [...new Set(robots.map(each => each.site))].sort();
  const each = (robot: FleetEntry) => ({ robot, lit: lit === keyOf(robot), onLight: setLit });
  return (
    <div className="fleet">
      <Figures robots={robots} />
      <div className="fleet-bar">
        <button className="btn" aria-pressed={state === null} onClick={() => setState(null)}>
          {words.fleet.all(String(robots.length))}
        </button>
        {STATES.filter(one => count[one] > 0).map(one => (
          <button
            key={one}
            className="btn"
            aria-pressed={state === one}
            onClick={() => setState(state === one ? null : one)}
          >
            <i className="fleet-dot" data-state={one} aria-hidden />
            {words.fleet.only(words.fleet.states[one], String(count[one]))}
          </button>
        ))}
        {sites.length > 1 && (
          <Choice
            label={words.fleet.site}
            value={site}
            onChange={setSite}
            options={[["", words.fleet.everySite], ...sites.map(name => [name, name] as const)]}
          />
        )}
        <span className="field text fleet-search">
          <input
            type="search"
            aria-label={words.fleet.search}
            placeholder={words.fleet.search}
            value={query}
            onChange={event => setQuery(event.currentTarget.value)}
          />
        </span>
        <Choice
          label={words.fleet.order}
          value={order}
          onChange={setOrder}
          options={(["site", "state", "name"] as const).map(name => [name, words.fleet.orders[name]] as const)}
        />
        <Segments
          className="seg small-seg"
          label={words.fleet.layout}
          value={layout}
          onChange={setLayout}
          options={[
            { value: "cards", words: words.fleet.cards },
            { value: "list", words: words.fleet.list },
          ]}
        />
      </div>
      <div className="fleet-body">
        <div
          className="fleet-robots"
          onPointerEnter={() => setPlaces(sorted.map(keyOf))}
          onPointerLeave={() => setPlaces(null)}
        >
          {shown.length === 0 && (
            <p className="empty">
              {words.fleet.noHit(query)}{" "}
              <button
                className="btn"
                onClick={() => {
                  setQuery("");
                  setState(null);
                  setSite("");
                }}
              >
                {words.fleet.clear}
              </button>
            </p>
          )}
          <ul className={layout === "cards" ? "fleet-cards" : "fleet-list"} aria-label={words.fleet.title}>
            {shown.map(robot =>
              layout === "cards" ? (
                <FleetCard key={keyOf(robot)} {...each(robot)} />
              ) : (
                <FleetRow key={keyOf(robot)} {...each(robot)} />
              ),
            )}
          </ul>
        </div>
        <div className="fleet-side">
          <FleetMap robots={robots} lit={lit} onLight={setLit} />
          <NeedsYou robots={needing(robots)} />
        </div>
      </div>
    </div>
  );
}

function Figures({ robots }: { readonly robots: readonly FleetEntry[] }) {
  const { linked, count, use, slowest } = figuresOf(robots);
  const of = words.fleet.states;
  const share = robots.length === 0 ? 0 : Math.round((100 * count.running) / robots.length);
  const figures: readonly (readonly [string, string, string, FleetState | undefined])[] = [
    [words.fleet.robots, String(robots.length), words.fleet.linked(String(linked)), undefined],
    [of.running, String(count.running), `${share} %`, "running"],
    [of.idle, String(count.idle), "", undefined],
    [of.attention, String(count.attention), "", count.attention > 0 ? "attention" : undefined],
    [of.stopped, String(count.stopped), "", count.stopped > 0 ? "stopped" : undefined],
    [words.fleet.use, use === null ? "–" : `${Math.round(100 * use)} %`, words.fleet.useSays, undefined],
    [
      words.fleet.slowest,
      slowest?.roundTrip_s == null ? "–" : words.fleet.ms(fixed(1000 * slowest.roundTrip_s, 1)),
      slowest?.name ?? "",
      undefined,
    ],
  ];
  return (
    <dl className="fleet-figures" aria-label={words.fleet.figures}>
      {figures.map(([label, value, more, state]) => (
        <div key={label}>
          <dt>{label}</dt>
          <dd data-state={state}>
            <b>{value}</b>
            {more !== "" && <span className="small muted">{more}</span>}
          </dd>
        </div>
      ))}
    </dl>
  );
}

function NeedsYou({ robots }: { readonly robots: readonly FleetEntry[] }) {
  return (
    <section className="fleet-needs" aria-label={words.fleet.needsYou}>
      <h3>
        <span className="grow">{words.fleet.needsYou}</span>
        <span className="small muted">{words.fleet.newest}</span>
      </h3>
      {robots.length === 0 && <p className="small muted">{words.fleet.calm}</p>}
      <ul>
        {robots.map(robot => (
          <li key={keyOf(robot)}>
            <i className="fleet-dot" data-state={robot.state} aria-hidden />
            <span className="grow">
              <b>{robot.name}</b>{" "}
              <span className="small muted">
                {words.fleet.states[robot.state]}
                {robot.since_ms > 0 && ` · ${words.fleet.since(timeOf(robot.since_ms))}`}
              </span>
              {robot.news !== "" && <span className="fleet-news">{robot.news}</span>}
            </span>
            {robot.state === "no-link" ? (
              <button
                className="btn"
                aria-label={words.fleet.historyOf(robot.name)}
                onClick={() => void openHistory(robot)}
              >
                <History aria-hidden />
                {words.fleet.history}
              </button>
            ) : (
              <button className="btn" aria-label={words.fleet.twinOf(robot.name)} onClick={() => void openTwin(robot)}>
                <Box aria-hidden />
                {words.fleet.twin}
              </button>
            )}
          </li>
        ))}
      </ul>
    </section>
  );
}

function Choice<Value extends string>({
  label,
  value,
  options,
  onChange,
}: {
  readonly label: string;
  readonly value: Value;
  readonly options: readonly (readonly [Value, string])[];
  readonly onChange: (value: Value) => void;
}) {
  return (
    <span className="field fleet-choice">
      <select
        aria-label={label}
        value={value}
        onChange={event => {
          const found = options.find(([one]) => one === event.target.value);
          if (found) onChange(found[0]);
        }}
      >
        {options.map(([one, text]) => (
          <option key={one} value={one}>
            {text}
          </option>
        ))}
      </select>
    </span>
  );
}
