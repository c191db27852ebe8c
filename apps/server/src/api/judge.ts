import { Worker } from "node:worker_threads";
import type { Refusal } from "@twincell/core";

interface Judged {
  readonly program: unknown;
  readonly model?: string;
  readonly cell?: unknown;
}
export type JudgeRequest =
  | (Judged & { readonly kind: "check"; readonly margin_m: number })
  | (Judged & { readonly kind: "plan"; readonly period_s: number })
  | (Judged & { readonly kind: "write"; readonly language: string });
export type JudgeAnswer =
  | { readonly kind: "done"; readonly answer: unknown }
  | { readonly kind: "refused"; readonly why: Refusal };

/** So many wait; more are told to come again. */
const MOST_WAITING = 16;
/** A judgement that takes longer is ended [s]. */
const LONGEST_S = 120;

const refused = (code: string, sentence: string, hint: string): JudgeAnswer => ({
  kind: "refused",
  why: { code, sentence, hint },
});

export interface Judge {
  ask(request: JudgeRequest): Promise<JudgeAnswer>;
  close(): void;
}

/** Checks, plans and writes programs in a thread of their own, one after the other: no robot's link waits for them. */
export function createJudge(): Judge {
  const waiting = new Map<number, (answer: JudgeAnswer) => void>();
  let worker: Worker | null = null;
  let count = 0;
  let limit: ReturnType<typeof setTimeout> | undefined;
  const end = (why: string): void => {
    clearTimeout(limit);
    void worker?.terminate();
    worker = null;
    for (const settle of waiting.values())
      settle(
        refused("judge.ended", `The program could not be judged: ${why}`, "Send a shorter one, or send it again."),
      );
    waiting.clear();
  };
  /** The time of the one that is judged now. */
  const watchTime = (): void => {
    clearTimeout(limit);
    if (waiting.size === 0) return;
    limit = setTimeout(() => {
      end(`it took longer than ${LONGEST_S} s.`);
    }, LONGEST_S * 1000);
    limit.unref();
  };
  function started(): Worker {
    if (worker) return worker;
    const mine = (worker = new Worker(new URL("./judge.worker.ts", import.meta.url)));
    mine.unref();
    mine.on("message", ({ id, answer }: { readonly id: number; readonly answer: JudgeAnswer }) => {
      const settle = waiting.get(id);
      waiting.delete(id);
      watchTime();
      settle?.(answer);
    });
    mine.on("error", problem => {
      if (worker === mine) end(problem.message);
    });
    return mine;
  }
  return {
    ask(request) {
      if (waiting.size >= MOST_WAITING)
        return Promise.resolve(
          refused(
            "judge.busy",
            `${MOST_WAITING} programs wait to be judged, which is the most.`,
            "Send it again later.",
          ),
        );
      return new Promise(resolve => {
        const id = count++;
        waiting.set(id, resolve);
        started().postMessage({ id, request });
        if (waiting.size === 1) watchTime();
      });
    },
    close() {
      end("the server is closing.");
    },
  };
}
