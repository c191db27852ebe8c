import type { Condition, SignalLine, Signals } from "@twincell/core";

/** Says what an input reads after so many executed steps. */
export type InputLevel = (signal: string, afterSteps: number) => boolean | number;

/**
 * Inputs of one trial: the level of a line hangs on its name and on how many steps were executed, so that a text and
 * the steps made of it are told the same however often either of them asks. Outputs read as they were last written.
 */
export class TrialInputs implements Signals {
  /** Steps executed so far. */
  steps = 0;
  /** Every different question so far, in order. */
  readonly asked = new Map<string, { readonly signal: string; readonly afterSteps: number }>();
  private readonly level: InputLevel;
  private readonly written = new Map<string, boolean | number>();

  constructor(level: InputLevel) {
    this.level = level;
  }

  read(signal: string): boolean | number {
    const written = this.written.get(signal);
    if (written !== undefined) return written;
    this.asked.set(inputKey(signal, this.steps), { signal, afterSteps: this.steps });
    return this.level(signal, this.steps);
  }

  write(signal: string, value: boolean | number): void {
    this.written.set(signal, value);
  }
}

/** One question of a trial as a text: which line, after how many steps. */
export const inputKey = (signal: string, afterSteps: number): string => `${afterSteps} ${signal}`;

/** Far beyond what any analogue line says. */
const FAR = 1e6;
const NEAR = 1e-3;

/**
 * What an analogue line may say so that each condition is met and missed: far off, and to both sides of every limit.
 */
export function analogueLevels(conditions: Iterable<Condition>): ReadonlyMap<string, readonly number[]> {
  const levels = new Map<string, number[]>();
  for (const condition of conditions) {
    const limit = "above" in condition ? condition.above : "below" in condition ? condition.below : undefined;
    if (limit === undefined) continue;
    const known = levels.get(condition.signal) ?? [];
    known.push(limit - NEAR, limit + NEAR);
    levels.set(condition.signal, known);
  }
  return levels;
}

/** The level of a line that a number in [0, 1) picks. */
export function levelFor(
  kind: SignalLine["kind"] | undefined,
  share: number,
  levels: readonly number[] = [],
): boolean | number {
  if (kind === undefined || kind.startsWith("digital")) return share >= 0.5;
  const all = [-FAR, 0, ...levels, FAR];
  return all[Math.min(all.length - 1, Math.floor(share * all.length))]!;
}

/** A number in [0, 1) that hangs on the seed and the question alone. */
export function shareOf(seed: number, key: string): number {
  let hash = (2166136261 ^ Math.imul(seed, 2654435761)) >>> 0;
  for (let i = 0; i < key.length; i++) hash = Math.imul(hash ^ key.charCodeAt(i), 16777619) >>> 0;
  hash = Math.imul(hash ^ (hash >>> 15), 2246822519) >>> 0;
  hash = Math.imul(hash ^ (hash >>> 13), 3266489917) >>> 0;
  return ((hash ^ (hash >>> 16)) >>> 0) / 4294967296;
}
