export * from "./sink.ts";
export { createRunRecorder, QUANTUM, type Compact, type RunHeader, type RunRecorder } from "./recorder.ts";
export { readRecording, type Read, type RecordingData } from "./read.ts";
export { openRecording, playable, type OpenOptions, type Opened, type RecordedRun } from "./run.ts";
export type { RunFacts, Samples } from "./decode.ts";
export type { Note, NoteKind, Notes } from "./notes.ts";
export type { Packing } from "./packing.ts";
export { copyState, sameState, type EventLevel, type RobotState, type RunEvent } from "./state.ts";
export { TOPICS, type Topic } from "./topics.ts";
export {
  createDigester,
  type Cycle,
  type Digest,
  type Digester,
  type Mark,
  type Minute,
  type OpenCycle,
} from "./digest.ts";
export { memoryFiles, type ArchivePort, type FilePort, type FileSink, type StoredFile } from "./history/port.ts";
export { expired, fileName, fileTime_ms, KEEPING, type Keeping } from "./history/keeping.ts";
export { createArchive, RETRY_S, type Archive, type ArchiveOptions } from "./history/archive.ts";
export {
  openHistory,
  type History,
  type HistoryOptions,
  type Moment,
  type OpenedHistory,
  type Stretch,
} from "./history/history.ts";
export { catalogue, type Catalogued, type CatalogueFile } from "./history/catalogue.ts";
export {
  dashboardOf,
  type AlarmCount,
  type Dashboard,
  type DashboardOptions,
  type Hint,
  type JointTravel,
  type Reported,
  type TrendPoint,
} from "./history/dashboard.ts";
export { compareTraces, traceOf, type Comparison, type Trace } from "./history/compare.ts";
export { playHistory, type HistoryPlayer } from "./history/player.ts";
export { latencyMeter, type LatencyMeter } from "./latency.ts";
