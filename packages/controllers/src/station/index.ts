export * from "./station.ts";
export * from "./open.ts";
export * from "./cabinet.ts";
export {
  START_WINDOW_S,
  START_WITHIN_S,
  startTogether,
  type GroupEnd,
  type GroupMember,
  type Startable,
  type StartedWords,
} from "./together.ts";
export type { Ahead, AheadWords, Progress } from "./ahead.ts";
export { layOut, type CellDefinition, type LaidOut, type LayOut, type LayOutQuestion } from "./lay-out.ts";
