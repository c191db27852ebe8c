import { traceProgram, type TraceAnswer } from "../live/tracing.ts";
import type { FromTracer, ToTracer } from "./trace-messages.ts";

addEventListener("message", ({ data: { id, task } }: MessageEvent<ToTracer>) => {
  const began = performance.now();
  let answer: TraceAnswer;
  try {
    answer = traceProgram(task);
  } catch (trouble) {
    answer = { kind: "cannot", edge: 0, sentence: trouble instanceof Error ? trouble.message : String(trouble) };
  }
  const message: FromTracer = { id, answer, took_ms: performance.now() - began };
  postMessage(message);
});
