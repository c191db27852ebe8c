import {
  Fault,
  degrees,
  everyStep,
  flow,
  holds,
  millimetres,
  isCondition,
  type Condition,
  type ExpressionValues,
  type Predicate,
  type Executed,
  type Interpreted,
  type PrimitiveStep,
  type Pose,
  type Program,
  type Robot,
  type Step,
} from "@twincell/core";
import { PROOF_TOLERANCE } from "./tolerance.ts";
import { StepTips, stepDeviation, stepDifference } from "./step-difference.ts";
import { TrialInputs, analogueLevels, inputKey, levelFor, shareOf, type InputLevel } from "./trial-inputs.ts";

/** Rounds of an endless loop that are compared, as far as the steps of a trial last. */
const ROUNDS = 100;
/** Steps compared in one trial, and in all of them but the first. */
const STEPS_OF_TRIAL = 20_000;
const STEPS_OF_ALL = 40_000;
/** Lines of text executed in one trial. */
const LINES_OF_TRIAL = 400_000;
/** Trials with inputs drawn by chance, and all of them together. */
const RANDOM_TRIALS = 10;
const TRIALS = 512;
/** Shares of the levels that a line may have: the lowest and the highest. */
const OFF = 0;
const ON = 1 - Number.EPSILON;

/** Where a language executes angles, its reader may have kept the pose that they reach, with its posture. */
const RESOLUTION = { posesAsAngles: true } as const;

/** Where an import does not do what its text does. */
export interface ImportDifference {
  /** Line of the text, from 1. */
  readonly line: number;
  readonly sentence: string;
}
export interface ImportCheck {
  /** Steps compared, over all trials. */
  readonly steps: number;
  readonly trials: number;
  readonly differs: ImportDifference | undefined;
}
type Ready = Extract<Interpreted, { kind: "ready" }>;

/**
 * Executes an imported program and the text that it was made of side by side and compares every motion, output and wait
 * in their order: with all inputs off, all on, drawn by chance from a fixed seed, and then answer by answer turned
 * round, so that with few questions every way through the text is taken. The work is bounded by counts of steps and
 * lines.
 *
 * @param waits  ids of steps that wait where the text goes round until an input changes.
 */
export function checkImport(
  program: Program,
  interpreted: Ready,
  robot: Robot,
  worldFromBase: Pose<"world", "base">,
  waits: ReadonlySet<string> = new Set(),
): ImportCheck {
  const sides: Sides = { program, interpreted, robot, worldFromBase, waits };
  const levels = analogueLevels(conditionsOf(program));
  const kindOf = (signal: string) => (interpreted.context.signals ?? program.signals)[signal]?.kind;
  const constant =
    (share: number): InputLevel =>
    signal =>
      levelFor(kindOf(signal), share, levels.get(signal));
  let steps = 0;
  let trials = 0;
  const compare = (level: InputLevel): Trial => {
    const trial = compareOnce(sides, level);
    steps += trial.steps;
    trials++;
    return trial;
  };
  const answer = (differs: ImportDifference | undefined): ImportCheck => ({ steps, trials, differs });
  const off = compare(constant(OFF));
  if (off.differs !== undefined || off.asked.length === 0) return answer(off.differs);
  const drawn = (seed: number): InputLevel => {
    return (signal, after) => levelFor(kindOf(signal), shareOf(seed, inputKey(signal, after)), levels.get(signal));
  };
  const first = [constant(ON), ...Array.from({ length: RANDOM_TRIALS }, (_, i) => drawn(i + 1))];
  for (const level of first) {
    const { differs } = compare(level);
    if (differs !== undefined) return answer(differs);
    if (steps >= STEPS_OF_ALL) return answer(undefined);
  }
  // Answer after answer is turned round, those of the fewest turns first: with few questions every way through the
  // text.
  const ways: Way[] = [{ turned: new Set(), from: 0, asked: off.asked }];
  for (let next = 0; next < ways.length; next++) {
    const { turned, from, asked } = ways[next]!;
    for (let i = from; i < asked.length; i++) {
      if (trials >= TRIALS || steps >= STEPS_OF_ALL) return answer(undefined);
      const keys = new Set(turned).add(asked[i]!);
      const trial = compare((signal, after) =>
        levelFor(kindOf(signal), keys.has(inputKey(signal, after)) ? ON : OFF, levels.get(signal)),
      );
      if (trial.differs !== undefined) return answer(trial.differs);
      if (ways.length < TRIALS) ways.push({ turned: keys, from: i + 1, asked: trial.asked });
    }
  }
  return answer(undefined);
}

