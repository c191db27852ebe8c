import { createGuard, createTwin, createVirtualController, textSteps, type Guard, type Twin, type VirtualController } from "@twincell/controllers";
import { linkSolids, pose, watchCell, type CommandOutcome, type Scheduler } from "@twincell/core";
import { dialectById } from "@twincell/languages";
import { cellGeometry, type CellDocument } from "@twincell/project";
import { createRunRecorder, type RunRecorder } from "@twincell/recording";
import { cellStore } from "../stores/cell.ts";
import { controlStore } from "../stores/control.ts";
import { programOf, robotOf, toolOf } from "../stores/document.ts";
import { historyStore, type RunRecord } from "../stores/history.ts";
import { notify } from "../stores/notices.ts";
import { playStore } from "../stores/play.ts";
import { postStore } from "../stores/post.ts";
import { runStore } from "../stores/run.ts";
import { sound } from "../stores/sound.ts";
import { words } from "../words/index.ts";
import { listRuns, openRunFile, type RunFile, type Shelf } from "./archive.ts";
import { showJoints, theLive } from "./live.ts";
import { leaveRobot, takeRobot } from "./owner.ts";

const TELL_EVERY_S = 0.1;
/** Nearest the guard looks for solids; contact is what it stops for. */
const CUTOFF_M = 0.05;

interface Session { readonly guard: Guard; readonly twin: Twin; readonly controller: VirtualController; readonly close: () => void }

/** Runs the exported text on a virtual controller behind a guard; the twin on screen mirrors it and everything is recorded. */
export interface RunSession {
  /** Resolves when the run is over, however it ended. */
  start(): Promise<void>;
  hold(held: boolean): void;
  stop(): void;
  reset(): void;
}

export function runSession(shelf: Shelf, scheduler: Scheduler, wallClock_ms: () => number): RunSession {
  let session: Session | null = null, count = 0;

  const stop = (): void => { session?.guard.stop(); };
  const applySpeed = (): void => { session?.twin.setSpeed(runStore.getState().held ? 0 : Math.round(playStore.getState().speed * 100)); };
  playStore.subscribe((now, before) => { if (now.speed !== before.speed) applySpeed(); });

  async function start(): Promise<void> {
    const { document } = cellStore.getState(), robot = robotOf(document), program = programOf(document), { emitted, dialect: dialectId } = postStore.getState();
    const dialect = dialectById(dialectId), file = emitted?.kind === "emitted" ? emitted.files[0] : undefined;
    if (session || !document || !robot || !program || !dialect || !file) return;
    const interpreted = dialect.interpret(file.text, robot, document.robot.worldFromBase);
    if (interpreted.kind === "not-understood") {
      const [fault] = interpreted.faults;
      notify("bad", `${words.run.notUnderstood} ${fault ? words.export.line(fault.line, fault.column, fault.sentence) : ""}`);
      return;
    }
    const text = textSteps(interpreted.run), stepOfLine = file.lines;
    session = open(document, scheduler);
    const { twin, guard } = session, started_ms = wallClock_ms(), id = `${started_ms}-${++count}`, record = recorder(shelf, id, document, program.name, started_ms);
    const began_s = scheduler.now_s();
    let told_s = -Infinity, line = 0, least_s = Infinity;
    const unsubscribe = twin.onSample(sample => {
      record.recorder.record(sample);
      const now_s = scheduler.now_s(), late_s = now_s - sample.time_s;
      least_s = Math.min(least_s, late_s);
      const nowLine = text.lineOf(sample.step), changed = nowLine !== line;
      if (!changed && now_s - told_s < TELL_EVERY_S) return;
      told_s = now_s; line = nowLine;
      controlStore.setState({ step: stepOfLine[nowLine - 1] ?? "", line: nowLine, mode: sample.mode, safety: sample.safety, latency_ms: Math.max(0, late_s - least_s) * 1000, twinError_rad: twin.accuracy.mirror_rad, message: sample.message });
      runStore.setState({ elapsed_s: now_s - began_s, gripperClosed: sample.gripperClosed });
    });
    const heard = guard.onNotice(why => { record.recorder.event(why.code, why.sentence, "warning"); });
    takeRobot("run", stop);
    controlStore.setState({ controller: words.run.virtual(robot.name), running: true, step: "", line: 0, twinError_rad: 0, message: "" });
    runStore.setState({ phase: "running", held: false, elapsed_s: 0, ending: "", good: true, recording: id });
    record.recorder.event("run", words.run.event.start(program.name));
    applySpeed();
    let outcome: CommandOutcome;
    try {
      outcome = await twin.run(text.steps, interpreted.context);
    } catch (trouble) {
      outcome = { kind: "stopped", why: { code: "run.trouble", sentence: trouble instanceof Error ? trouble.message : String(trouble), hint: "" } };
    }
    unsubscribe(); heard();
    const duration_s = scheduler.now_s() - began_s, ending = sentenceOf(outcome, duration_s);
    record.recorder.event("run", ending, outcome.kind === "done" ? "info" : "error");
    controlStore.setState({ running: false, step: "", line: 0, twinError_rad: twin.accuracy.mirror_rad, safety: "normal", message: outcome.kind === "done" ? "" : ending });
    runStore.setState({ phase: "ended", held: false, elapsed_s: duration_s, ending, good: outcome.kind === "done" });
    sound(outcome.kind === "done" ? "done" : "limit");
    notify(outcome.kind === "done" ? "done" : "bad", ending, outcome.kind === "done" ? words.run.kept : outcome.why.hint || undefined);
    leaveRobot("run");
    session.close();
    session = null;
    await record.finish(outcome.kind, duration_s);
    historyStore.setState({ runs: await listRuns(shelf) });
  }

  return {
    start,
    hold(held) { if (session) { runStore.setState({ held }); applySpeed(); } },
    stop,
    reset() { session?.twin.reset(); controlStore.setState({ safety: "normal", message: "" }); },
  };
}

