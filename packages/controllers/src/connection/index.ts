export * from "./connection.ts";
export * from "./open.ts";
export * from "./virtual-pendant.ts";
export {
  START_WINDOW_S,
  START_WITHIN_S,
  startSynchronized,
  type GroupEnd,
  type GroupMember,
  type Startable,
  type StartedWords,
} from "./synchronized-start.ts";
export type { Ahead, AheadWords, Progress } from "./ahead.ts";
export { prepareJob, type CellDefinition, type PreparedJob, type PrepareJob, type JobQuestion } from "./prepare-job.ts";
