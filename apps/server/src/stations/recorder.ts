import { robotById, type JointSample, type Refusal, type Robot } from "@twincell/core";
import {
  auditNote,
  createClient,
  type Channel,
  type Client,
  type ConnectionInfo,
  type EventOf,
} from "@twincell/protocol";
import { latencyMeter, type Archive, type LatencyMeter } from "@twincell/recording";

export interface StationRecorderOptions {
  /** Where the stream of a station goes; null when it is not recorded. Closed with the station. */
  readonly archive: (station: ConnectionInfo, robot: Robot) => Archive | null;
  /** Seconds of the same clock for both ends of this recorder. */
  readonly now_s: () => number;
  /** Told once when recording stops and once when it goes on; `station` where it is about one of them. */
  readonly onTrouble?: (sentence: string, about?: { readonly station: string; readonly why: Refusal }) => void;
}
export interface StationRecorder {
  hear(text: string): void;
  /** Keeps what waits, asks for the time there and back; a few times a second. */
  tick(): Promise<void>;
  readonly recording: readonly string[];
  close(): void;
}

const GUARD_TELLS: ReadonlySet<string> = new Set([
  "takes the lease",
  "gives the lease back",
  "presses the enabling switch",
  "lets the enabling switch go",
]);

interface Recorded {
  readonly id: string;
  readonly name: string;
  readonly archive: Archive;
  signals: ReadonlyMap<string, boolean | number>;
  holder: string | null;
  pressed: boolean;
  trip: EventOf<"guard">["trip"];
  link: EventOf<"link">["state"] | "";
  /** That nothing is recorded has been said. */
  told: boolean;
  readonly late: LatencyMeter;
  readonly back: LatencyMeter;
}

/**
 * Records every station of a host, as one more who listens to it: samples with the controller's own time, the link with
 * its lateness, who commands, stops of the guard, refusals (rows T-54, T-61). It asks for nothing but the time.
 */
