import type { RwsState } from "../codec/index.ts";
import type { LoggedEvent } from "./cabinet.ts";

const DAYS = [31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31] as const;
/** A virtual controller takes the moment at which it was switched on for the beginning of 2026. */
function stamp(at_s: number): string {
  const two = (value: number): string => String(value).padStart(2, "0");
  const second = Math.floor(at_s);
  let day = Math.floor(second / 86_400) % 365;
  let month = 0;
  while (day >= DAYS[month]!) day -= DAYS[month++]!;
  return `2026-${two(month + 1)}-${two(day + 1)} T  ${two(Math.floor(second / 3600) % 24)}:${two(Math.floor(second / 60) % 60)}:${two(second % 60)}`;
}

/** Events as `rw/elog/0` tells them, latest first. */
export const eventStates = (events: readonly LoggedEvent[]): RwsState[] =>
  events.map(({ number, code, kind, at_s, title, text }) => ({
    type: "elog-message-li",
    title: `/rw/elog/0/${number}`,
    fields: {
      msgtype: String(kind),
      code: String(code),
      "src-name": "VIRTUAL",
      tstamp: stamp(at_s),
      title,
      desc: text,
      conseqs: "",
      causes: "",
      actions: "",
      argc: "0",
    },
  }));
