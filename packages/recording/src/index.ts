export * from "./sink.ts";
export { createRunRecorder, type RunHeader, type RunRecorder } from "./recorder.ts";
export { readRecording, type Read, type RecordingData } from "./read.ts";
export { openRecording, playable, type OpenOptions, type Opened, type RecordedRun } from "./run.ts";
export type { EventLevel, RobotState, RunEvent } from "./state.ts";
