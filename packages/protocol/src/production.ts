import {
  isBlock,
  listsOf,
  type CommandOutcome,
  type Program,
  type Refusal,
  type RobotCommander,
  type Step,
} from "@twincell/core";
import { DONE, refused } from "./outcome.ts";
import type { ServedConnection } from "./served.ts";

/** How a production stands, as everybody who looks is told. */
export interface ProductionState {
  readonly state: "running" | "held" | "ended";
  /** Cycles begun, from 1; of how many, null for until it is ended. */
  readonly cycle: number;
  readonly of: number | null;
  /** Name of the program of this cycle. */
  readonly program: string;
  /** The step it is in, or goes on with; "" where that is not known. */
  readonly step: string;
  /** Name of the program that takes over at the next cycle. */
  readonly next: string | null;
}
export interface ProductionOrder {
  readonly program: Program;
  readonly asText: boolean;
  readonly despite: readonly string[];
}
export interface ProductionOptions {
  readonly cycles: number | null;
  /** Ids of steps of the program's own list before which it is held. */
  readonly breakpoints: readonly string[];
  /** true: held before each step of that list. */
  readonly stepping: boolean;
}
export interface Production {
  readonly state: ProductionState;
  /** Resolves when the last cycle has ended, or with what ended it before. */
  run(): Promise<CommandOutcome>;
  /**
   * Another program from the next cycle on; judged now, from where the one before ends, and refused now. Resolves when
   * it has taken over.
   */
  replace(order: ProductionOrder): Promise<CommandOutcome>;
  /** Stops the robot and keeps the place: whoever has the lease may move it by hand, and hands back by `resume`. */
  hold(): CommandOutcome;
  /** Goes on from where the robot stands: with the step it was in, or with a cycle from its beginning. */
  resume(seat: RobotCommander, from: "step" | "cycle"): CommandOutcome;
  /** One step of the program's own list. */
  step(seat: RobotCommander): CommandOutcome;
  setBreakpoints(ids: readonly string[]): CommandOutcome;
  /** Somebody stopped the robot: a held production is over, a running one ends by the stop itself. */
  stopped(): void;
}

const STOPPED: Refusal = {
  code: "production.stopped",
  sentence: "The production was stopped while it was held.",
  hint: "Begin it again.",
};
/** Where a program of that order may be cut, or why it may not. */
function whyWhole({ program, asText }: ProductionOrder): Refusal | null {
  if (asText)
    return {
      code: "production.text",
      sentence: "It runs as text of the controller's own language, which has the place to itself.",
      hint: "Run it by steps, or resume with a cycle from its beginning.",
    };
  if (Object.keys(program.variables ?? {}).length > 0)
    return {
      code: "production.computes",
      sentence: "The program computes: what its variables are in the middle of a cycle is not known.",
      hint: "Resume with a cycle from its beginning.",
    };
  return null;
}
/**
 * Place in the program's own list of the step with that id, or of the block or call that it is in; −1 where none is.
 */
export function placeOf({ steps, routines }: Program, id: string): number {
  const has = (list: readonly Step[]): boolean =>
    list.some(
      step => step.id === id || listsOf(step).some(has) || (step.type === "call" && has(routines[step.routine] ?? [])),
    );
  return steps.findIndex(step => has([step]));
}
/** Why the step at that place is not gone on with in its middle, or null. */
function whyNotMiddle(step: Step | undefined, reached: string): Refusal | null {
  if (step === undefined || (!isBlock(step) && step.type !== "call") || step.id === reached || reached === "")
    return null;
  return {
    code: "production.block",
    sentence: `It was in the middle of the step “${step.id}”, which has steps of its own: how far it was is not known.`,
    hint: "Resume with a cycle from its beginning.",
  };
}

/**
 * A program that a station runs cycle after cycle. It belongs to the station: whoever has the lease may hand it back
 * after another took over.
 *
 * @param tell  told at each change.
 */
