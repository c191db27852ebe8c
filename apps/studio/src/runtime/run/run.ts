import {
  createGuard,
  createTwin,
  createVirtualController,
  textSteps,
  type Guard,
  type Twin,
  type VirtualController,
} from "@twincell/controllers";
import {
  unrolled,
  withPredicateLines,
  type CommandOutcome,
  type Dialect,
  type EmittedFile,
  type Pose,
  type Program,
  type Refusal,
  type Robot,
  type Scheduler,
  type Signals,
  type Step,
} from "@twincell/core";
import { createRunRecorder, latencyMeter, type RunRecorder } from "@twincell/recording";
import { words } from "../../messages/index.ts";
import { controlStore } from "../../stores/control.ts";
import { historyStore, type RunEnding } from "../../stores/history.ts";
import { shortName } from "../../stores/robot.ts";
import { listRuns, openRunFile, type RunFile, type RunStorage } from "../history/archive.ts";
import { restoreSignals, stepsFrom, type Branch } from "../history/fork.ts";
import { linkMeter } from "./link-meter.ts";
import { showJoints, theLive } from "../live.ts";
import type { Written } from "./written-program.ts";

/** What a run needs to know of the cell. */
export interface RunSetting {
  readonly robot: Robot;
  readonly worldFromBase: Pose<"world", "base">;
  readonly flangeFromTcp: Pose<"flange", "tcp">;
  /** Whether nothing touches at those joint angles; the guard asks along the motion (rows T-42 … T-44). */
  readonly isSafe?: (q_rad: Float64Array) => boolean;
}

export interface RunWorld {
  /** The language programs are run in; null when none speaks for the robot: then the steps themselves run. */
  readonly dialect: () => Dialect | null;
  /** Writes a program in that language, away from the page. */
  readonly write: (program: Program) => Promise<Written>;
  readonly scheduler: Scheduler;
  readonly shelf: RunStorage;
  /** Wall clock, milliseconds since 1970. */
  readonly clock_ms: () => number;
  /** Which cell a run is recorded of; left out where there is only one. */
  readonly cellVersion?: () => string;
  /** Whether another controller is the one of the robot on screen, so that only a run of this one is told of. */
  readonly elsewhere?: () => boolean;
}

/** What runs: a text of which each line came from a step, or with no text the steps themselves. */
export type Prepared =
  | {
      readonly kind: "ready";
      readonly file: EmittedFile | null;
      readonly steps: () => Iterable<Step>;
      readonly context: Pick<Program, "tools" | "frames">;
    }
  | { readonly kind: "not-emitted" | "not-understood"; readonly sentence: string; readonly hint: string };

const TELL_EVERY_S = 0.1;

/**
 * Interprets the very text that was written, and gives the steps it amounts to. A step of the text keeps the id of the
 * program step its line was written for, so that screen and recording speak of the same thing.
 */
export function prepareRun(
  dialect: Dialect | null,
  { program, emitted }: Written,
  { robot, worldFromBase }: Pick<RunSetting, "robot" | "worldFromBase">,
  onLine: (step: string, line: number) => void,
  signals?: Signals,
): Prepared {
  if (dialect === null || emitted === null) {
    const alone = function* (): Generator<Step> {
      for (const step of unrolled(program, signals)) {
        onLine(step.id, 0);
        yield step;
      }
    };
    return { kind: "ready", file: null, steps: alone, context: program };
  }
  if (emitted.kind === "cannot") return { kind: "not-emitted", sentence: emitted.sentence, hint: emitted.hint };
  const file = dialect.runnable?.(emitted.files) ?? emitted.files[0]!;
  const interpreted = dialect.interpret(file.text, robot, worldFromBase);
  if (interpreted.kind === "not-understood") {
    const [first] = interpreted.faults;
    return {
      kind: "not-understood",
      sentence: first ? words.export.line(first.line, first.column, first.sentence) : "",
      hint: "Export the text and look at that line.",
    };
  }
  const called = programNames(program.signals, interpreted.context.signals ?? {});
  const read: Signals | undefined = signals && {
    read: signal => signals.read(called(signal)),
    write: (signal, value) => {
      signals.write(called(signal), value);
    },
  };
  const text = textSteps(() => interpreted.run(read));
  function* steps(): Generator<Step> {
    for (const step of text.steps) {
      const line = text.lineOf(step.id);
      const id = file.lines[line - 1] || step.id;
      onLine(id, line);
      yield { ...withSignals(step, called), id };
    }
  }
  return { kind: "ready", file, steps, context: interpreted.context };
}

