import { parseProgram, type CommandOutcome, type Refusal, type Scheduler } from "@twincell/core";
import { auditEntryState, type AuditEntry } from "./acts.ts";
import type { ConnectionRequest, RequestOf } from "./ask.ts";
import { subscribeToPendant, type PendantSubscription } from "./pendant.ts";
import type { Channel } from "./channel.ts";
import { createProductions } from "./productions.ts";
import type { OpenedConnection, ServedCommander, ServedConnection, ServedGroup, ServedMember } from "./served.ts";
import { requestOrEnd, PROTOCOL, write } from "./read.ts";
import type { ConnectionEvent, EventOf } from "./tell.ts";

/** What an app brings to its host. */
export interface RobotServerOptions {
  readonly scheduler: Scheduler;
  readonly version: string;
  readonly brands: EventOf<"hello">["brands"];
  open(ask: RequestOf<"open">): Promise<OpenedConnection>;
  /** Starts several at once, all or none. */
  together(
    members: readonly ServedMember[],
    onStarted: (words: { readonly spread_s: number }) => void,
  ): Promise<ServedGroup>;
}
export interface RobotServer {
  /** Somebody new; what comes from them goes into `hear`. Leaving gives back every lease they hold. */
  join(who: string, channel: Channel): { hear(text: string): void; leave(): void };
  readonly stations: readonly ServedConnection[];
  /** Tells everybody something about a station that is not its own word: that it is not recorded, for instance. */
  notice(station: string, why: Refusal): void;
  close(): void;
}

const DONE: CommandOutcome = { kind: "done" };
const MOST_STATIONS = 32;
/** Link figures are told this often, and at every change of state [s]. */
const FIGURES_S = 0.5;
const refuse = (code: string, sentence: string, hint: string): CommandOutcome => ({
  kind: "refused",
  why: { code, sentence, hint },
});
/** What a message says of an outcome. Refusals of planners and drivers know more, which no client would understand. */
function written(outcome: CommandOutcome): CommandOutcome {
  if (outcome.kind === "done") return outcome;
  const { code, sentence, hint, joint, value, limit } = outcome.why;
  return {
    kind: outcome.kind,
    why: {
      code,
      sentence,
      hint,
      ...(joint === undefined ? {} : { joint }),
      ...(value === undefined ? {} : { value }),
      ...(limit === undefined ? {} : { limit }),
    },
  };
}
const known = (value: number): number | null => (Number.isFinite(value) ? value : null);

const noStation = (id: string): CommandOutcome =>
  refuse("station.none", `There is no station “${id}”.`, "Open it first.");
const unreadable = (why = "it is empty"): CommandOutcome =>
  refuse("station.program", `The program cannot be read: ${why}`, "Export it again.");
const noPendant = ({ words }: ServedConnection): CommandOutcome =>
  refuse("station.no-pendant", `${words.name} is a real controller: its pendant is at the robot.`, "Go there.");

/**
 * Stations that any number of people look at, and each of which one commands. The same in a worker of the page and on a
 * server.
 */
