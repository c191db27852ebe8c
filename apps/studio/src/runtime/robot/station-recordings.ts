import type { CommandOutcome, Robot } from "@twincell/core";
import { auditNote, type EventOf } from "@twincell/protocol";
import { createRunRecorder, type RunRecorder } from "@twincell/recording";
import { cellStore } from "../../stores/cell.ts";
import { connectionStore } from "../../stores/connection.ts";
import { historyStore, type RunEnding } from "../../stores/history.ts";
import { changeStation, type StationState } from "../../stores/stations.ts";
import { browserRunStorage, listRuns, openRunFile, type RunFile } from "../history/archive.ts";

/** A run of a station that is being recorded. */
export interface Recording {
  readonly recorder: RunRecorder;
  readonly file: RunFile;
  readonly note: (ending: RunEnding) => void;
}

const shelf = browserRunStorage();
const recordings = new Map<string, Recording>();

/** The recorder of the run that a station carries out; undefined when it runs nothing. */
export const recordingOf = (id: string): RunRecorder | undefined => recordings.get(id)?.recorder;

/** Begins to record a run of a station; a file of the runs of this browser. */
export function beginRecording(station: StationState, robot: Robot, program: string): Recording {
  const startedAt = new Date();
  const run = `${startedAt.toISOString().replace(/[:.]/g, "-")} ${station.id}`;
  const file = openRunFile(shelf, run);
  const cell = cellStore.getState().document?.name ?? "";
  const recorder = createRunRecorder(file.sink, {
    robot,
    startedAt_ns: BigInt(startedAt.getTime()) * 1_000_000n,
    program,
    cell,
    chunk_s: 0.5,
  });
  const note = (ending: RunEnding): void => {
    file.note({
      id: run,
      name: `${station.name} · ${program}`,
      startedAt: startedAt.toISOString(),
      duration_s: (Date.now() - startedAt.getTime()) / 1000,
      bytes: file.sink.position,
      ending,
      // The robot of the cell is shown as itself.
      ...(connectionStore.getState().station === station.id
        ? {}
        : { station: { robot: station.robot, stand: station.stand } }),
    });
  };
  note("running");
  recorder.event("run", `The run of ${program} began.`);
  const recording = { recorder, file, note };
  recordings.set(station.id, recording);
  return recording;
}

/** The run has ended: the recording is finished, and what could not be kept is said at the station. */
export async function endRecording(
  id: string,
  { recorder, file, note }: Recording,
  outcome: CommandOutcome,
): Promise<void> {
  recordings.delete(id);
  recorder.event(
    outcome.kind,
    outcome.kind === "done" ? "The run is done." : outcome.why.sentence,
    outcome.kind === "done" ? "info" : "warning",
  );
  recorder.finish();
  note(outcome.kind);
  const problem = (await file.settled()) ?? recorder.problem?.sentence ?? null;
  if (problem !== null) changeStation(id, { notice: problem });
  historyStore.setState({ runs: await listRuns(shelf) });
}

/** Everything that anybody does at that station while its run is recorded. */
export function recordAct(message: EventOf<"act">): void {
  const recorder = recordings.get(message.station)?.recorder;
  const said = auditNote(message);
  if (said?.kind === "command") recorder?.note("command", said.note);
  else if (said) recorder?.note("operator", said.note);
}
