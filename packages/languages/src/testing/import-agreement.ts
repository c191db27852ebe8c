import { seededRandom, unrolled, type Dialect, type Parsed, type Robot, type Signals, type Step } from "@twincell/core";

/** More steps than this are not compared. */
const MOST_STEPS = 3_000;
/** Inputs of one run, drawn after so many steps. */
class DrawnInputs implements Signals {
  steps = 0;
  private readonly seed: number;
  private readonly written = new Map<string, boolean | number>();
  private readonly drawn = new Map<string, boolean>();
  constructor(seed: number) {
    this.seed = seed;
  }
  read(signal: string): boolean | number {
    const written = this.written.get(signal);
    if (written !== undefined) return written;
    const key = `${signal} ${this.steps}`;
    const known = this.drawn.get(key);
    if (known !== undefined) return known;
    const letters = [...key].reduce((sum, letter) => (sum * 31 + letter.charCodeAt(0)) >>> 0, this.seed);
    const value = seededRandom(letters)() < 0.5;
    this.drawn.set(key, value);
    return value;
  }
  write(signal: string, value: boolean | number): void {
    this.written.set(signal, value);
  }
}

/** What a text does not say, or says in another way than the program. */
const UNSAID = new Set(["id", "name", "group"]);
const plain = (step: Step): string =>
  JSON.stringify(
    Object.fromEntries(Object.entries(step).filter(([key]) => !UNSAID.has(key))),
    (_key, value: unknown) => (typeof value === "number" ? Number(value.toPrecision(9)) : value),
  );

/**
 * Where a program and its text, told the same, do not do the same; undefined where they do. Written apart from the
 * check of imports.
 */
export function disagreement(
  dialect: Dialect,
  text: string,
  parsed: Extract<Parsed, { kind: "parsed" }>,
  robot: Robot,
  seeds: readonly number[],
): string | undefined {
  const interpreted = dialect.interpret(text, robot);
  if (interpreted.kind === "not-understood") return `not executed: ${interpreted.faults[0]!.sentence}`;
  for (const seed of seeds) {
    const forText = new DrawnInputs(seed);
    const forSteps = new DrawnInputs(seed);
    const done: string[] = [];
    for (let run = interpreted.run(forText), next = run.next(); next.done !== true; next = run.next()) {
      if (next.value.step === undefined) continue;
      forText.steps++;
      done.push(plain(next.value.step));
      if (done.length >= MOST_STEPS) break;
    }
    const wanted: string[] = [];
    for (const step of unrolled(parsed.program, forSteps)) {
      // The time that a loop takes to look again, and the stop before a block, are no steps of the text.
      if (step.type === "wait" && (step.s === 0 || step.s === 0.004)) continue;
      forSteps.steps++;
      if (step.type === "set") forSteps.write(step.signal, step.to);
      wanted.push(plain(step));
      if (wanted.length >= MOST_STEPS) break;
    }
    const at = wanted.findIndex((step, i) => step !== done[i]);
    if (at >= 0) return `seed ${seed}, step ${at + 1}: ${wanted[at]} instead of ${done[at] ?? "the end"}`;
    if (done.length !== wanted.length) return `seed ${seed}: ${wanted.length} steps instead of ${done.length}`;
  }
  return undefined;
}
