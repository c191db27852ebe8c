import type { TraceAnswer, TraceTask } from "../live/tracing.ts";

export interface ToTracer {
  readonly id: number;
  readonly task: TraceTask;
}
export interface FromTracer {
  readonly id: number;
  readonly answer: TraceAnswer;
  readonly took_ms: number;
}