export function recordStations(channel: Channel, options: StationRecorderOptions): StationRecorder {
  const stations = new Map<string, Recorded>();
  const roundTrip = latencyMeter("host and back", "round-trip");
  let asking = false;

  function open(words: ConnectionInfo): void {
    if (stations.has(words.id)) return;
    const robot = robotById(words.robot);
    const archive = robot ? options.archive(words, robot) : null;
    if (!archive) return;
    stations.set(words.id, {
      id: words.id,
      name: words.name,
      archive,
      signals: new Map(),
      holder: null,
      pressed: false,
      trip: "none",
      link: "",
      told: false,
      late: latencyMeter("controller to host", "from-robot"),
      back: latencyMeter("controller and back", "round-trip"),
    });
    archive.event("station", `${words.name} is open.`);
  }
  function close(id: string): void {
    stations.get(id)?.archive.close();
    stations.delete(id);
  }
  function sample(to: Recorded, { q_rad, signals, ...said }: EventOf<"sample">): void {
    // Lines are told when they change.
    if (signals) to.signals = new Map(Object.entries(signals));
    const { sequence, time_s, moving, mode, safety, override, gripperClosed, step, message } = said;
    to.archive.record({
      sequence,
      time_s,
      q_rad: Float64Array.from(q_rad),
      moving,
      mode,
      safety,
      override,
      gripperClosed,
      step,
      message,
      signals: to.signals,
    } satisfies JointSample);
  }
  function guard(to: Recorded, { holder, pressed, trip }: EventOf<"guard">): void {
    if (holder !== to.holder)
      to.archive.note("operator", {
        who: holder ?? to.holder ?? "",
        action: holder === null ? "gives the lease back" : "takes the lease",
        detail: "",
      });
    if (pressed !== to.pressed)
      to.archive.note("operator", {
        who: holder ?? "",
        action: pressed ? "presses the enabling switch" : "lets the enabling switch go",
        detail: "",
      });
    if (trip !== to.trip)
      to.archive.note("alarm", {
        code: "guard.trip",
        active: trip !== "none",
        sentence:
          trip === "none"
            ? "The robot is back at its last safe pose."
            : "The guard stopped the robot on its way into contact.",
        hint: "",
      });
    Object.assign(to, { holder, pressed, trip });
  }
  function link(to: Recorded, { state, sentence, late_s, roundTrip_s }: EventOf<"link">): void {
    if (state !== to.link) {
      if (state === "lost" || to.link === "lost")
        to.archive.note("alarm", {
          code: "link.lost",
          active: state === "lost",
          sentence: state === "lost" ? sentence : "The link is open again.",
          hint: "",
        });
      else if (to.link !== "") to.archive.event("link", sentence || `The link is ${state}.`);
      to.link = state;
    }
    if (state !== "open") return;
    to.late.add(1000 * late_s);
    if (roundTrip_s !== null) to.back.add(1000 * roundTrip_s);
  }

  function group(message: EventOf<"began"> | EventOf<"ended">): void {
    if (message.type === "began")
      for (const id of message.stations)
        stations
          .get(id)
          ?.archive.event(
            "group.began",
            `${message.stations.length} robots began together, within ${Math.round(1000 * message.spread_s)} ms.`,
          );
    else
      for (const { station, outcome } of message.stations)
        stations
          .get(station)
          ?.archive.event(
            "group.ended",
            outcome.kind === "done" ? "The common run is done." : outcome.why.sentence,
            outcome.kind === "done" ? "info" : "warning",
          );
  }

  /** What somebody asked for, and what became of it (rows T-54, X-43). */
  function act(to: Recorded, message: EventOf<"act">): void {
    const said = auditNote(message);
    if (said?.kind === "command") to.archive.note("command", said.note);
    // Lease and switch are told by the guard, however that came about.
    else if (said && !GUARD_TELLS.has(said.note.action)) to.archive.note("operator", said.note);
  }

  const client: Client = createClient(channel, options.now_s, message => {
    if (message.type === "hello") {
      for (const words of message.stations) open(words);
      return;
    }
    if (message.type === "opened") {
      const { id, name, brand, robot, virtual, watchdog } = message;
      open({ id, name, brand, robot, virtual, watchdog });
      return;
    }
    if (message.type === "closed") {
      close(message.station);
      return;
    }
    if (message.type === "fault") {
      options.onTrouble?.(message.sentence);
      return;
    }
    // Where it will be is no record of where it was.
    if (message.type === "ahead") return;
    if (message.type === "began" || message.type === "ended") {
      group(message);
      return;
    }
    const to = stations.get(message.station);
    if (!to) return;
    switch (message.type) {
      case "sample":
        sample(to, message);
        break;
      case "guard":
        guard(to, message);
        break;
      case "link":
        link(to, message);
        break;
      case "act":
        act(to, message);
        break;
      case "notice":
        to.archive.event(message.why.code, message.why.sentence, "warning");
        break;
    }
    tellProblem(to);
  });

  function tellProblem(to: Recorded): void {
    const { problem } = to.archive;
    if ((problem !== null) === to.told) return;
    to.told = problem !== null;
    const why: Refusal = problem
      ? { ...problem, sentence: `${to.name}: ${problem.sentence}`, hint: "Make room: recording goes on by itself." }
      : {
          code: "recording.goes-on",
          sentence: `${to.name} is recorded again.`,
          hint: "What it did meanwhile is not kept.",
        };
    options.onTrouble?.(why.sentence, { station: to.id, why });
  }

  return {
    hear: client.hear,
    get recording() {
      return [...stations.keys()];
    },
    async tick() {
      if (!asking && stations.size > 0) {
        asking = true;
        void client.ping().then(seconds => {
          asking = false;
          if (!Number.isNaN(seconds)) roundTrip.add(seconds * 1000);
        });
      }
      const now_s = options.now_s();
      const host = roundTrip.due(now_s);
      for (const to of stations.values()) {
        const { archive, late, back } = to;
        for (const said of [host, late.due(now_s), back.due(now_s)]) if (said) archive.note("latency", said);
        await archive.tick();
        tellProblem(to);
      }
    },
    close() {
      client.gone();
      for (const id of [...stations.keys()]) close(id);
    },
  };
}
