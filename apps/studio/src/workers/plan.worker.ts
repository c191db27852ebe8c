import "./know-robots.ts";
import { planTask } from "../runtime/planning/plan-task.ts";
import type { FromPlanner, ToPlanner } from "./plan-messages.ts";

addEventListener("message", ({ data }: MessageEvent<ToPlanner>) => {
  const answer = (message: FromPlanner): void => {
    postMessage(message);
  };
  try {
    answer(planTask(data, () => performance.now() / 1000, answer));
  } catch (problem) {
    answer({
      kind: "trouble",
      id: data.id,
      sentence: problem instanceof Error ? problem.message : String(problem),
    });
  }
});
