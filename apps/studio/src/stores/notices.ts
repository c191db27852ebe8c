import { createStore } from "zustand/vanilla";
import { say } from "../messages/index.ts";

/** One clear sentence to the person, with the way out. */
export interface Notice {
  readonly id: number;
  readonly tone: "info" | "warn" | "bad" | "done";
  readonly sentence: string;
  readonly hint?: string;
}
export interface NoticeState {
  readonly notices: readonly Notice[];
}
export const noticeStore = createStore<NoticeState>(() => ({ notices: [] }));

/** What went well is old news as soon as something else goes well; problems stay beside it. */
const quiet = (notice: Notice): boolean => notice.tone === "info" || notice.tone === "done";
const stays = (notice: Notice): boolean => !quiet(notice);

/** More of them would cover the robot. */
const MAX_SHOWN = 3;

let next = 1;
export function notify(tone: Notice["tone"], said: string, hint?: string): number {
  const id = next++;
  const sentence = say(said);
  const notice: Notice = hint === undefined ? { id, tone, sentence } : { id, tone, sentence, hint: say(hint) };
  noticeStore.setState(state => ({
    notices: [
      ...state.notices
        .filter(other => other.sentence !== sentence && (stays(other) || !quiet(notice)))
        .slice(-(MAX_SHOWN - 1)),
      notice,
    ],
  }));
  return id;
}
export const dismiss = (id: number): void =>
  noticeStore.setState(state => ({ notices: state.notices.filter(notice => notice.id !== id) }));
/** Another cell is open: what was said of the one before no longer concerns anybody. */
export const dismissAll = (): void => noticeStore.setState({ notices: [] });
