import {
  Fault,
  type CommandOutcome,
  type Dialect,
  type Executed,
  type Pose,
  type Refusal,
  type Robot,
  type Step,
  type TextFault,
} from "@twincell/core";
import type { CellControl, RunSession } from "./run.ts";

export interface TextRunSetting {
  readonly robot: Robot;
  readonly worldFromBase: Pose<"world", "base">;
  readonly name: string;
  readonly cellName: string;
  readonly skipUnknown?: boolean;
}
export type TextRunState = { readonly phase: "idle" | "running" | "paused"; readonly line: number };
/** How a text ended: as a controller ends, or by what could not be executed in it. */
export type TextEnding =
  | CommandOutcome
  | { readonly kind: "fault"; readonly line: number; readonly sentence: string; readonly hint: string };

/** A text under way on the controller, statement by statement. */
export interface TextRun {
  /** Runs on to the next breakpoint, from the beginning or from where it stands. Resolves when it stands again. */
  run(): Promise<void>;
  /** Executes one statement. */
  step(): Promise<void>;
  stop(): void;
}

/** So many statements without motion take one cycle of a controller: a text that only counts does not stop the page. */
const IDLE_LINES = 200;
const CYCLE_S = 0.004;
const STOPPED: Refusal = {
  code: "run.stopped",
  sentence: "The text was stopped.",
  hint: "Run it again from its beginning.",
};

/**
 * Interprets a text and carries it out in parts: a part ends before a line with a breakpoint, or after one statement.
 * Each statement is interpreted when the robot is there, so decisions see the signals of that moment.
 *
 * @param breakpoints  asked before every statement. @param tell  called when phase or line change. @param ended  called
 *   once.
 */
export function textRun(
  control: Pick<CellControl, "begin" | "signals" | "stop">,
  dialect: Pick<Dialect, "interpret">,
  text: string,
  setting: TextRunSetting,
  breakpoints: () => ReadonlySet<number>,
  tell: (state: TextRunState) => void,
  ended: (ending: TextEnding) => void,
): TextRun | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] } {
  const interpreted = dialect.interpret(text, setting.robot, setting.worldFromBase, {
    skipUnknown: setting.skipUnknown ?? false,
  });
  if (interpreted.kind === "not-understood") return interpreted;
  const statements: Iterator<Executed, void> = interpreted.run(control.signals);
  const { context } = interpreted;
  let session: RunSession | null = null;
  let next: Executed | undefined;
  let over = false;
  let running = false;
  let line = 0;
  let problem: Fault | undefined;

  const take = (): Executed | undefined => {
    const held = next;
    next = undefined;
    if (held) return held;
    try {
      const answer = statements.next();
      if (answer.done !== true) return answer.value;
    } catch (cause) {
      if (!(cause instanceof Fault)) throw cause;
      problem = cause;
    }
    over = true;
    return undefined;
  };

  function* part(single: boolean, goesOn: boolean, on: RunSession): Generator<Step, void> {
    for (let done = 0; ; done++) {
      const statement = take();
      if (!statement) return;
      if ((done > 0 && single) || ((done > 0 || !goesOn) && !single && breakpoints().has(statement.line))) {
        next = statement;
        return;
      }
      line = statement.line;
      const step: Step | undefined =
        statement.step ?? (done % IDLE_LINES === IDLE_LINES - 1 ? { id: "", type: "wait", s: CYCLE_S } : undefined);
      if (!step) continue;
      const named: Step = step.id === "" ? { ...step, id: `line ${line}` } : step;
      on.onLine(named.id, line);
      yield named;
    }
  }

  async function finish(ending: TextEnding): Promise<void> {
    const closing = session;
    session = null;
    over = true;
    tell({ phase: "idle", line: 0 });
    await closing?.end(
      ending.kind === "fault"
        ? { kind: "stopped", why: { code: "run.fault", sentence: ending.sentence, hint: ending.hint } }
        : ending,
    );
    ended(ending);
  }

  async function go(single: boolean): Promise<void> {
    if (running || (over && session === null)) return;
    const goesOn = session !== null;
    if (session === null) {
      const begun = control.begin(setting.name, setting.cellName);
      if ("kind" in begun) {
        over = true;
        ended(begun);
        return;
      }
      session = begun;
    }
    running = true;
    tell({ phase: "running", line });
    const outcome = await session.part(part(single, goesOn, session), context);
    running = false;
    if (problem) await finish({ kind: "fault", line, sentence: problem.message, hint: problem.hint });
    else if (outcome.kind !== "done" || over) await finish(outcome);
    else tell({ phase: "paused", line: next?.line ?? line });
  }

  return {
    run: () => go(false),
    step: () => go(true),
    stop() {
      if (running) control.stop();
      else if (session) void finish({ kind: "stopped", why: STOPPED });
    },
  };
}
