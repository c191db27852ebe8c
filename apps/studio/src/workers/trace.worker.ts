import "./know-robots.ts";
import { traceProgram, type TraceAnswer } from "../runtime/planning/tracing.ts";
import type { FromTracer, ToTracer } from "./trace-messages.ts";

addEventListener("message", ({ data: { id, task } }: MessageEvent<ToTracer>) => {
  const began = performance.now();
  let answer: TraceAnswer;
  try {
    answer = traceProgram(task);
  } catch (problem) {
    answer = {
      kind: "cannot",
      edge: 0,
      sentence: problem instanceof Error ? problem.message : String(problem),
    };
  }
  const message: FromTracer = { id, answer, took_ms: performance.now() - began };
  postMessage(message);
});