/** What the program calls a line that the text has its own name for: both know its number. */
function programNames(mine: Program["signals"], theirs: Program["signals"]): (signal: string) => string {
  const byNumber = new Map(Object.entries(mine).map(([name, { address }]) => [address, name]));
  return signal => {
    const address = theirs[signal]?.address;
    return (address === undefined ? undefined : byNumber.get(address)) ?? signal;
  };
}
const sameLines = (a: ReadonlyMap<string, boolean | number>, b: ReadonlyMap<string, boolean | number>): boolean =>
  a.size === b.size && [...a].every(([name, value]) => b.get(name) === value);
function withSignals(step: Step, called: (signal: string) => string): Step {
  if (step.type === "set") return { ...step, signal: called(step.signal) };
  return step.type === "wait-for" ? { ...step, when: withPredicateLines(step.when, called) } : step;
}

/** A run under way. */
export interface RunSession {
  /** Carries out these steps; resolves when the robot stands. */
  part(steps: Iterable<Step>, context: Pick<Program, "tools" | "frames">): Promise<CommandOutcome>;
  /** The line a step came from is shown while it runs. */
  onLine(step: string, line: number): void;
  /** Ends the recording. */
  end(outcome: CommandOutcome): Promise<void>;
}

/** The virtual controller of the page, its guard and its twin, for as long as the cell is open. */
export interface CellControl {
  /**
   * Carries out the program's exported text. Resolves when it is done, stopped or refused.
   *
   * @param from  a past instant to go on from; the robot on screen stands there already.
   */
  run(
    program: Program,
    cellName: string,
    from?: Branch,
  ): Promise<CommandOutcome | Exclude<Prepared, { kind: "ready" }>>;
  /**
   * Begins a run that is handed over in parts, one after the other: a text with breakpoints. Refused while one is under
   * way.
   */
  begin(program: string, cellName: string): RunSession | Exclude<CommandOutcome, { kind: "done" }>;
  stop(emergency?: boolean): void;
  reset(): Promise<CommandOutcome>;
  /** 0 … 1; 0 holds. */
  setOverride(part: number): CommandOutcome;
  /** The mode switch at the robot. */
  setMode(mode: "manual" | "automatic"): void;
  readonly twin: Twin;
  readonly guard: Guard;
  /** The lines in and out of the virtual controller. */
  readonly signals: Signals;
  /** What is connected to an input says this from now on. */
  setInput(signal: string, value: boolean | number): void;
  close(): void;
}

const UNDER_WAY: Refusal = {
  code: "run.under-way",
  sentence: "A run is under way.",
  hint: "Stop it first, or wait until it is done.",
};
const NOT_BEGUN: Refusal = {
  code: "run.stopped",
  sentence: "The run was stopped before it began.",
  hint: "Run it again when the way is clear.",
};
/**
 * Robot and guard share the page: one that draws slowly is late with both, and there is no link between them to lose.
 */
const PAGE_SILENCE_S = Infinity;