function open(document: CellDocument, scheduler: Scheduler): Session {
  const robot = robotOf(document)!, flangeFromTcp = toolOf(document)?.flangeFromTcp ?? pose<"flange", "tcp">(), { worldFromBase } = document.robot;
  const controller = createVirtualController({ robot, scheduler, start_rad: Float64Array.from(theLive().q_rad), worldFromBase, name: words.run.virtual(robot.name) });
  const look = watchCell({ geometry: cellGeometry(document, linkSolids(robot)), arm: robot.arm, flangeFromTcp, free_rad: robot.home_rad, cutoff_m: CUTOFF_M });
  const guard = createGuard({ controller, scheduler, deadMan: false, flangeFromTcp, brakingTime_s: controller.brakingTime_s, isSafe: q_rad => look(q_rad).contacts.length === 0 });
  const seat = guard.seat(words.control.you);
  seat.take();
  const twin = createTwin({
    real: seat.robot, scheduler, name: words.run.twin,
    mirror: { show: sample => showJoints(sample.q_rad), read: out => { out.set(theLive().q_rad); return out; } },
  });
  return { guard, twin, controller, close: () => { seat.release(); twin.close(); guard.close(); controller.close(); } };
}

interface Recording { readonly recorder: RunRecorder; readonly finish: (outcome: CommandOutcome["kind"], duration_s: number) => Promise<void> }
function recorder(shelf: Shelf, id: string, document: CellDocument, program: string, started_ms: number): Recording {
  const file: RunFile = openRunFile(shelf, id), name = words.history.name(program, historyStore.getState().runs.length + 1), startedAt = new Date(started_ms).toISOString();
  const note = (ending: RunRecord["ending"], duration_s: number): void => file.note({ id, name, startedAt, duration_s, bytes: file.sink.position, ending });
  const made = createRunRecorder(file.sink, { robot: robotOf(document)!, startedAt_ns: BigInt(started_ms) * 1_000_000n, program, cell: document.name });
  note("running", 0);
  return {
    recorder: made,
    async finish(outcome, duration_s) {
      made.finish();
      note(outcome, duration_s);
      const trouble = await file.settled();
      const sentence = trouble ?? made.problem?.sentence;
      if (sentence) notify("bad", sentence, words.history.fullHint);
    },
  };
}

function sentenceOf(outcome: CommandOutcome, duration_s: number): string {
  switch (outcome.kind) {
    case "done": return words.run.done(duration_s.toFixed(1));
    case "refused": return words.run.refused(outcome.why.sentence);
    case "stopped": return words.run.stopped(outcome.why.sentence);
  }
}
