import {
  Fault,
  capabilitiesUsed,
  degrees,
  everyStep,
  flow,
  holds,
  identity,
  lowered,
  millimetres,
  type FlowOptions,
  type Predicate,
  type Dialect,
  type EmittedFile,
  type Executed,
  type FlowEvent,
  type Interpreted,
  type Pose,
  type PrimitiveStep,
  type Program,
  type Resolution,
  type Robot,
  type Signals,
  type Step,
  type TextFault,
} from "@twincell/core";
import { shareOf } from "./reading/trial-inputs.ts";
import { PROOF_TOLERANCE } from "./reading/tolerance.ts";
import { StepTips, stepDeviation, stepDifference } from "./reading/step-difference.ts";

/** What a controller executes of the files of an export, as one text. */
export const runnableFile = (dialect: Dialect, files: readonly EmittedFile[]): EmittedFile | undefined =>
  dialect.runnable?.(files) ?? files[0];

export { PROOF_TOLERANCE };

/** A step of the program beside what the text did in its place. */
export interface ProvenStep {
  readonly id: string;
  /** Line of the file that did it. */
  readonly line: number;
  readonly deviation_m: number;
  readonly deviation_rad: number;
}
export type Proof =
  | {
      readonly kind: "proven";
      readonly file: string;
      readonly steps: readonly ProvenStep[];
      readonly worst_m: number;
      readonly worst_rad: number;
      readonly sentence: string;
    }
  | {
      readonly kind: "differs";
      readonly file: string;
      readonly step: string;
      readonly line: number;
      readonly sentence: string;
    }
  | {
      readonly kind: "not-executed";
      readonly file: string;
      readonly faults: readonly TextFault[];
      readonly sentence: string;
    };

/** Loops without end are followed this often round. */
const ROUNDS = 3;
/** More steps than this are not compared. */
const MOST_STEPS = 50_000;
/** Trials after the first two, in which all inputs are off and on: each input is now this, now that. */
const DRAWN_TRIALS = 6;
/** Trials of a program that computes nothing. */
const SIMPLE_TRIALS = 3;
/** Rounds of a loop, one after the other, in which it only looks again. */
const MOST_STANDING = 1000;

type Trial = (line: string, afterSteps: number) => boolean;
/**
 * What inputs say while a text and its program are compared. A level hangs on the line and on how many
 * steps were done, so that both sides are told the same however often either of them asks.
 */
const TRIALS: readonly Trial[] = [
  () => false,
  () => true,
  ...Array.from({ length: DRAWN_TRIALS }, (_, seed): Trial => {
    return (line, after) => shareOf(seed + 1, `${after} ${line}`) >= 0.5;
  }),
];

/**
 * Executes an emitted text and compares it, step by step, with the program it was made of: sort of step, path, tool tip
 * in the world, joint angles where they were taught, speed, stop or no stop, signals. Loops, calls and pallets are
 * carried out on both sides; where the program decides by signals, both are told the same and compared three times.
 * This proves the text, not the emitter's intention.
 */
export function proveText(
  dialect: Pick<Dialect, "interpret" | "resolution" | "idioms"> & Partial<Pick<Dialect, "cannot">>,
  file: { readonly name: string; readonly text: string },
  taught: Program,
  robot: Robot,
  worldFromBase: Pose<"world", "base"> = identity(),
): Proof {
  const program = lowered(taught, dialect);
  const interpreted = dialect.interpret(file.text, robot, worldFromBase);
  if (interpreted.kind === "not-understood") {
    const fault = interpreted.faults[0]!;
    return {
      kind: "not-executed",
      file: file.name,
      faults: interpreted.faults,
      sentence: `${file.name} stops in line ${fault.line}, column ${fault.column}: ${fault.sentence}`,
    };
  }
  // What is written here is carried out to the last statement: a controller's own values are all it may count on.
  const kept = interpreted.notExecuted?.find(({ expected }) => expected !== "a value in the text");
  if (kept !== undefined)
    return {
      kind: "not-executed",
      file: file.name,
      faults: [kept],
      sentence: `${file.name} is not carried out as it stands in line ${kept.line}: ${kept.sentence}`,
    };
  const used = capabilitiesUsed(program);
  const computes = used.has("while") || used.has("expression") || used.has("assign");
  const trials = computes ? TRIALS.length : used.has("if") ? SIMPLE_TRIALS : 1;
  const steps: ProvenStep[] = [];
  for (const trial of TRIALS.slice(0, trials)) {
    try {
      const differs = compare(
        interpreted,
        file.name,
        program,
        robot,
        worldFromBase,
        dialect.resolution ?? {},
        trial,
        steps,
      );
      if (differs !== undefined) return differs;
    } catch (cause) {
      if (!(cause instanceof Fault)) throw cause;
      return {
        kind: "not-executed",
        file: file.name,
        faults: [],
        sentence: `${file.name} stops: ${cause.message} ${cause.hint}`,
      };
    }
  }
  const worst_m = steps.reduce((most, step) => Math.max(most, step.deviation_m), 0);
  const worst_rad = steps.reduce((most, step) => Math.max(most, step.deviation_rad), 0);
  return {
    kind: "proven",
    file: file.name,
    steps,
    worst_m,
    worst_rad,
    sentence: `${file.name} was executed line by line and meets all ${steps.length} steps within ${millimetres(worst_m).toFixed(4)} mm and ${degrees(worst_rad).toFixed(5)}°.`,
  };
}

