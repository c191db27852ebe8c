import "./know-robots.ts";
import { textTask } from "../runtime/text-task.ts";
import type { FromTextWorker, ToTextWorker } from "./text-messages.ts";

const answer = (message: FromTextWorker): void => {
  postMessage(message);
};

addEventListener("message", ({ data }: MessageEvent<ToTextWorker>) => {
  try {
    answer(textTask(data));
  } catch (problem) {
    answer({
      kind: "trouble",
      id: data.id,
      sentence: problem instanceof Error ? problem.message : String(problem),
    });
  }
});
