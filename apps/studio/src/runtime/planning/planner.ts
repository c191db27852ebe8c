import { withRobots } from "../hire.ts";
import { words } from "../../messages/index.ts";
import type { FromPlanner, PlanTask, ToPlanner } from "../../workers/plan-messages.ts";

/** Who searches: a worker of the page, or a double in a test. */
export interface Planner {
  post(message: ToPlanner): void;
  listen(hear: (message: FromPlanner) => void): void;
  close(): void;
}
export function workerPlanner(): Planner {
  const worker = withRobots(new Worker(new URL("../../workers/plan.worker.ts", import.meta.url), { type: "module" }));
  return {
    post: message => {
      worker.postMessage(message);
    },
    listen: hear => {
      worker.addEventListener("message", ({ data }: MessageEvent<FromPlanner>) => {
        hear(data);
      });
      worker.addEventListener("error", event => {
        hear({ kind: "trouble", id: -1, sentence: event.message || words.collide.trouble });
      });
    },
    close: () => {
      worker.terminate();
    },
  };
}

/** One search at a time, away from the page. The next one ends the one before; ending it ends its worker. */
export class BackgroundSearch {
  hire: () => Planner = workerPlanner;
  private planner: Planner | null = null;
  private id = 0;

  /** `hear` is told how far it is and what is known so far, and once, at the end, what came of it. */
  begin(task: PlanTask, hear: (message: FromPlanner) => void): void {
    this.cancel();
    const mine = ++this.id;
    const hired = this.hire();
    this.planner = hired;
    hired.listen(message => {
      if (this.planner !== hired || (message.id !== mine && message.id !== -1)) return;
      if (message.kind !== "progress" && message.kind !== "field-so-far") this.cancel();
      hear(message);
    });
    hired.post({ id: mine, task });
  }

  cancel(): void {
    this.planner?.close();
    this.planner = null;
  }
}
