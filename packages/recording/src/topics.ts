import { JOINT_STATE_SCHEMA } from "./joint-state.ts";
import { EVENT_SCHEMA, STATE_SCHEMA } from "./state.ts";
import { NOTE_SCHEMAS } from "./notes.ts";

/** What a channel says of itself in the file. */
export interface Topic {
  readonly topic: string;
  readonly messageEncoding: "cdr" | "json";
  readonly schema: { readonly name: string; readonly encoding: string; readonly text: string };
}

/**
 * Every channel of a recording, by its number in the file. New ones are added at the end: old files keep their meaning.
 */
export const TOPICS: readonly Topic[] = [
  { topic: "/joint_states", messageEncoding: "cdr", schema: JOINT_STATE_SCHEMA },
  { topic: "/robot_state", messageEncoding: "json", schema: STATE_SCHEMA },
  { topic: "/events", messageEncoding: "json", schema: EVENT_SCHEMA },
  { topic: "/io", messageEncoding: "json", schema: NOTE_SCHEMAS.io },
  { topic: "/commands", messageEncoding: "json", schema: NOTE_SCHEMAS.command },
  { topic: "/alarms", messageEncoding: "json", schema: NOTE_SCHEMAS.alarm },
  { topic: "/operator", messageEncoding: "json", schema: NOTE_SCHEMAS.operator },
  { topic: "/latency", messageEncoding: "json", schema: NOTE_SCHEMAS.latency },
  { topic: "/joint_load", messageEncoding: "json", schema: NOTE_SCHEMAS.load },
  { topic: "/cell", messageEncoding: "json", schema: NOTE_SCHEMAS.cell },
];
export const CHANNEL = {
  joints: 0,
  state: 1,
  events: 2,
  io: 3,
  command: 4,
  alarm: 5,
  operator: 6,
  latency: 7,
  load: 8,
  cell: 9,
} as const;
/** Key of the channel metadata and name of the metadata record that say which run this is. */
export const RUN_METADATA = "twincell.run";
/** Name of the metadata record behind the data that sums it up. */
export const DIGEST_METADATA = "twincell.digest";
