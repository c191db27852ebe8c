import { linesOf } from "../program/expression/expression.ts";
import { expressionsOf, isCondition } from "../program/predicate.ts";
import type { Condition, Predicate, Program, Step } from "../program/program.ts";
import type { Repair } from "./verdict.ts";
import { everyStep } from "../program/walk.ts";
import { startOf, type CheckScene } from "./scene.ts";

/** What a step does with a signal. */
interface Use {
  readonly signal: string;
  readonly writes: boolean;
  readonly analogue: boolean;
  readonly renamed: (signal: string) => Step;
}

/** More names than this to choose from help nobody. */
const MOST_NAMES = 3;

/** Signals that do not exist, inputs that are written, and levels of lines that are on or off. */
export function checkSignals(scene: CheckScene): void {
  const { signals } = scene.program;
  for (const step of everyStep(scene.program)) {
    for (const signal of unknownLines(step, signals))
      scene.add(step.id, "bad", {
        code: "signals.unknown",
        value: 0,
        limit: 0,
        unit: "1",
        at_s: startOf(scene, step.id),
        sentence: `The program has no signal “${signal}”.`,
        repairs: [],
      });
    const use = useOf(step);
    if (use === undefined) continue;
    const line = Object.hasOwn(signals, use.signal) ? signals[use.signal]! : undefined;
    const sort = use.analogue ? "analogue" : "digital";
    const add = (code: string, sentence: string): void => {
      scene.add(step.id, "bad", {
        code,
        value: 0,
        limit: 0,
        unit: "1",
        at_s: startOf(scene, step.id),
        sentence,
        repairs: others(signals, use),
      });
    };
    if (line === undefined) add("signals.unknown", `The program has no signal “${use.signal}”.`);
    else if (use.writes && line.kind.endsWith("-in"))
      add("signals.input-written", `“${use.signal}” is an input; only outputs can be set.`);
    else if (!line.kind.startsWith(sort))
      add(
        "signals.kind",
        use.analogue
          ? `“${use.signal}” is a digital signal; it is on or off and has no level.`
          : `“${use.signal}” is an analogue signal; it has a level and is not on or off.`,
      );
  }
}

function useOf(step: Step): Use | undefined {
  switch (step.type) {
    case "set":
      return {
        signal: step.signal,
        writes: true,
        analogue: typeof step.to === "number",
        renamed: signal => ({ ...step, signal }),
      };
    case "wait-for":
      return used(step.when, when => ({ ...step, when }));
    case "if":
      return used(step.when, when => ({ ...step, when }));
    case "while":
      return used(step.when, when => ({ ...step, when }));
    case "move": {
      const { until } = step;
      return until === undefined
        ? undefined
        : {
            ...read(until.when),
            renamed: signal => ({ ...step, until: { ...until, when: { ...until.when, signal } } }),
          };
    }
    default:
      return undefined;
  }
}

/** Lines of an expression that do not exist: its kinds are checked where it is read. */
function* unknownLines(step: Step, signals: Program["signals"]): Generator<string, void> {
  if ("when" in step && isCondition(step.when)) return;
  for (const expression of expressionsOf(step))
    for (const signal of linesOf(expression)) if (!Object.hasOwn(signals, signal)) yield signal;
}

const used = (when: Predicate, changed: (when: Condition) => Step): Use | undefined =>
  isCondition(when) ? { ...read(when), renamed: signal => changed({ ...when, signal }) } : undefined;

const read = (when: Condition): Omit<Use, "renamed"> => ({
  signal: when.signal,
  writes: false,
  analogue: !("is" in when),
});

/** The same with a signal that would do. */
function others(signals: Program["signals"], { signal, writes, analogue, renamed }: Use): Repair[] {
  const fits = Object.entries(signals).filter(
    ([name, { kind }]) =>
      name !== signal && kind.startsWith(analogue ? "analogue" : "digital") && !(writes && kind.endsWith("-in")),
  );
  return fits.slice(0, MOST_NAMES).map(([name]) => ({ sentence: `Use “${name}”.`, replace: renamed(name) }));
}
