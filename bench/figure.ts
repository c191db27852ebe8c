import { PerformanceObserver } from "node:perf_hooks";

/** One measured figure: the median of n repeats, with its spread. */
export interface Figure {
  readonly name: string;
  readonly unit: string;
  readonly median: number;
  readonly min: number;
  readonly max: number;
  readonly n: number;
  /** What one should know to read it: the peer, the budget, the condition. */
  readonly note?: string;
}

/**
 * A benchmark is a file of this folder that exports `run: Bench`. A peer that is not installed is left out and said on
 * stderr.
 */
export type Bench = () => Promise<readonly Figure[]>;

export function figure(name: string, unit: string, values: readonly number[], note?: string): Figure {
  const sorted = [...values].sort((a, b) => a - b);
  return {
    name,
    unit,
    median: sorted[sorted.length >> 1]!,
    min: sorted[0]!,
    max: sorted.at(-1)!,
    n: sorted.length,
    ...(note === undefined ? {} : { note }),
  };
}

/** Time of one call [µs], measured in `repeats` rounds of `calls` calls after a warm-up. */
export function microseconds(calls: number, repeats: number, call: (i: number) => void): number[] {
  for (let i = 0; i < calls; i++) call(i);
  return Array.from({ length: repeats }, () => {
    const began = process.hrtime.bigint();
    for (let i = 0; i < calls; i++) call(i);
    return Number(process.hrtime.bigint() - began) / 1000 / calls;
  });
}

/** As `microseconds`, after as many rounds of warm-up as the compiler needs to settle; those are not counted. */
export function settled(calls: number, repeats: number, warmUp: number, call: (i: number) => void): number[] {
  microseconds(calls, warmUp, call);
  return microseconds(calls, repeats, call);
}

/**
 * How many times garbage was collected in so many calls, after a warm-up that is not counted: the compiler works beside
 * it and is waited for.
 */
export async function collections(calls: number, call: (i: number) => void): Promise<number> {
  for (let round = 0; round < 4; round++) {
    for (let i = 0; i < calls / 4; i++) call(i);
    await new Promise(resolve => {
      setTimeout(resolve, 100);
    });
  }
  let seen = 0;
  const observer = new PerformanceObserver(list => {
    seen += list.getEntries().length;
  });
  observer.observe({ entryTypes: ["gc"] });
  // What was collected before is told late: it is heard out and not counted.
  await new Promise(resolve => {
    setTimeout(resolve, 50);
  });
  seen = 0;
  for (let i = 0; i < calls; i++) call(i);
  await new Promise(resolve => {
    setTimeout(resolve, 50);
  });
  observer.disconnect();
  return seen;
}