export function createRobotServer(options: RobotServerOptions): RobotServer {
  const stations = new Map<string, { readonly station: ServedConnection; readonly forget: () => void }>();
  const channels = new Set<Channel>();
  const closing = new Set<(station: ServedConnection) => void>();
  let people = 0;
  let acts = 0;
  const all = (message: ConnectionEvent): void => {
    const text = write(message);
    for (const channel of channels) channel.send(text);
  };
  const productions = createProductions(all);
  const linkWords = (station: ServedConnection): EventOf<"link"> | null => {
    const { link } = station;
    return (
      link && {
        type: "link",
        station: station.words.id,
        state: link.state,
        sentence: link.sentence,
        attempts: link.attempts,
        rate_Hz: link.rate_Hz,
        late_s: link.late_s,
        roundTrip_s: known(link.roundTrip_s),
        missing: link.missing,
      }
    );
  };
  const guardWords = (station: ServedConnection): EventOf<"guard"> => ({
    type: "guard",
    station: station.words.id,
    ...station.guard.state,
    ...station.kept,
  });
  const tellLink = (station: ServedConnection): void => {
    const says = linkWords(station);
    if (says) all(says);
  };

  /**
   * Everything that people do at a station is told to all who look at it, the recorders among them: who, what, and what
   * became of it.
   */
  function tellAct(who: string, act: AuditEntry, station: string): (outcome: CommandOutcome) => void {
    const { target, ...words } = auditEntryState(act);
    const said = { type: "act" as const, station, number: acts++, who, ...words, target: [...target] };
    all({ ...said, outcome: null });
    return outcome => {
      all({ ...said, outcome: written(outcome) });
    };
  }

  function watch(station: ServedConnection): () => void {
    const { id } = station.words;
    let signals: ReadonlyMap<string, boolean | number> | undefined;
    let said = "";
    const offs = [
      station.onSample(sample => {
        // Lines are told when they change: most samples only move.
        const lines = sample.signals === undefined ? "" : JSON.stringify([...sample.signals]);
        if (lines !== said) {
          said = lines;
          signals = sample.signals;
        } else signals = undefined;
        all({
          type: "sample",
          station: id,
          sequence: sample.sequence,
          time_s: sample.time_s,
          sent_s: options.scheduler.now_s(),
          q_rad: Array.from(sample.q_rad),
          moving: sample.moving,
          mode: sample.mode,
          safety: sample.safety,
          override: sample.override,
          gripperClosed: sample.gripperClosed,
          step: sample.step,
          message: sample.message,
          plan_rad: known(station.deviation.plan_rad),
          command_rad: known(station.deviation.command_rad),
          ...(signals ? { signals: Object.fromEntries(signals) } : {}),
        });
      }),
      station.ahead.onChange(words => {
        all({
          type: "ahead",
          station: id,
          ahead: words && { q_rad: Array.from(words.q_rad), in_s: words.in_s, problem: words.problem },
        });
      }),
      station.onLink(() => {
        tellLink(station);
      }),
      station.onGuard(() => {
        all(guardWords(station));
      }),
      station.onNotice(why => {
        all({ type: "notice", station: id, why });
      }),
      options.scheduler.every(FIGURES_S, () => {
        tellLink(station);
      }),
    ];
    return () => {
      for (const off of offs) off();
    };
  }

  function setCell(station: ServedConnection, cell: unknown): CommandOutcome {
    const outcome = station.setCell(cell);
    if (outcome.kind === "done") all(guardWords(station));
    return outcome;
  }

  async function open(ask: RequestOf<"open">): Promise<CommandOutcome> {
    if (stations.has(ask.station))
      return refuse(
        "station.exists",
        `There is a station “${ask.station}” already.`,
        "Close it first, or give the new one another name.",
      );
    if (stations.size >= MOST_STATIONS)
      return refuse("station.too-many", `${MOST_STATIONS} stations are open, which is the most.`, "Close one first.");
    const opened = await options.open(ask);
    if (opened.kind === "refused") return opened;
    // Somebody may have been faster while this one was being opened.
    if (stations.has(ask.station)) {
      opened.station.close();
      return refuse("station.exists", `There is a station “${ask.station}” already.`, "Give the new one another name.");
    }
    stations.set(ask.station, { station: opened.station, forget: watch(opened.station) });
    all({ type: "opened", ...opened.station.words });
    all(guardWords(opened.station));
    return DONE;
  }
  function close(id: string): void {
    const entry = stations.get(id);
    if (!entry) return;
    stations.delete(id);
    entry.forget();
    productions.stopped(entry.station);
    for (const forget of closing) forget(entry.station);
    entry.station.close();
    all({ type: "closed", station: id });
  }

  return {
    notice(station, { code, sentence, hint }) {
      all({ type: "notice", station, why: { code, sentence, hint } });
    },
    get stations() {
      return [...stations.values()].map(({ station }) => station);
    },
    join(who, channel) {
      const commanders = new Map<ServedConnection, ServedCommander>();
      const visits = new Map<ServedConnection, PendantSubscription>();
      const me = `${who} ${++people}`;
      let gone = false;
      const tell = (message: ConnectionEvent): void => {
        if (!gone) channel.send(write(message));
      };
      const seatAt = (station: ServedConnection): ServedCommander => {
        let seat = commanders.get(station);
        if (!seat) commanders.set(station, (seat = station.commander(who)));
        return seat;
      };
      const visitTo = (station: ServedConnection): PendantSubscription | null => {
        let visit = visits.get(station);
        if (!visit && station.pendant)
          visits.set(
            station,
            (visit = subscribeToPendant(me, station.words.id, station.pendant, options.scheduler, tell)),
          );
        return visit ?? null;
      };

      async function carryOut(
        ask: Exclude<ConnectionRequest, RequestOf<"stop" | "alive" | "ping">>,
      ): Promise<CommandOutcome> {
        if (ask.type === "open") return open(ask);
        if (ask.type === "together") return together(ask);
        if (ask.type === "visit" || ask.type === "look-ahead" || ask.type === "preview" || ask.type === "takes")
          return looked(ask);
        const station = stations.get(ask.station)?.station;
        if (!station) return noStation(ask.station);
        const told = tellAct(who, ask, ask.station);
        // Whoever records it is told before it is gone.
        if (ask.type === "close") told(DONE);
        const outcome = await command(station, ask);
        if (stations.get(ask.station)?.station === station) told(outcome);
        return outcome;
      }
      /** What only looks: nothing of it reaches the robot, and nobody is told. */
      async function looked(
        ask: RequestOf<"visit"> | RequestOf<"look-ahead"> | RequestOf<"preview"> | RequestOf<"takes">,
      ): Promise<CommandOutcome> {
        const station = stations.get(ask.station)?.station;
        if (!station) return noStation(ask.station);
        switch (ask.type) {
          case "visit":
            return visitTo(station)?.watch(ask.on) ?? noPendant(station);
          case "look-ahead":
            station.ahead.horizon_s = ask.seconds;
            return DONE;
          case "preview":
          case "takes": {
            const parsed = parseProgram(ask.program);
            if (parsed.kind !== "program") return unreadable(parsed.faults[0]?.sentence);
            return ask.type === "preview" ? station.preview(parsed.program) : station.takes(parsed.program);
          }
        }
      }
      async function command(
        station: ServedConnection,
        ask: Exclude<AuditEntry, { readonly type: "stop" | "together" }>,
      ): Promise<CommandOutcome> {
        const seat = seatAt(station);
        switch (ask.type) {
          case "close":
            close(ask.station);
            return DONE;
          case "connect":
            return station.connect();
          case "disconnect":
            station.disconnect();
            return DONE;
          case "take":
            return seat.acquireLease();
          case "release":
            return seat.releaseLease();
          case "confirm":
            return seat.acknowledge();
          case "cell":
            return othersLease(station) ?? setCell(station, ask.cell);
          case "reset":
            return seat.robot.reset();
          case "watch":
            return station.watch(seat, ask.on);
          case "hold":
            return seat.setEnabled(ask.pressed);
          case "speed":
            return seat.robot.setSpeed(ask.percent);
          case "move":
            return seat.robot.moveJoints(ask.q_rad);
          case "zero":
            return seat.robot.moveToZero();
          case "run": {
            const parsed = parseProgram(ask.program);
            if (parsed.kind !== "program") return unreadable(parsed.faults[0]?.sentence);
            return station.run(seat, parsed.program, ask.asText, ask.despite);
          }
          case "produce":
          case "replace":
          case "intervene":
          case "resume":
          case "single-step":
          case "breakpoints":
            return productions.carryOut(who, station, seat, ask);
          case "pendant":
            return visitTo(station)?.act(ask.act) ?? noPendant(station);
          case "plug":
            if (!station.plug)
              return refuse(
                "station.no-plug",
                `${station.words.name} is a real controller: its plug is in the wall.`,
                "Disconnect it instead.",
              );
            station.plug(ask.pulled);
            return DONE;
        }
      }

      /**
       * Why somebody who has not the lease may not do what concerns a robot that somebody else commands; null when
       * nobody does.
       */
      function othersLease({ guard, words }: ServedConnection): CommandOutcome | null {
        const { holder } = guard.state;
        if (holder === null || holder === who) return null;
        return refuse(
          "guard.lease-taken",
          `${words.name} is commanded by ${holder}.`,
          "Wait until the lease is given back. Anyone may stop the robot.",
        );
      }

      async function together({ members }: RequestOf<"together">): Promise<CommandOutcome> {
        const ids = members.map(({ station }) => station);
        const ready: ServedMember[] = [];
        if (new Set(ids).size < ids.length)
          return refuse("group.twice", "A station is named twice in the group.", "Name each once.");
        for (const { station: id, program, asText, despite } of members) {
          const station = stations.get(id)?.station;
          const parsed = parseProgram(program);
          if (!station) return noStation(id);
          if (parsed.kind !== "program")
            return refuse(
              "station.program",
              `The program of ${station.words.name} cannot be read: ${parsed.faults[0]?.sentence ?? "it is empty"}`,
              "Export it again.",
            );
          const seat = seatAt(station);
          ready.push({ station, prepare: () => station.prepare(seat, parsed.program, asText, despite) });
        }
        const told = members.map(({ station, program, asText, despite }) =>
          tellAct(
            who,
            { type: "together", program, asText, ...(despite ? { despite } : {}), members: members.length },
            station,
          ),
        );
        const { outcome, each } = await options.together(ready, ({ spread_s }) => {
          all({ type: "began", stations: ids, spread_s });
        });
        for (const tellEnd of told) tellEnd(outcome);
        if (each.size > 0)
          all({ type: "ended", stations: [...each].map(([station, ended]) => ({ station, outcome: written(ended) })) });
        return outcome;
      }

      /** A station that is closed has no pendant any more that could be told of. */
      const forget = (station: ServedConnection): void => {
        visits.get(station)?.leave();
        visits.delete(station);
        commanders.delete(station);
      };
      channels.add(channel);
      closing.add(forget);
      tell({
        type: "hello",
        protocol: PROTOCOL,
        version: options.version,
        brands: options.brands,
        stations: [...stations.values()].map(({ station }) => station.words),
      });
      for (const { station } of stations.values()) {
        tell(guardWords(station));
        const link = linkWords(station);
        if (link) tell(link);
        const production = productions.stateOf(station);
        if (production) tell(production);
      }
      const leave = (): void => {
        if (gone) return;
        gone = true;
        channels.delete(channel);
        closing.delete(forget);
        for (const seat of commanders.values()) seat.releaseLease();
        for (const visit of visits.values()) visit.leave();
      };
      return {
        leave,
        hear(text) {
          if (gone) return;
          const ask = requestOrEnd(text, tell, () => {
            leave();
            channel.close();
          });
          if (!ask) return;
          switch (ask.type) {
            case "ping":
              tell({ type: "pong", sent_s: ask.sent_s, host_s: options.scheduler.now_s() });
              break;
            case "alive": {
              const entry = stations.get(ask.station);
              if (entry) {
                seatAt(entry.station).alive();
                visits.get(entry.station)?.alive();
              }
              break;
            }
            // The stops go out first; what is told of them comes after.
            case "stop": {
              const meant = [...stations].filter(([id]) => ask.station === undefined || ask.station === id);
              for (const [, { station }] of meant) station.stop(ask.emergency);
              for (const [, { station }] of meant) productions.stopped(station);
              for (const [id] of meant) tellAct(who, ask, id)(DONE);
              break;
            }
            default: {
              const { id } = ask;
              void carryOut(ask).then(outcome => {
                tell({ type: "answer", id, outcome: written(outcome) });
              });
            }
          }
        },
      };
    },
    close() {
      for (const id of [...stations.keys()]) close(id);
      channels.clear();
    },
  };
}