/** A way through a text: the questions answered with on, and the first question that may still be turned. */
interface Way {
  readonly turned: ReadonlySet<string>;
  readonly from: number;
  readonly asked: readonly string[];
}
interface Sides {
  readonly program: Program;
  readonly interpreted: Ready;
  readonly robot: Robot;
  readonly worldFromBase: Pose<"world", "base">;
  readonly waits: ReadonlySet<string>;
}
interface Trial {
  readonly steps: number;
  readonly asked: readonly string[];
  readonly differs: ImportDifference | undefined;
}

function compareOnce({ program, interpreted, robot, worldFromBase, waits }: Sides, level: InputLevel): Trial {
  const forText = new TrialInputs(level);
  const forSteps = new TrialInputs(level);
  const tips = {
    wanted: new StepTips(program, robot, worldFromBase),
    done: new StepTips(interpreted.context, robot, worldFromBase),
  };
  const terms = { mine: program.signals, theirs: interpreted.context.signals ?? {}, robot, resolution: RESOLUTION };
  const text = new TextSteps(interpreted.run(forText), forText);
  const end = (differs?: ImportDifference): Trial => ({
    steps: forSteps.steps,
    asked: [...forText.asked.keys()],
    differs,
  });
  const isEndless = Array.from(everyStep(program)).some(step => step.type === "repeat" && step.times === "forever");
  const isAlike = alikeMoves(program, interpreted.context);
  const imported = importedSteps(program, forSteps, isEndless, waits);
  for (;;) {
    const next = imported.next();
    if (next.done === true) {
      // A loop without end, or a wait that is not over, was left on this side only.
      if (next.value === "left") return end();
      const extra = text.next();
      if (extra === undefined) return end(text.failure);
      return end({
        line: extra.line,
        sentence: `The text goes on with ${spokenStep(extra.step)} after the last of the imported steps.`,
      });
    }
    if (forSteps.steps > STEPS_OF_TRIAL) return end();
    const [step, after] = next.value;
    const found = text.next();
    if (found === undefined) {
      if (text.isExhausted) return end();
      return end(
        text.failure ?? {
          line: text.line,
          sentence: `The imported steps go on with ${spokenStep(step)}; the text has ended.`,
        },
      );
    }
    if (isAlike(step, found.step)) continue;
    const odd = stepDifference(step, found.step, after, terms) ?? deviationSentence(step, found.step, tips);
    if (odd === undefined) continue;
    return end({
      line: found.line,
      sentence: `The text carries out ${spokenStep(found.step)}; the imported step ${step.name ?? step.id} is ${spokenStep(step)}.`,
    });
  }
}

/** Whether two moves are the same to the last digit, in tools and frames that are: then nothing has to be computed. */
function alikeMoves(
  mine: Pick<Program, "tools" | "frames">,
  theirs: Pick<Program, "tools" | "frames">,
): (a: Step, b: Step) => boolean {
  const known = new Map<string, boolean>();
  const isSame = (kind: "tools" | "frames", name: string | undefined): boolean => {
    if (name === undefined) return true;
    const key = `${kind} ${name}`;
    const before = known.get(key);
    if (before !== undefined) return before;
    // The text makes its tools and frames while it is executed: only what both have is kept in mind.
    const isBoth = Object.hasOwn(mine[kind], name) && Object.hasOwn(theirs[kind], name);
    const same = isBoth && JSON.stringify(mine[kind][name]) === JSON.stringify(theirs[kind][name]);
    if (isBoth) known.set(key, same);
    return same;
  };
  return (a, b) => {
    if (a.type !== "move" || b.type !== "move") return false;
    if (a.path !== b.path || a.blend_m !== b.blend_m || a.blend_ratio !== b.blend_ratio) return false;
    if (a.via !== undefined || b.via !== undefined || a.until !== undefined || b.until !== undefined) return false;
    return (
      isSame("tools", a.target.tool) &&
      ("q" in a.target || isSame("frames", a.target.frame)) &&
      JSON.stringify(a.target) === JSON.stringify(b.target) &&
      JSON.stringify(a.speed) === JSON.stringify(b.speed) &&
      JSON.stringify(a.acceleration) === JSON.stringify(b.acceleration)
    );
  };
}

function deviationSentence(
  step: Step,
  done: Step,
  tips: { readonly wanted: StepTips; readonly done: StepTips },
): string | undefined {
  if (step.type !== "move" || done.type !== "move") return undefined;
  const [away_m, turned_rad] = stepDeviation(step, done, tips, RESOLUTION);
  return away_m <= PROOF_TOLERANCE.position_m && turned_rad <= PROOF_TOLERANCE.angle_rad
    ? undefined
    : `${millimetres(away_m).toFixed(3)} mm and ${degrees(turned_rad).toFixed(3)}° apart`;
}

