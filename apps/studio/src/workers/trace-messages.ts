import type { TraceAnswer, TraceTask } from "../runtime/planning/tracing.ts";

export interface ToTracer {
  readonly id: number;
  readonly task: TraceTask;
}
export interface FromTracer {
  readonly id: number;
  readonly answer: TraceAnswer;
  readonly took_ms: number;
}
