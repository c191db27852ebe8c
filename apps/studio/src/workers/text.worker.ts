import "./know-robots.ts";
import { textTask } from "../runtime/text-task.ts";
import type { FromTextWorker, ToTextWorker } from "./text-messages.ts";

const answer = (message: FromTextWorker): void => {
  postMessage(message);
};

addEventListener("message", ({ data }: MessageEvent<ToTextWorker>) => {
  try {
    answer(textTask(data));
  } catch (faultInjection) {
    answer({
      kind: "trouble",
      id: data.id,
      sentence: faultInjection instanceof Error ? faultInjection.message : String(faultInjection),
    });
  }
});
