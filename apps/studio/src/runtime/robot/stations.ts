import {
  addOwnRobot,
  retargetProgram,
  robotById,
  robotOfFile,
  type CommandOutcome,
  type JointSample,
  type Pose,
  type Program,
  type Robot,
} from "@twincell/core";
import type { EventOf } from "@twincell/protocol";
import type { CellDocument } from "@twincell/project";
import { createVirtualPendantLink, type VirtualPendantLink } from "../../virtual-pendant/link.ts";
import { cellStore } from "../../stores/cell.ts";
import { connectionStore } from "../../stores/connection.ts";
import { programOf, robotOf } from "../../stores/document.ts";
import { notify } from "../../stores/notices.ts";
import {
  changeStation,
  stationOf,
  stationStore,
  type ServerAddress,
  type StationState,
} from "../../stores/stations.ts";
import { shortName } from "../../stores/robot.ts";
import { onStop } from "../../stores/stop.ts";
import { words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";
import { noteOther } from "./drawn-robots.ts";
import { hostAt, onServers, type Told } from "./station-hosts.ts";
import { beginRecording, endRecording, recordAct, recordingOf } from "./station-recordings.ts";

/** The fast state of a station: written in place, read by the frame loop. */
export interface StationLive {
  readonly robot: Robot;
  readonly q_rad: Float64Array;
  revision: number;
  /** When the last sample was written here, and the host's clock when it handed it on [s]. */
  received_s: number;
  sent_s: number;
  /** Where it will be, as its host tells. */
  readonly ahead: { readonly q_rad: Float64Array; revision: number };
}
const newLive = (robot: Robot): StationLive => ({
  robot,
  q_rad: Float64Array.from(robot.home_rad),
  revision: 0,
  received_s: 0,
  sent_s: 0,
  ahead: { q_rad: Float64Array.from(robot.home_rad), revision: 0 },
});
const cabinets = new Map<string, VirtualPendantLink>();
const lives = new Map<string, StationLive>();
const told_ms = new Map<string, number>();
const alive = new Map<string, number>();
const TELL_EVERY_MS = 100;
const ALIVE_EVERY_MS = 25;
const NO_LINK: StationState["link"] = {
  state: "closed",
  sentence: "",
  attempts: 0,
  rate_Hz: 0,
  late_s: 0,
  roundTrip_s: null,
  missing: 0,
};
const AT_REST: StationState["guard"] = {
  holder: null,
  pressed: false,
  link: "up",
  motion: "at-rest",
  trip: "none",
  emergency: false,
  watching: false,
};

let listenToSample: (id: string, q_rad: Float64Array) => void = () => undefined;
/** Told of every sample, with the angles in the array that is written in place. */
export function onStationSample(listen: (id: string, q_rad: Float64Array) => void): void {
  listenToSample = listen;
}

export const stationLive = (id: string): StationLive | undefined => lives.get(id);

export interface NewStation {
  readonly brand: string;
  readonly robot: string;
  readonly place: ServerAddress;
  readonly stand: Pose<"world", "base">;
  readonly address?: {
    readonly host: string;
    readonly ports?: Readonly<Record<string, number>>;
    readonly data?: Readonly<Record<string, readonly number[]>>;
  };
  /** Only to watch what others do with it. */
  readonly watch?: boolean;
  /** It is the connection of the robot of the cell, and no robot of its own. */
  readonly ofCell?: boolean;
}

const refusedAs = (sentence: string, hint: string): CommandOutcome => ({
  kind: "refused",
  why: { code: "station.none", sentence, hint },
});
const hostOf = (id: string) => {
  const place = stationOf(id)?.place;
  return place && hostAt(place);
};

/**
 * Opens and connects a station, and takes its lease. Programs of the cell are carried out as if its robot stood where
 * the cell's stands.
 */
export async function addStation({
  brand,
  robot: robotId,
  place,
  stand,
  address,
  watch = false,
  ofCell = false,
}: NewStation): Promise<CommandOutcome> {
  const host = hostAt(place);
  const robot = robotById(robotId);
  const { document } = cellStore.getState();
  if (!host || !robot || !document) return refusedAs(words.stations.noServer, words.stations.noServerHint);
  const taken = new Set(stationStore.getState().stations.map(({ id }) => id));
  let id = robotId;
  for (let n = 2; taken.has(id); n++) id = `${robotId} ${n}`;
  lives.set(id, newLive(robot));
  stands.set(id, stand);
  // Before anything is heard of it: it is never drawn as a second arm.
  if (ofCell) connectionStore.setState({ station: id, view: "live", enabled: false });
  const opened = await host.ask({
    type: "open",
    station: id,
    brand,
    robot: robotId,
    worldFromBase: document.robot.worldFromBase,
    stand,
    cell: document,
    ...(watch ? { watch } : {}),
    ...(address
      ? {
          address: {
            host: address.host,
            ...(address.ports ? { ports: { ...address.ports } } : {}),
            ...(address.data
              ? {
                  data: Object.fromEntries(Object.entries(address.data).map(([name, numbers]) => [name, [...numbers]])),
                }
              : {}),
          },
        }
      : {}),
  });
  if (opened.kind !== "done") {
    lives.delete(id);
    leaveCell(id);
    return opened;
  }
  if (watch) return host.ask({ type: "connect", station: id });
  const took = await host.ask({ type: "take", station: id });
  return took.kind === "done" ? host.ask({ type: "connect", station: id }) : took;
}
const leaveCell = (id: string): void => {
  if (connectionStore.getState().station === id)
    connectionStore.setState({ station: null, view: "live", enabled: false });
};
const stands = new Map<string, Pose<"world", "base">>();

export async function removeStation(id: string): Promise<void> {
  await hostOf(id)?.ask({ type: "close", station: id });
}
export const askStation = (
  id: string,
  type: "connect" | "disconnect" | "confirm" | "reset" | "take" | "release" | "zero",
): Promise<CommandOutcome> =>
  hostOf(id)?.ask({ type, station: id }) ?? Promise.resolve(refusedAs(words.stations.gone, ""));
/** The pendant of a virtual controller, kept as long as the controller is there. */
export function virtualPendantOf(id: string): VirtualPendantLink | null {
  const host = hostOf(id);
  const known = cabinets.get(id);
  if (known || !host) return known ?? null;
  const link = createVirtualPendantLink(id, host);
  cabinets.set(id, link);
  return link;
}
/** Only to watch it from now on; or to command it, with its lease. */
export async function watchStation(id: string, on: boolean): Promise<CommandOutcome> {
  const host = hostOf(id);
  if (!host) return refusedAs(words.stations.gone, "");
  const turned = await host.ask({ type: "watch", station: id, on });
  return turned.kind === "done" && !on ? host.ask({ type: "take", station: id }) : turned;
}
/** How far ahead its host looks, and the ghost runs [s]. */
export function lookAhead(id: string, seconds: number): void {
  changeStation(id, { ahead_s: seconds });
  void hostOf(id)?.ask({ type: "look-ahead", station: id, seconds });
}
/** The ghost goes through the present program; nothing is sent to the robot. */
export async function previewStation(id: string): Promise<CommandOutcome> {
  const wanted = programFor(id);
  const host = hostOf(id);
  const live = lives.get(id);
  if (!wanted || !host || !live) return refusedAs(words.stations.gone, "");
  if (wanted.program.steps.length === 0) return refusedAs(words.run.nothing, "");
  if (wanted.unreached.length > 0)
    return refusedAs(words.stations.unreached(live.robot.name, wanted.unreached.length), words.stations.unreachedHint);
  return host.ask({ type: "preview", station: id, program: wanted.program });
}
export function stopStation(id: string, emergency = false): void {
  hostOf(id)?.stop(id, emergency);
}
export async function pullPlug(id: string, pulled: boolean): Promise<void> {
  const outcome = await hostOf(id)?.ask({ type: "plug", station: id, pulled });
  if (outcome?.kind === "done") changeStation(id, { unplugged: pulled });
}
/** The enabling switch of a real robot. */
export function holdStation(id: string, pressed: boolean): void {
  void hostOf(id)?.ask({ type: "hold", station: id, pressed });
}

/** The present program as that station's robot can do it. */
export function programFor(id: string): { readonly program: Program; readonly unreached: readonly string[] } | null {
  const { document } = cellStore.getState();
  const program = programOf(document);
  const from = robotOf(document);
  const to = lives.get(id)?.robot;
  if (!document || !program || !from || !to) return null;
  if (from.id === to.id) return { program, unreached: [] };
  const { program: moved, unreached } = retargetProgram(program, from, to, document.robot.worldFromBase);
  return { program: { ...moved, robot: to.id }, unreached };
}

/**
 * Runs the present program there as text of its own language, recorded from beginning to end.
 *
 * @param despite  codes of red findings that the person has seen; its connection refuses the program for any other.
 */
export async function runStation(id: string, despite: readonly string[] = []): Promise<CommandOutcome> {
  const wanted = programFor(id);
  const host = hostOf(id);
  const station = stationOf(id);
  const live = lives.get(id);
  if (!wanted || !host || !station || !live) return refusedAs(words.stations.gone, "");
  if (wanted.program.steps.length === 0) return refusedAs(words.run.nothing, "");
  if (wanted.unreached.length > 0)
    return refusedAs(words.stations.unreached(live.robot.name, wanted.unreached.length), words.stations.unreachedHint);
  changeStation(id, { running: true, notice: "" });
  const recording = beginRecording(station, live.robot, wanted.program.name);
  const outcome = await host.ask({
    type: "run",
    station: id,
    program: wanted.program,
    asText: true,
    despite: [...despite],
  });
  await endRecording(id, recording, outcome);
  changeStation(id, { running: false, notice: outcome.kind === "done" ? "" : outcome.why.sentence });
  return outcome;
}

/** All that are at rest begin in the same turn. */
export async function runAll(despite: readonly string[] = []): Promise<void> {
  const ready = stationStore
    .getState()
    .stations.filter(({ running, link, guard }) => !running && link.state === "open" && !guard.watching);
  const outcomes = await Promise.all(
    ready.map(async station => ({ station, outcome: await runStation(station.id, despite) })),
  );
  for (const { station, outcome } of outcomes)
    if (outcome.kind !== "done")
      notify(outcome.kind === "stopped" ? "warn" : "bad", `${station.name}: ${outcome.why.sentence}`, outcome.why.hint);
}

/** How each of a group ended, as its host said just before it answered. */
const groupEnds = new Map<string, CommandOutcome>();

/**
 * All or none: every one is made ready first, then all begin on the clock of their host, and whoever is stopped stops
 * all.
 */
export async function startSynchronized(
  ids: readonly string[],
  despite: readonly string[] = [],
): Promise<CommandOutcome> {
  const group: { readonly station: StationState; readonly live: StationLive; readonly program: Program }[] = [];
  for (const id of ids) {
    const wanted = programFor(id);
    const station = stationOf(id);
    const live = lives.get(id);
    if (!wanted || !station || !live) return refusedAs(words.stations.gone, "");
    if (wanted.program.steps.length === 0) return refusedAs(words.run.nothing, "");
    if (wanted.unreached.length > 0)
      return refusedAs(
        words.stations.unreached(live.robot.name, wanted.unreached.length),
        words.stations.unreachedHint,
      );
    group.push({ station, live, program: wanted.program });
  }
  const [first] = group;
  const host = first && hostAt(first.station.place);
  if (!host) return refusedAs(words.stations.gone, "");
  if (group.some(({ station }) => station.place !== first.station.place))
    return refusedAs(words.stations.twoClocks, words.stations.twoClocksHint);
  const running = group.map(({ station, live, program }) => {
    changeStation(station.id, { running: true, notice: "" });
    return { id: station.id, recording: beginRecording(station, live.robot, program.name) };
  });
  for (const id of ids) groupEnds.delete(id);
  const outcome = await host.ask({
    type: "together",
    members: group.map(({ station, program }) => ({
      station: station.id,
      program,
      asText: true,
      despite: [...despite],
    })),
  });
  for (const { id, recording } of running) {
    const own = groupEnds.get(id) ?? outcome;
    await endRecording(id, recording, own);
    changeStation(id, { running: false, notice: own.kind === "done" ? "" : own.why.sentence });
  }
  return outcome;
}

/** Commands wait on nothing, but who holds the lease of a real robot says so many times a second. */
function keepAlive(id: string): void {
  if (alive.has(id)) return;
  alive.set(
    id,
    window.setInterval(() => {
      hostOf(id)?.alive(id);
    }, ALIVE_EVERY_MS),
  );
}

function take(place: ServerAddress, message: Told): void {
  switch (message.type) {
    case "hello":
      if (message.brands.length > 0) stationStore.setState({ brands: message.brands });
      for (const station of message.stations) appear(place, station);
      break;
    case "opened":
      appear(place, message);
      break;
    case "closed":
      vanish(message.station);
      break;
    case "link":
      if (message.state !== stationOf(message.station)?.link.state || due(`${message.station} link`))
        changeStation(message.station, { link: message });
      break;
    case "guard":
      changeStation(message.station, { guard: message });
      break;
    case "notice":
      changeStation(message.station, { notice: message.why.sentence });
      recordingOf(message.station)?.event(message.why.code, message.why.sentence, "warning");
      break;
    case "began":
      notify("info", words.stations.began(message.stations.length, Math.round(1000 * message.spread_s)));
      for (const id of message.stations)
        recordingOf(id)?.event(
          "group.began",
          words.stations.began(message.stations.length, Math.round(1000 * message.spread_s)),
        );
      break;
    case "ended":
      for (const { station, outcome } of message.stations) groupEnds.set(station, outcome);
      break;
    case "act":
      recordAct(message);
      break;
    case "production":
      changeStation(message.station, { production: message.state === "ended" ? null : message });
      break;
    case "ahead":
      foresee(message);
      break;
    case "sample":
      show(message);
      break;
    case "pendant":
      cabinets.get(message.station)?.take(message);
      if (message.shown.trouble.unplugged !== stationOf(message.station)?.unplugged)
        changeStation(message.station, { unplugged: message.shown.trouble.unplugged });
      break;
    case "fault":
      notify("bad", message.sentence, words.stations.faultHint);
      for (const { id, place: at } of stationStore.getState().stations) if (at === place) vanish(id);
      break;
  }
}

/** A robot that is in no library, as the server tells of it to those who did not bring it. */
function robotOfOther(file: unknown): Robot | undefined {
  const answer = file === undefined ? undefined : robotOfFile(file);
  if (answer?.kind !== "robot") return undefined;
  addOwnRobot(answer.robot);
  return answer.robot;
}

function appear(
  place: ServerAddress,
  { id, name, brand, robot: robotId, virtual, watchdog, robotFile }: Omit<EventOf<"opened">, "type">,
): void {
  const robot = robotById(robotId) ?? robotOfOther(robotFile);
  const { document } = cellStore.getState();
  if (!robot || stationOf(id)) return;
  if (!lives.has(id)) lives.set(id, newLive(robot));
  const stand = stands.get(id) ?? document!.robot.worldFromBase;
  const station: StationState = {
    id,
    // A name that somebody gave stays; the one that virtual controllers have by themselves is long.
    name: virtual && name === `Virtual ${robot.name}` ? shortName(robot) : name,
    brand,
    robot: robotId,
    virtual,
    watchdog,
    place,
    stand,
    link: NO_LINK,
    guard: AT_REST,
    mode: "automatic",
    safety: "normal",
    moving: false,
    override: 1,
    step: "",
    message: "",
    plan_rad: null,
    command_rad: null,
    running: false,
    production: null,
    unplugged: false,
    notice: "",
    ghost: "none",
    foreseen: "",
    ahead_s: 2,
  };
  stationStore.setState(({ stations }) => ({ stations: [...stations, station] }));
  keepAlive(id);
}
function vanish(id: string): void {
  clearInterval(alive.get(id));
  alive.delete(id);
  lives.delete(id);
  leaveCell(id);
  stands.delete(id);
  cabinets.get(id)?.gone();
  cabinets.delete(id);
  stationStore.setState(({ stations }) => ({ stations: stations.filter(station => station.id !== id) }));
}

const due = (what: string): boolean => {
  const now_ms = performance.now();
  if (now_ms - (told_ms.get(what) ?? -Infinity) < TELL_EVERY_MS) return false;
  told_ms.set(what, now_ms);
  return true;
};

/** Angles go to the frame loop at once; words as slowly as people read. */
function foresee({ station: id, ahead }: EventOf<"ahead">): void {
  const live = lives.get(id);
  const known = stationOf(id);
  if (!live || !known) return;
  if (ahead && ahead.q_rad.length === live.ahead.q_rad.length) {
    live.ahead.q_rad.set(ahead.q_rad);
    live.ahead.revision++;
    noteOther();
  }
  const ghost = !ahead ? "none" : ahead.problem ? "blocked" : "free";
  if (ghost === known.ghost && !(ahead?.problem && due(`${id} ahead`))) return;
  changeStation(id, {
    ghost,
    foreseen: ahead?.problem ? words.stations.inTime(fixed(ahead.problem.in_s, 1), ahead.problem.sentence) : "",
  });
}

function show(sample: EventOf<"sample">): void {
  const live = lives.get(sample.station);
  const known = stationOf(sample.station);
  if (!live || !known || sample.q_rad.length !== live.q_rad.length) return;
  live.q_rad.set(sample.q_rad);
  live.received_s = performance.now() / 1000;
  live.sent_s = sample.sent_s;
  live.revision++;
  noteOther();
  listenToSample(sample.station, live.q_rad);
  const { sequence, time_s, moving, mode, safety, override, gripperClosed, step, message, plan_rad, command_rad } =
    sample;
  recordingOf(sample.station)?.record({
    sequence,
    time_s,
    q_rad: live.q_rad,
    moving,
    mode,
    safety,
    override,
    gripperClosed,
    step,
    message,
  } satisfies JointSample);
  if (safety === known.safety && mode === known.mode && !due(sample.station)) return;
  changeStation(sample.station, { moving, mode, safety, override, step, message, plan_rad, command_rad });
}

/** What a connected robot's guard must know of the cell: the rest of the document is not sent again. */
const sameForGuards = (a: CellDocument, b: CellDocument): boolean =>
  a.robot === b.robot &&
  a.objects === b.objects &&
  a.tools === b.tools &&
  a.tool === b.tool &&
  a.allowedPairs === b.allowedPairs &&
  a.pairs === b.pairs &&
  a.errors === b.errors;
const CELL_EVERY_MS = 100;
let cellDue: number | undefined;

/** Every robot that is connected from here is given the cell as it is now. One that cannot be given it says why. */
function tellCell(): void {
  cellDue = undefined;
  const { document } = cellStore.getState();
  if (!document) return;
  for (const { id, name } of stationStore.getState().stations)
    void hostOf(id)
      ?.ask({ type: "cell", station: id, cell: document })
      .then(outcome => {
        if (outcome.kind !== "done") notify("bad", `${name}: ${outcome.why.sentence}`, outcome.why.hint);
      });
}

/** Listens to hosts as long as the page lives. STOP stops every station. */
export function startStations(): void {
  onServers(take);
  // While an object is dragged the cell changes with every frame; it is told at most this often, and as it is in the
  // end.
  cellStore.subscribe((state, before) => {
    if (!state.document || state.document === before.document) return;
    if (before.document && sameForGuards(state.document, before.document)) return;
    if (stationStore.getState().stations.length > 0) cellDue ??= window.setTimeout(tellCell, CELL_EVERY_MS);
  });
  onStop(() => {
    for (const place of new Set(stationStore.getState().stations.map(({ place: at }) => at))) hostAt(place)?.stop();
  });
}