export function createProduction(
  station: ServedConnection,
  first: RobotCommander,
  begun: ProductionOrder,
  options: ProductionOptions,
  tell: (state: ProductionState) => void,
): Production {
  let seat = first;
  let order = begun;
  let { stepping } = options;
  let breakpoints = new Set(options.breakpoints);
  let waiting: { readonly order: ProductionOrder; readonly settle: (outcome: CommandOutcome) => void } | null = null;
  let cycle = 0;
  let at = 0;
  let reached = "";
  let holding = false;
  let state: ProductionState["state"] = "running";
  let go: ((ended: CommandOutcome | null) => void) | null = null;
  const now = (): ProductionState => ({
    state,
    cycle,
    of: options.cycles,
    program: order.program.name,
    step: order.program.steps[at]?.id ?? reached,
    next: waiting?.order.program.name ?? null,
  });
  const change = (to: ProductionState["state"]): void => {
    state = to;
    tell(now());
  };
  const off = station.onSample(({ step }) => {
    if (step !== "" && state === "running") reached = step;
  });

  /** The steps that are carried out next without being held in between. */
  function part(): readonly Step[] {
    const { steps } = order.program;
    if (stepping) return steps.slice(at, at + 1);
    const stop = steps.findIndex(({ id }, i) => i > at && breakpoints.has(id));
    return steps.slice(at, stop < 0 ? undefined : stop);
  }
  /** Waits until somebody hands it back; with what ends it, or null to go on. */
  async function held(): Promise<CommandOutcome | null> {
    holding = false;
    const going = new Promise<CommandOutcome | null>(resolve => {
      go = resolve;
    });
    change("held");
    const ended = await going;
    go = null;
    return ended;
  }
  async function oneCycle(): Promise<CommandOutcome> {
    const { program, asText, despite } = order;
    at = 0;
    if (breakpoints.has(program.steps[0]?.id ?? "") || stepping) {
      const ended = await held();
      if (ended) return ended;
    }
    while (at < program.steps.length) {
      change("running");
      const steps = part();
      reached = "";
      const whole = steps.length === program.steps.length;
      const outcome = await station.run(seat, whole ? program : { ...program, steps }, asText, despite);
      if (holding) {
        const place = reached === "" ? -1 : placeOf(program, reached);
        if (outcome.kind === "done") {
          at += steps.length;
          reached = "";
        }
        if (place >= 0 && outcome.kind !== "done") at = place;
        const ended = await held();
        if (ended) return ended;
        continue;
      }
      if (outcome.kind !== "done") return outcome;
      at += steps.length;
      reached = "";
      if (at >= program.steps.length) return DONE;
      const ended = await held();
      if (ended) return ended;
    }
    return DONE;
  }
  function takeOver(): void {
    if (!waiting) return;
    ({ order } = waiting);
    const { settle } = waiting;
    waiting = null;
    settle(DONE);
  }
  const notHeld = refused("production.not-held", "The production is not held.", "Hold it first.");

  return {
    get state() {
      return now();
    },
    async run() {
      let outcome: CommandOutcome = DONE;
      while (outcome.kind === "done" && (options.cycles === null || cycle < options.cycles)) {
        takeOver();
        cycle++;
        outcome = await oneCycle();
      }
      off();
      const late: Refusal = {
        code: "production.ended",
        sentence: "The production ended before its next cycle.",
        hint: "Begin it again with the new program.",
      };
      waiting?.settle({ kind: "refused", why: late });
      waiting = null;
      change("ended");
      return outcome;
    },
    async replace(next) {
      const why =
        (breakpoints.size > 0 || stepping ? whyWhole(next) : null) ??
        (await station.judge?.(next.program, next.asText, next.despite));
      if (why) return { kind: "refused", why };
      if (state === "ended")
        return refused("production.ended", "The production has ended.", "Begin it again with the new program.");
      waiting?.settle(refused("production.replaced", "Another program was given before its cycle came.", ""));
      return new Promise(settle => {
        waiting = { order: next, settle };
        tell(now());
      });
    },
    hold() {
      if (state === "ended") return DONE;
      // Held already: what a person moves by hand stops, and the place is kept.
      if (state === "running") holding = true;
      station.stop(false);
      return DONE;
    },
    resume(by, from) {
      if (!go) return notHeld;
      const why = from === "step" ? (whyWhole(order) ?? whyNotMiddle(order.program.steps[at], reached)) : null;
      if (why) return { kind: "refused", why };
      if (from === "cycle") {
        at = 0;
        reached = "";
      }
      seat = by;
      stepping = false;
      go(null);
      return DONE;
    },
    step(by) {
      if (!go) return notHeld;
      const why = whyWhole(order) ?? whyNotMiddle(order.program.steps[at], reached);
      if (why) return { kind: "refused", why };
      seat = by;
      stepping = true;
      go(null);
      return DONE;
    },
    setBreakpoints(ids) {
      const why = ids.length > 0 ? whyWhole(order) : null;
      if (why) return { kind: "refused", why };
      breakpoints = new Set(ids);
      return DONE;
    },
    stopped() {
      go?.({ kind: "stopped", why: STOPPED });
    },
  };
}
/** Why a production of that kind is not begun, or null. */
export const productionRefusal = (
  order: ProductionOrder,
  { breakpoints, stepping }: ProductionOptions,
): Refusal | null => (breakpoints.length > 0 || stepping ? whyWhole(order) : null);
