import { filterDemonstration, readDemonstration, type Demonstration } from "@twincell/core";
import type { FromDemonstrator, ToDemonstrator } from "./demonstration-messages.ts";

const answer = (message: FromDemonstrator): void => {
  postMessage(message);
};
let demonstration: Demonstration | null = null;

addEventListener("message", ({ data: { id, text, options } }: MessageEvent<ToDemonstrator>) => {
  try {
    if (text !== null) {
      const read = readDemonstration(text);
      if (read.kind === "unreadable") {
        answer({ kind: "unreadable", id, why: read });
        return;
      }
      ({ demonstration } = read);
      answer({ kind: "read", id, demonstration, dropped: read.dropped });
    }
    if (demonstration) answer({ kind: "filtered", id, filtered: filterDemonstration(demonstration, options) });
  } catch (problem) {
    answer({ kind: "trouble", id, sentence: problem instanceof Error ? problem.message : String(problem) });
  }
});