function compare(
  interpreted: Extract<Interpreted, { kind: "ready" }>,
  file: string,
  program: Program,
  robot: Robot,
  worldFromBase: Pose<"world", "base">,
  resolution: Resolution,
  trial: Trial,
  proven: ProvenStep[],
): Extract<Proof, { kind: "differs" }> | undefined {
  const tips = {
    wanted: new StepTips(program, robot, worldFromBase),
    done: new StepTips(interpreted.context, robot, worldFromBase),
  };
  const position_m = Math.max(PROOF_TOLERANCE.position_m, resolution.position_m ?? 0);
  const angle_rad = Math.max(PROOF_TOLERANCE.angle_rad, resolution.angle_rad ?? 0);
  const wanted = program.signals;
  const done = interpreted.context.signals ?? {};
  const progress = { steps: 0 };
  // Controllers know lines by their numbers, some by what they are called.
  const isNamed = Object.values(done).some(({ address }) => address === undefined);
  const keyIn =
    (lines: Program["signals"]) =>
    (name: string): string =>
      isNamed ? plainName(name) : `${lines[name]?.kind ?? ""} ${lines[name]?.address ?? ""}`;
  const text = steady(interpreted.run(new Told(trial, keyIn(done), progress)));
  const told = new Told(trial, keyIn(wanted), progress);
  const forever = Array.from(everyStep(program)).some(step => step.type === "repeat" && step.times === "forever");
  const options: FlowOptions = {
    decide: (when: Predicate, variable) => holds(when, told, variable),
    read: signal => told.read(signal),
    ...(forever ? { rounds: ROUNDS } : {}),
  };
  let ended = false;
  const steps = following(flow(program, options), told);
  for (;;) {
    const following = steps.next();
    if (following.done === true) {
      if (following.value === "left") return undefined;
      break;
    }
    const [step, next] = following.value;
    if (progress.steps >= MOST_STEPS) return undefined;
    const found = text.next();
    const differs = (sentence: string): Extract<Proof, { kind: "differs" }> => ({
      kind: "differs",
      file,
      step: step.id,
      line: found?.line ?? 0,
      sentence: `Step ${step.name ?? step.id}: ${sentence}`,
    });
    if (found === undefined) return differs("the text ends before it.");
    const odd = stepDifference(step, found.step, next, { mine: wanted, theirs: done, robot, resolution });
    if (odd !== undefined) return differs(`line ${found.line} ${odd}`);
    const [deviation_m, deviation_rad] =
      step.type === "move" && found.step.type === "move" ? stepDeviation(step, found.step, tips, resolution) : [0, 0];
    if (!(deviation_m <= position_m))
      return differs(
        `line ${found.line} ends ${millimetres(deviation_m).toFixed(3)} mm away; ${millimetres(position_m)} mm are allowed.`,
      );
    if (!(deviation_rad <= angle_rad))
      return differs(
        `line ${found.line} ends turned by ${degrees(deviation_rad).toFixed(4)}°; ${degrees(angle_rad).toFixed(3)}° are allowed.`,
      );
    proven.push({ id: step.id, line: found.line, deviation_m, deviation_rad });
    ended = step.type === "stop";
    progress.steps++;
  }
  // A loop without end has been left on this side only.
  const extra = forever && !ended ? undefined : text.next();
  return extra === undefined
    ? undefined
    : {
        kind: "differs",
        file,
        step: "",
        line: extra.line,
        sentence: `Line ${extra.line} does something after the last step.`,
      };
}

/** The beginning of a name, in the letters that every language keeps. */
const plainName = (name: string): string =>
  name
    .toLowerCase()
    .replaceAll(/[^a-z0-9]/g, "")
    .slice(0, 8);

/** The steps of an executed text, one by one. */
function steady(run: Iterator<Executed, void>): { next(): { readonly line: number; readonly step: Step } | undefined } {
  return {
    next() {
      for (let next = run.next(); next.done !== true; next = run.next())
        if (next.value.step !== undefined) return { line: next.value.line, step: next.value.step };
      return undefined;
    },
  };
}

/**
 * The steps of the program, each with the one after it where that is known without a decision: stops that it does not
 * say are told as no step.
 */
function* following(
  happenings: Iterable<FlowEvent>,
  told: Told,
): Generator<readonly [PrimitiveStep, PrimitiveStep | undefined], "ended" | "left"> {
  let before: PrimitiveStep | undefined;
  let standing = 0;
  for (const happening of happenings) {
    if (happening.kind === "failed") {
      if (before !== undefined) yield [before, undefined];
      return "left";
    }
    if (happening.kind !== "step") {
      if (happening.kind === "passed" && happening.step.type !== "comment" && before !== undefined) {
        yield [before, undefined];
        before = undefined;
      }
      continue;
    }
    const { step, stands } = happening;
    standing = stands ? standing + 1 : 0;
    if (standing > MOST_STANDING) return "left";
    if (step.type === "set") told.write(step.signal, step.to);
    if (before !== undefined) yield [before, stands ? undefined : step];
    before = stands ? undefined : step;
  }
  if (before !== undefined) yield [before, undefined];
  return "ended";
}

/** Inputs that say what a trial says; outputs are what was written. */
class Told implements Signals {
  private readonly trial: Trial;
  private readonly keyOf: (signal: string) => string;
  private readonly progress: { readonly steps: number };
  private readonly written = new Map<string, boolean | number>();
  constructor(trial: Trial, keyOf: (signal: string) => string, progress: { readonly steps: number }) {
    this.trial = trial;
    this.keyOf = keyOf;
    this.progress = progress;
  }
  read(signal: string): boolean | number {
    return this.written.get(signal) ?? this.trial(this.keyOf(signal), this.progress.steps);
  }
  write(signal: string, value: boolean | number): void {
    this.written.set(signal, value);
  }
}