export function controlCell(world: RunWorld, { robot, worldFromBase, flangeFromTcp, isSafe }: RunSetting): CellControl {
  const { scheduler } = world;
  const begun_s = scheduler.now_s();
  const virtual: VirtualController = createVirtualController({
    robot,
    scheduler,
    name: words.connection.chip(shortName(robot), true),
    worldFromBase,
    start_rad: theLive().q_rad,
  });
  const guard = createGuard({
    controller: virtual,
    scheduler,
    flangeFromTcp,
    brakingTime_s: virtual.brakingTime_s,
    silence_s: PAGE_SILENCE_S,
    ...(isSafe ? { isSafe } : {}),
  });
  const commander = guard.seat("you");
  commander.acquireLease();
  let running = false;
  let starting: object | null = null;
  let told_s = -1;
  let recorder: RunRecorder | null = null;
  const lines = new Map<string, number>();
  const late = latencyMeter("sample to picture", "from-robot");
  /** What a person did, as the recording keeps it. */
  const did = (action: string, detail: string): void => {
    recorder?.note("operator", { who: "you", action, detail });
  };
  const twin = createTwin({
    real: commander.robot,
    scheduler,
    mirror: {
      // Jogging and playback move the robot on screen too; the twin shows it only while it is the one that runs.
      show: sample => {
        if (!running) return;
        showJoints(sample.q_rad);
        const late_ms = (scheduler.now_s() - begun_s - sample.time_s) * 1000;
        linkMeter.add(sample.sequence, late_ms);
        late.add(Math.max(0, late_ms));
      },
      read: out => {
        out.set(running ? theLive().q_rad : virtual.jointAngles());
        return out;
      },
    },
  });

  const off = twin.onSample(sample => {
    recorder?.record(sample);
    const lateness = recorder ? late.due(scheduler.now_s()) : null;
    if (lateness) recorder?.note("latency", lateness);
    if (!running && world.elsewhere?.()) return;
    const now_s = scheduler.now_s();
    const known = controlStore.getState();
    const urgent =
      sample.safety !== known.safety ||
      sample.mode !== known.mode ||
      (running && sample.step !== known.step && sample.step !== "");
    if (!urgent && now_s - told_s < TELL_EVERY_S) return;
    told_s = now_s;
    const { signals } = known;
    const said = sample.signals;
    const { mirror_rad, command_rad } = twin.accuracy;
    controlStore.setState({
      mode: sample.mode,
      safety: sample.safety,
      step: sample.step,
      line: lines.get(sample.step) ?? 0,
      message: sample.message,
      signals: said === undefined || sameLines(said, signals) ? signals : new Map(said),
      latency_ms: Math.max(0, (now_s - begun_s - sample.time_s) * 1000),
      twinError_rad: Math.max(mirror_rad, command_rad),
    });
  });
  const offNotice = guard.onNotice(why => {
    recorder?.event(why.code, why.sentence, "warning");
    controlStore.setState({ message: why.sentence });
  });
  controlStore.setState({
    controller: virtual.name,
    running: false,
    message: "",
    safety: "normal",
    mode: "automatic",
    line: 0,
    step: "",
  });

  async function run(
    program: Program,
    cellName: string,
    from?: Branch,
  ): Promise<CommandOutcome | Exclude<Prepared, { kind: "ready" }>> {
    if (starting || running) return { kind: "refused", why: UNDER_WAY };
    const mine = (starting = {});
    const dialect = world.dialect();
    controlStore.setState({ running: true, message: "" });
    const notBegun = <T>(how: T): T => {
      starting = null;
      controlStore.setState({ running: false });
      return how;
    };
    const written = await world
      .write(program)
      .catch((problem: unknown) => (problem instanceof Error ? problem.message : String(problem)));
    // Whoever pressed stop meanwhile has stopped this run.
    if (starting !== mine) {
      if (starting === null) controlStore.setState({ running: false });
      return { kind: "stopped", why: NOT_BEGUN };
    }
    if (typeof written === "string")
      return notBegun({ kind: "not-emitted", sentence: written, hint: "Try it again, or choose another language." });
    const prepared = prepareRun(
      dialect,
      written,
      { robot, worldFromBase },
      (step, line) => lines.set(step, line),
      virtual.signals,
    );
    if (prepared.kind !== "ready") return notBegun(prepared);
    const session = begin(program.name, cellName);
    if ("kind" in session) return notBegun(session);
    starting = null;
    if (from) restoreSignals(from, program, virtual.signals, virtual.atTheRobot.setInput);
    const outcome = await session.part(from ? stepsFrom(prepared.steps(), from) : prepared.steps(), prepared.context);
    await session.end(outcome);
    return outcome;
  }

  function begin(program: string, cellName: string): RunSession | Exclude<CommandOutcome, { kind: "done" }> {
    lines.clear();
    // A virtual robot may jump (row T-18): it starts from where the robot on screen stands.
    const jumped = virtual.jumpTo(theLive().q_rad);
    if (jumped.kind !== "done") return jumped;
    guard.jumped();

    const startedAt = new Date(world.clock_ms());
    const id = startedAt.toISOString().replace(/[:.]/g, "-");
    const file = openRunFile(world.shelf, id);
    const name = `${cellName} · ${program}`;
    recorder = createRunRecorder(file.sink, {
      robot,
      startedAt_ns: BigInt(startedAt.getTime()) * 1_000_000n,
      program,
      cell: cellName,
      chunk_s: 0.5,
    });
    const from_s = scheduler.now_s();
    const note = (ending: RunEnding): void => {
      file.note({
        id,
        name,
        startedAt: startedAt.toISOString(),
        duration_s: scheduler.now_s() - from_s,
        bytes: file.sink.position,
        ending,
      });
    };
    note("running");
    recorder.note("cell", { name: cellName, version: world.cellVersion?.() ?? "" });
    recorder.event("run", `The run of ${program} began.`);
    running = true;
    twin.clearLog();
    linkMeter.reset();
    controlStore.setState({ running: true, twinError_rad: 0 });
    return {
      part: (steps, context) => twin.run(steps, context),
      onLine: (step, line) => {
        lines.set(step, line);
      },
      async end(outcome) {
        running = false;
        await endRecording(file, outcome, note);
        controlStore.setState({ running: false, message: outcome.kind === "done" ? "" : outcome.why.sentence });
      },
    };
  }

  async function endRecording(
    file: RunFile,
    outcome: CommandOutcome,
    note: (ending: RunEnding) => void,
  ): Promise<void> {
    const done = recorder!;
    recorder = null;
    done.note("command", {
      name: "run",
      by: "you",
      outcome: outcome.kind,
      sentence: outcome.kind === "done" ? "" : outcome.why.sentence,
      target: [],
    });
    done.event(
      outcome.kind,
      outcome.kind === "done" ? "The run is done." : outcome.why.sentence,
      outcome.kind === "done" ? "info" : "warning",
    );
    done.finish();
    note(outcome.kind);
    const problem = (await file.settled()) ?? done.problem?.sentence ?? null;
    if (problem !== null) controlStore.setState({ message: problem });
    historyStore.setState({ runs: await listRuns(world.shelf) });
  }

  return {
    run,
    begin,
    twin,
    guard,
    signals: virtual.signals,
    setInput: (signal, value) => {
      did("input", `${signal} = ${value}`);
      virtual.atTheRobot.setInput(signal, value);
    },
    stop(emergency = false) {
      did(emergency ? "emergency-stop" : "stop", "");
      starting = null;
      guard.stop(emergency);
    },
    reset: () => commander.robot.reset(),
    setOverride: part => {
      did("speed", `${Math.round(100 * part)} %`);
      return twin.setSpeed(Math.round(Math.min(1, Math.max(0, part)) * 100));
    },
    setMode: mode => {
      did("mode", mode);
      virtual.atTheRobot.setMode(mode);
    },
    close() {
      off();
      offNotice();
      guard.close();
      twin.close();
      virtual.close();
    },
  };
}