/** The steps of an executed text, one by one, within the bound of lines. */
class TextSteps {
  line = 1;
  /** The bound of lines is reached. */
  isExhausted = false;
  /** Why the text could not be executed further. */
  failure: ImportDifference | undefined;
  private readonly run: Iterator<Executed, void>;
  private readonly inputs: TrialInputs;
  private lines = 0;

  constructor(run: Iterator<Executed, void>, inputs: TrialInputs) {
    this.run = run;
    this.inputs = inputs;
  }

  next(): { readonly line: number; readonly step: Step } | undefined {
    try {
      for (let next = this.run.next(); next.done !== true; next = this.run.next()) {
        const { line, step } = next.value;
        this.line = line;
        if (++this.lines > LINES_OF_TRIAL) {
          this.isExhausted = true;
          return undefined;
        }
        if (step === undefined) continue;
        this.inputs.steps++;
        return { line, step };
      }
    } catch (cause) {
      if (!(cause instanceof Fault)) throw cause;
      this.failure = { line: lineOf(cause) ?? this.line, sentence: `${cause.message} ${cause.hint}` };
    }
    return undefined;
  }
}

const lineOf = (cause: Fault): number | undefined =>
  "line" in cause && typeof cause.line === "number" ? cause.line : undefined;

/**
 * The primitive steps of the imported program, each with the one after it where no decision lies between. It ends with
 * "left" where the program would go on: a loop without end, a wait that is not over.
 */
function* importedSteps(
  program: Program,
  inputs: TrialInputs,
  isEndless: boolean,
  waits: ReadonlySet<string>,
): Generator<readonly [PrimitiveStep, PrimitiveStep | undefined], "ended" | "left"> {
  const decide = (when: Predicate, variable: ExpressionValues["variable"]): boolean => holds(when, inputs, variable);
  const read = (signal: string): boolean | number => inputs.read(signal);
  let before: PrimitiveStep | undefined;
  let hasStopped = false;
  for (const happening of flow(program, { decide, read, ...(isEndless ? { rounds: ROUNDS } : {}) })) {
    if (happening.kind === "end") break;
    if (happening.kind === "passed" && happening.step.type !== "comment" && before !== undefined) {
      yield [before, undefined];
      before = undefined;
    }
    if (happening.kind !== "step") continue;
    const { step, stands } = happening;
    if (stands) {
      if (before !== undefined) yield [before, undefined];
      before = undefined;
      continue;
    }
    if (step.type === "wait-for" && waits.has(step.id)) {
      if (before !== undefined) yield [before, undefined];
      before = undefined;
      if (holds(step.when, inputs)) continue;
      return "left";
    }
    if (before !== undefined) yield [before, step];
    inputs.steps++;
    if (step.type === "set") inputs.write(step.signal, step.to);
    hasStopped = step.type === "stop";
    before = step;
  }
  if (before !== undefined) yield [before, undefined];
  return isEndless && !hasStopped ? "left" : "ended";
}

function conditionsOf(program: Program): Condition[] {
  const conditions: Condition[] = [];
  for (const step of everyStep(program)) {
    if ((step.type === "if" || step.type === "while" || step.type === "wait-for") && isCondition(step.when))
      conditions.push(step.when);
    if (step.type === "move" && step.until !== undefined) conditions.push(step.until.when);
  }
  return conditions;
}

const mm = (length_m: number): string => millimetres(length_m).toFixed(2);

/** A step with its numbers, for a sentence. */
export function spokenStep(step: Step): string {
  switch (step.type) {
    case "move": {
      const { target, speed } = step;
      const where =
        "q" in target
          ? `joints [${target.q.map(angle => degrees(angle).toFixed(2)).join(", ")}]°`
          : `[${target.pose.position.map(mm).join(", ")}] mm in frame “${target.frame}”`;
      const pace =
        "mps" in speed
          ? `${mm(speed.mps)} mm/s`
          : "ratio" in speed
            ? `${(speed.ratio * 100).toFixed(1)} % of full speed`
            : `${speed.time_s} s`;
      return `a ${step.path} move to ${where} at ${pace}`;
    }
    case "set":
      return `setting ${step.signal} to ${step.to}`;
    case "wait":
      return `a wait of ${step.s} s`;
    case "wait-for":
      return `a wait for ${JSON.stringify(step.when)}`;
    case "gripper":
      return `${step.closed ? "closing" : "opening"} the gripper`;
    case "message":
      return `the message “${step.text}”`;
    default:
      return `a ${step.type} step`;
  }
}
