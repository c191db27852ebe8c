import type { Page } from "playwright-core";

/** What the main thread's processor time went to while something was done. */
export interface CpuReading {
  /** Script of each frame [ms]; frames are told apart in a page with the paced ledger. */
  readonly script_ms: readonly number[];
  /** Script of each task of the browser that had more than 1 ms of it [ms]. */
  readonly tasks_ms: readonly number[];
  readonly seconds: number;
}
/** One event of the browser's trace, times in microseconds; `tdur` counts only while the thread had a core. */
interface TraceEvent {
  readonly name: string;
  readonly ph: string;
  readonly pid: number;
  readonly tid: number;
  readonly ts: number;
  readonly dur?: number;
  readonly tdur?: number;
}

/** Ways into script, as the browser names them. One within another counts once. */
const SCRIPT = new Set([
  "FunctionCall",
  "RunMicrotasks",
  "BlinkScheduler_PerformMicrotaskCheckpoint",
  "TimerFire",
  "FireAnimationFrame",
  "EventDispatch",
  "HandlePostMessage",
  "EvaluateScript",
  "v8.evaluateModule",
]);
const TASK = "ThreadControllerImpl::RunTask";

/**
 * Processor time of the page's main thread from the browser's own trace. Unlike the wall's clock it stands still while
 * other processes have the core, so that the same script costs the same on a busy machine; handing WebGL calls over is
 * in it, what the rasteriser does with them is not.
 */
export async function cpuDuring(page: Page, act: () => Promise<unknown>): Promise<CpuReading> {
  const session = await page.context().newCDPSession(page);
  const events: TraceEvent[] = [];
  session.on("Tracing.dataCollected", ({ value }) => {
    events.push(...(value as unknown as TraceEvent[]));
  });
  await session.send("Tracing.start", {
    transferMode: "ReportEvents",
    traceConfig: { includedCategories: ["devtools.timeline", "toplevel"], excludedCategories: ["*"] },
  });
  const began_ms = performance.now();
  let seconds = 0;
  try {
    await page.evaluate(() => {
      console.timeStamp("here");
    });
    await act();
    seconds = (performance.now() - began_ms) / 1000;
  } finally {
    const complete = new Promise(resolve => {
      session.once("Tracing.tracingComplete", resolve);
    });
    await session.send("Tracing.end");
    await complete;
    await session.detach();
  }
  return { ...sums(events), seconds };
}

function sums(events: readonly TraceEvent[]): Omit<CpuReading, "seconds"> {
  const here = events.find(event => event.name === "TimeStamp");
  if (!here) throw new Error("The browser's trace does not tell which thread is the page's.");
  const own = events
    .filter(({ pid, tid }) => pid === here.pid && tid === here.tid)
    .sort((a, b) => a.ts - b.ts || (b.dur ?? 0) - (a.dur ?? 0));
  const script_ms: number[] = [];
  const tasks_ms: number[] = [];
  let stamps = 0;
  let frame = 0;
  let task = 0;
  let until = -1;
  for (const { name, ph, ts, dur = 0, tdur } of own) {
    if (name === "TimeStamp") {
      if (stamps++ > 1) script_ms.push(frame);
      frame = 0;
      continue;
    }
    if (ph !== "X") continue;
    if (name === TASK && ts >= until) {
      if (task > 1) tasks_ms.push(task);
      task = 0;
      continue;
    }
    if (!SCRIPT.has(name) || ts < until) continue;
    if (tdur === undefined && dur > 1000) throw new Error(`The browser's trace has no processor time for ${name}.`);
    until = ts + dur;
    frame += (tdur ?? dur) / 1000;
    task += (tdur ?? dur) / 1000;
  }
  if (task > 1) tasks_ms.push(task);
  return { script_ms, tasks_ms };
}
