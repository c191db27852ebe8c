import { robotById, type Scheduler } from "@twincell/core";
import { compareTraces, dashboardOf, playHistory, traceOf, type HistoryPlayer, type Moment } from "@twincell/recording";
import { cellStore } from "../../stores/cell.ts";
import { robotOf } from "../../stores/document.ts";
import { closeHistory, historyStore, windowAt } from "../../stores/history.ts";
import { notify } from "../../stores/notices.ts";
import { serviceStore } from "../../stores/service.ts";
import { viewStore } from "../../stores/view.ts";
import { words } from "../../messages/index.ts";
import { listRuns, removeRun, runBlob, tidyRuns, type RunStorage } from "./archive.ts";
import { showJoints } from "../live.ts";
import { leavePast, showPast } from "./past-robot.ts";
import type { OpenRecordings, RecordingFile } from "./recordings.ts";
import { wayOf, type PathWorld } from "../planning/tool-trail.ts";

const TELL_EVERY_S = 0.1;
/** So many parts of a file are read at once when it is opened: short runs are then there whole. */
const READ_AT_ONCE = 240;

/** Looks back at recorded runs: the robot on screen stands where it stood then. */
export interface TravelBack {
  refresh(): Promise<void>;
  /** Opens a kept run. False when it is not here, or cannot be read. */
  open(id: string): Promise<boolean>;
  /** Opens files from outside, however long. */
  openFiles(files: readonly RecordingFile[]): Promise<boolean>;
  close(): void;
  seek(to_s: number): void;
  play(): void;
  pause(): void;
  setSpeed(factor: number): void;
  /** To the last alarm before the moment that is looked at; the last of all from behind it. */
  lastAlarm(): void;
  /** Lays two cycles over each other, by their places in the list. */
  overlay(first: number, second: number, world: PathWorld): Promise<void>;
  /** Everything about the moment that is looked at, to go on from it; null before it is read. */
  readonly moment: Moment | null;
  /** Id of the robot that was recorded, or "". */
  readonly robot: string;
  /** Works out the figures of what is open, with the service intervals that were said of its robot. */
  figures(): void;
  /** The file as it is kept, for a download. */
  file(id: string): Promise<Blob>;
  remove(id: string): Promise<void>;
}

