import {
  Cable,
  ChevronDown,
  ChevronRight,
  Eye,
  Ghost,
  Hand,
  Play,
  Plug,
  PlugZap,
  Plus,
  RotateCcw,
  Square,
  Trash2,
} from "lucide-react";
import { useState } from "react";
import { useStore } from "zustand";
import type { CommandOutcome } from "@twincell/core";
import {
  askStation,
  virtualPendantOf,
  holdStation,
  lookAhead,
  previewStation,
  pullPlug,
  removeStation,
  runAll,
  runStation,
  stopStation,
  watchStation,
} from "../../runtime/robot/stations.ts";
import { askBeforeSending } from "../../runtime/run/ask-before-run.ts";
import { Desk } from "../../virtual-pendant/Desk.tsx";
import { openDialog } from "../../stores/dialogs.ts";
import { notify } from "../../stores/notices.ts";
import { stationStore, type StationState } from "../../stores/stations.ts";
import { HoldButton } from "../../ui/HoldButton.tsx";
import { Slide } from "../../ui/Slide.tsx";
import { Tip } from "../../ui/Tip.tsx";
import { say, words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";
import { DirectControl } from "./DirectControl.tsx";
import { SynchronizedStart } from "./Together.tsx";
import "./stations.css";

/** The other controllers of the cell: each with its link, its guard, and what can be done with it now. */
export function Stations() {
  const stations = useStore(stationStore, state => state.stations);
  const ready = stations.filter(({ link, running, guard }) => link.state === "open" && !running && !guard.watching);
  return (
    <section aria-label={words.stations.title}>
      <h2 className="heading">
        <span className="grow">{words.stations.title}</span>
        <button className="btn quiet icon" aria-label={words.stations.add} onClick={() => openDialog("station")}>
          <Plus />
        </button>
      </h2>
      <div className="section stations">
        {stations.length === 0 && <p className="small muted">{words.stations.none}</p>}
        {stations.map(station => (
          <Card key={station.id} station={station} />
        ))}
        {stations.length > 1 && <SynchronizedStart stations={stations} />}
        {stations.length > 1 && (
          <button
            className="btn"
            disabled={ready.length === 0}
            onClick={() => {
              askBeforeSending(
                ready.map(({ id }) => id),
                despite => {
                  void runAll(despite);
                },
              );
            }}
          >
            <Play />
            {words.stations.runAll}
          </button>
        )}
        {stations.length === 0 && (
          <button className="btn" onClick={() => openDialog("station")}>
            <Plus />
            {words.stations.add}
          </button>
        )}
      </div>
    </section>
  );
}

function tell(name: string, outcome: CommandOutcome): void {
  if (outcome.kind !== "done")
    notify(outcome.kind === "stopped" ? "warn" : "bad", `${name}: ${outcome.why.sentence}`, outcome.why.hint);
}

function Card({ station }: { readonly station: StationState }) {
  const { id, name, link, guard, safety, running, virtual, unplugged } = station;
  const [wide, setWide] = useState(false);
  const open = link.state === "open";
  const ask = (what: Parameters<typeof askStation>[1]) => {
    void askStation(id, what).then(outcome => {
      tell(name, outcome);
    });
  };
  const says =
    open && safety !== "normal"
      ? words.control.safetyStates[safety]
      : [
          guard.watching ? words.stations.watchingShort : virtual ? words.stations.virtual : null,
          words.stations.links[link.state],
          open ? words.control.modes[station.mode] : null,
        ]
          .filter(Boolean)
          .join(" · ");
  return (
    <article
      className="station"
      aria-label={words.stations.card(name)}
      data-link={link.state}
      data-safety={open ? safety : "normal"}
      data-watching={guard.watching || undefined}
    >
      <header className="row-flex">
        <button
          className="btn quiet icon"
          aria-expanded={wide}
          aria-label={`${words.common.more}: ${name}`}
          onClick={() => setWide(!wide)}
        >
          {wide ? <ChevronDown /> : <ChevronRight />}
        </button>
        <span className="station-lamp" aria-hidden />
        <span className="grow station-name">
          <b>{name}</b>
          <span className="small muted" role="status">
            {says}
          </span>
        </span>
        <button
          className="btn quiet icon"
          aria-label={`${words.stations.remove}: ${name}`}
          onClick={() => {
            void removeStation(id);
          }}
        >
          <Trash2 />
        </button>
      </header>
      {guard.watching && (
        <p className="small station-watching">
          <Eye />
          {words.stations.watching}
        </p>
      )}
      <div className="station-buttons">
        {guard.watching ? (
          <>
            <button
              className="btn"
              disabled={!open}
              onClick={() => {
                void watchStation(id, false).then(outcome => {
                  tell(name, outcome);
                });
              }}
            >
              <Hand />
              {words.stations.take}
            </button>
            <button
              className="btn"
              disabled={!open}
              onClick={() => {
                stopStation(id);
              }}
            >
              <Square />
              {words.stations.stop}
            </button>
          </>
        ) : running ? (
          <button
            className="btn"
            onClick={() => {
              stopStation(id);
            }}
          >
            <Square />
            {words.stations.stop}
          </button>
        ) : (
          <button
            className="btn"
            disabled={!open || safety !== "normal" || guard.link !== "up"}
            onClick={() => {
              askBeforeSending([id], despite => {
                void runStation(id, despite).then(outcome => {
                  if (outcome.kind === "done") notify("done", words.stations.done(name));
                  else tell(name, outcome);
                });
              });
            }}
          >
            <Play />
            {words.stations.run}
          </button>
        )}
        {!running && open && (
          <Tip words={words.stations.previewTip}>
            <button
              className="btn"
              onClick={() => {
                void previewStation(id).then(outcome => {
                  if (outcome.kind === "done") notify("done", words.stations.previewFree(name));
                  else tell(name, outcome);
                });
              }}
            >
              <Ghost />
              {words.stations.preview}
            </button>
          </Tip>
        )}
        {guard.link === "unconfirmed" && open && !guard.watching && (
          <Tip words={words.stations.confirmTip}>
            <button
              className="btn primary"
              onClick={() => {
                ask("confirm");
              }}
            >
              {words.stations.confirm}
            </button>
          </Tip>
        )}
        {open && !guard.watching && (safety !== "normal" || guard.emergency) && (
          <button
            className="btn"
            onClick={() => {
              ask("reset");
            }}
          >
            <RotateCcw />
            {words.stations.reset}
          </button>
        )}
        {link.state === "closed" && (
          <button
            className="btn"
            onClick={() => {
              ask("connect");
            }}
          >
            <Cable />
            {words.stations.connect}
          </button>
        )}
        {!virtual && open && !guard.watching && (
          <Tip words={words.stations.holdTip}>
            <HoldButton
              className="btn"
              label={words.stations.hold}
              onHold={() => {
                holdStation(id, true);
              }}
              onRelease={() => {
                holdStation(id, false);
              }}
            >
              {words.stations.hold}
            </HoldButton>
          </Tip>
        )}
        {virtual && (
          <button
            className="btn"
            aria-pressed={unplugged}
            onClick={() => {
              void pullPlug(id, !unplugged);
            }}
          >
            {unplugged ? <PlugZap /> : <Plug />}
            {unplugged ? words.stations.plugIn : words.stations.pull}
          </button>
        )}
      </div>
      {station.foreseen !== "" && (
        <p className="small station-foreseen" role="alert">
          {station.foreseen}
        </p>
      )}
      {(station.notice || (!open && link.sentence)) && (
        <p className="small station-says">{say(station.notice || link.sentence)}</p>
      )}
      {wide && <Details station={station} />}
    </article>
  );
}

const degreesOf = (angle_rad: number | null): string =>
  angle_rad === null ? "–" : `${fixed((angle_rad * 180) / Math.PI, 3)}°`;

function Details({ station }: { readonly station: StationState }) {
  const { link } = station;
  return (
    <>
      {!station.guard.watching && <DirectControl station={station} />}
      <dl className="facts station-facts">
        <div>
          <dt>{words.control.latency}</dt>
          <dd>
            {words.stations.figures(fixed(link.rate_Hz, 0), words.stations.ms(link.late_s), link.missing)}
            {link.roundTrip_s !== null && ` · ${words.stations.trip(words.stations.ms(link.roundTrip_s))}`}
          </dd>
        </div>
        <div>
          <dt>{words.stations.plan}</dt>
          <dd>{degreesOf(station.plan_rad)}</dd>
        </div>
        <div>
          <dt>{words.stations.command}</dt>
          <dd>{degreesOf(station.command_rad)}</dd>
        </div>
        <div>
          <dt>{words.control.speed}</dt>
          <dd>{Math.round(station.override * 100)} %</dd>
        </div>
        {station.step && (
          <div>
            <dt>{words.stations.step}</dt>
            <dd>{station.step}</dd>
          </div>
        )}
        {station.message && (
          <div>
            <dt>{words.jog.message}</dt>
            <dd>{say(station.message)}</dd>
          </div>
        )}
        <div>
          <dt>{words.stations.watchdog}</dt>
          <dd>{station.watchdog}</dd>
        </div>
      </dl>
      <div className="station-ahead">
        <span className="small muted">{words.stations.ahead}</span>
        <Slide
          label={words.stations.ahead}
          value={station.ahead_s}
          min={0.5}
          max={10}
          step={0.5}
          says={words.stations.aheadSays(station.ahead_s)}
          onChange={seconds => {
            lookAhead(station.id, seconds);
          }}
        />
        <span className="num small">{words.stations.aheadSays(station.ahead_s)}</span>
      </div>
      {!station.guard.watching && (
        <Tip words={words.stations.watchTip}>
          <button
            className="btn tight"
            disabled={station.running || link.state !== "open"}
            onClick={() => {
              void watchStation(station.id, true).then(outcome => {
                tell(station.name, outcome);
              });
            }}
          >
            <Eye />
            {words.stations.watch}
          </button>
        </Tip>
      )}
      {station.virtual && <PendantPart station={station} />}
    </>
  );
}

/** Its pendant, as the page of its own has it. */
function PendantPart({ station: { id, place } }: { readonly station: StationState }) {
  const link = virtualPendantOf(id);
  if (!link) return null;
  return (
    <section className="station-pendant" aria-label={words.stations.pendant}>
      <h3 className="small dim row-flex">
        <span className="grow">{words.stations.pendant}</span>
        {place === "server" && (
          <a className="small" href={`pendant/?station=${encodeURIComponent(id)}`} target="_blank" rel="noreferrer">
            {words.stations.pendantAlone}
          </a>
        )}
      </h3>
      <Desk link={link} alone={false} />
    </section>
  );
}
