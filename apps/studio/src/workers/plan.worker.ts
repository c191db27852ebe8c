import { planTask } from "../live/plan-task.ts";
import type { FromPlanner, ToPlanner } from "./plan-messages.ts";

addEventListener("message", ({ data }: MessageEvent<ToPlanner>) => {
  const answer = (message: FromPlanner): void => {
    postMessage(message);
  };
  try {
    answer(planTask(data, () => performance.now() / 1000, answer));
  } catch (trouble) {
    answer({ kind: "trouble", id: data.id, sentence: trouble instanceof Error ? trouble.message : String(trouble) });
  }
});