export function travelBack(
  runStorage: RunStorage,
  scheduler: Scheduler,
  openRecordings: OpenRecordings,
  clock_ms: () => number,
): TravelBack {
  let player: HistoryPlayer | null = null;
  let told_s = -1;
  let opening: object | null = null;

  const tell = (force: boolean): void => {
    if (!player) return;
    const now_s = scheduler.now_s();
    if (!force && now_s - told_s < TELL_EVERY_S && player.playing) return;
    told_s = now_s;
    const { moment, position_s } = player;
    const said = moment && {
      step: moment.state.step,
      mode: moment.state.mode,
      safety: moment.state.safety,
      gripperClosed: moment.state.gripperClosed,
      message: moment.state.message,
      signals: moment.signals,
      recorded: moment.recorded,
    };
    historyStore.setState(state => ({
      t_s: position_s,
      playing: player!.playing,
      window: windowAt(position_s, state),
      ...(said && !alike(said, state.moment) ? { moment: said } : {}),
    }));
  };
  const close = (): void => {
    player?.close();
    player = opening = null;
    leavePast();
    closeHistory();
  };

  async function openAs(
    id: string | null,
    name: string,
    files: () => Promise<readonly RecordingFile[]>,
    hint: string,
  ): Promise<boolean> {
    close();
    const mine = (opening = {});
    historyStore.setState({ open: id, name, opening: true });
    const taken = await files()
      .then(openRecordings)
      .catch((reason: unknown) => ({
        kind: "not-a-recording" as const,
        sentence: `${words.history.unreadable} ${reason instanceof Error ? reason.message : String(reason)}.`,
      }));
    if (opening !== mine) return false;
    const robot = taken.kind === "history" ? robotById(taken.history.robot) : undefined;
    const wrong =
      taken.kind === "not-a-recording"
        ? taken.sentence
        : !robot
          ? words.history.unknownRobot(taken.history.robotName || taken.history.robot)
          : robot.arm.joints.length !== taken.history.joints
            ? words.history.otherJoints(taken.history.joints, robot.name, robot.arm.joints.length)
            : null;
    if (taken.kind === "not-a-recording" || !robot || wrong !== null) {
      close();
      notify("bad", wrong ?? words.history.unreadable, hint);
      return false;
    }
    const { history } = taken;
    const { document } = cellStore.getState();
    const here = robotOf(document);
    const stand = historyStore.getState().runs.find(run => run.id === id)?.station?.stand;
    const other = stand !== undefined || (here ? here.id !== robot.id : false);
    player = playHistory(history, robot, scheduler);
    player.onSample(({ q_rad }) => {
      if (other) showPast(robot, q_rad);
      else if (viewStore.getState().mode === "history") showJoints(q_rad);
      tell(false);
    });
    player.onTrouble(sentence => {
      tell(true);
      notify("bad", sentence, words.history.unreadableHint);
    });
    const parts = history.samples(0, Infinity);
    for (let read = 0; read < READ_AT_ONCE && !(await parts.next()).done; read++);
    if (opening !== mine) return false;
    historyStore.setState({
      opening: false,
      name: name || history.program || history.cell,
      startedAt_ms: Number(history.startedAt_ns / 1_000_000n),
      duration_s: history.duration_s,
      marks: history.marks,
      cycles: history.cycles,
      troubles: history.troubles,
      speed: 1,
      window: { from_s: 0, to_s: history.duration_s },
    });
    player.timeline.seek(0);
    tell(true);
    if (other) historyStore.setState({ past: stand ?? document?.robot.worldFromBase ?? null });
    return true;
  }

  return {
    async refresh() {
      const gone = await tidyRuns(runStorage, clock_ms());
      if (gone > 0) notify("info", words.history.tidied(gone));
      historyStore.setState({ runs: await listRuns(runStorage) });
    },
    open: id =>
      openAs(
        id,
        "",
        async () => [{ name: `${id}.mcap`, blob: await runBlob(runStorage, id) }],
        words.history.unreadableKept,
      ),
    openFiles: files => openAs(null, files[0]?.name ?? "", () => Promise.resolve(files), words.history.unreadableHint),
    close,
    seek(to_s) {
      player?.timeline.seek(to_s);
      tell(true);
    },
    play() {
      player?.timeline.play();
      tell(true);
    },
    pause() {
      player?.timeline.pause();
      tell(true);
    },
    setSpeed(factor) {
      player?.timeline.setSpeed(factor);
      historyStore.setState({ speed: factor });
    },
    lastAlarm() {
      if (!player) return;
      const alarm = player.history.lastAlarm(player.position_s) ?? player.history.lastAlarm(Infinity);
      if (!alarm) {
        notify("info", words.history.noAlarm);
        return;
      }
      player.timeline.pause();
      player.timeline.seek(alarm.at_s);
      tell(true);
    },
    async overlay(first, second, world) {
      if (!player) return;
      const { history, robot } = player;
      const cycles = [history.cycles[first], history.cycles[second]];
      const traces = await Promise.all(
        cycles.flatMap(cycle => (cycle ? [traceOf(history, cycle.from_s, cycle.to_s)] : [])),
      );
      if (player?.history !== history) return;
      const [a, b] = traces;
      historyStore.setState({
        overlay: {
          first,
          second,
          ways: traces.map(trace => wayOf(trace, robot, world)),
          comparison: a && b ? compareTraces(robot, a, b) : null,
        },
      });
    },
    get moment() {
      return player?.moment ?? null;
    },
    get robot() {
      return player?.history.robot ?? "";
    },
    figures() {
      if (player)
        historyStore.setState({
          figures: dashboardOf(player.history, {
            serviceTravel: serviceStore.getState().travel[player.history.robot] ?? [],
          }),
        });
    },
    file: id => runBlob(runStorage, id),
    async remove(id) {
      if (historyStore.getState().open === id) close();
      await removeRun(runStorage, id);
      historyStore.setState({ runs: await listRuns(runStorage) });
    },
  };
}

function alike<T extends object>(a: T, b: T): boolean {
  return (Object.keys(a) as (keyof T)[]).every(
    key => a[key] === b[key] || (key === "signals" && JSON.stringify(a[key]) === JSON.stringify(b[key])),
  );
}
