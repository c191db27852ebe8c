import { textTask } from "../live/text-task.ts";
import type { FromTextWorker, ToTextWorker } from "./text-messages.ts";

const answer = (message: FromTextWorker): void => {
  postMessage(message);
};

addEventListener("message", ({ data }: MessageEvent<ToTextWorker>) => {
  try {
    answer(textTask(data));
  } catch (trouble) {
    answer({ kind: "trouble", id: data.id, sentence: trouble instanceof Error ? trouble.message : String(trouble) });
  }
});
