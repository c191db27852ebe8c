import { playable, type RecordedRun } from "@twincell/recording";
import type { Scheduler } from "@twincell/core";
import { historyStore } from "../stores/history.ts";
import { notify } from "../stores/notices.ts";
import { viewStore } from "../stores/view.ts";
import { listRuns, removeRun, runBytes, type Shelf } from "./archive.ts";
import { showJoints } from "./live.ts";
import type { ReadRecording } from "./recording-reader.ts";

const TELL_EVERY_S = 0.1;

/** Looks back at recorded runs: the robot on screen stands where it stood then. */
export interface TravelBack {
  refresh(): Promise<void>;
  open(id: string): Promise<void>;
  close(): void;
  seek(to_s: number): void;
  play(): void;
  pause(): void;
  setSpeed(factor: number): void;
  /** The file as it is kept, for a download. */
  bytes(id: string): Promise<Uint8Array<ArrayBuffer>>;
  remove(id: string): Promise<void>;
}

export function travelBack(shelf: Shelf, scheduler: Scheduler, read: ReadRecording): TravelBack {
  let run: RecordedRun | null = null, told_s = -1;

  const tell = (force: boolean): void => {
    if (!run) return;
    const now_s = scheduler.now_s();
    if (!force && now_s - told_s < TELL_EVERY_S && run.playing) return;
    told_s = now_s;
    historyStore.setState({ t_s: run.position_s, playing: run.playing });
  };
  const close = (): void => {
    run?.close();
    run = null;
    historyStore.setState({ open: null, opening: false, playing: false, t_s: 0, duration_s: 0, events: [], step: "" });
  };

  return {
    async refresh() { historyStore.setState({ runs: await listRuns(shelf) }); },
    async open(id) {
      close();
      historyStore.setState({ open: id, opening: true });
      const taken = await read(await runBytes(shelf, id));
      if (historyStore.getState().open !== id) return;
      const opened = taken.kind === "read" ? playable(taken.data, { scheduler }) : taken;
      if (opened.kind === "not-a-recording") {
        close();
        notify("bad", opened.sentence, "Download the file to keep it, or delete the run.");
        return;
      }
      run = opened.recording;
      run.onSample(({ q_rad, step }) => {
        if (viewStore.getState().mode === "history") showJoints(q_rad);
        if (historyStore.getState().step !== step) historyStore.setState({ step });
        tell(false);
      });
      historyStore.setState({ opening: false, duration_s: run.duration_s, events: run.events, speed: 1 });
      run.timeline.seek(0);
      tell(true);
    },
    close,
    seek(to_s) { run?.timeline.seek(to_s); tell(true); },
    play() { run?.timeline.play(); tell(true); },
    pause() { run?.timeline.pause(); tell(true); },
    setSpeed(factor) { run?.timeline.setSpeed(factor); historyStore.setState({ speed: factor }); },
    bytes: id => runBytes(shelf, id),
    async remove(id) {
      if (historyStore.getState().open === id) close();
      await removeRun(shelf, id);
      historyStore.setState({ runs: await listRuns(shelf) });
    },
  };
}
