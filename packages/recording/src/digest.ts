import type { Note } from "./notes.ts";
import type { EventLevel, RobotState } from "./state.ts";

/** A moment worth jumping to. */
export interface Mark {
  readonly at_s: number;
  readonly kind: "event" | "alarm" | "operator";
  readonly level: EventLevel;
  readonly code: string;
  readonly sentence: string;
}
/** From the start of a program to the next start, or to its end. A negative start lies in the file before. */
export interface Cycle {
  readonly from_s: number;
  readonly to_s: number;
  readonly ending: "again" | "done" | "stopped" | "refused" | "open";
}
/** One minute of one robot, summed up. Lists count the joints; an empty list is “not reported”. */
export interface Minute {
  /** Which minute since the start of the file: 0 is the first. */
  readonly minute: number;
  readonly recorded_s: number;
  readonly moving_s: number;
  /** Time in which the safety state was not normal. */
  readonly stopped_s: number;
  /** Σ|Δq| of each joint [rad, or m of a joint that slides]. */
  readonly travel: readonly number[];
  readonly torque_Nm: readonly number[];
  readonly current_A: readonly number[];
  readonly temperature_C: readonly number[];
}
export interface Digest {
  readonly marks: readonly Mark[];
  /** Marks beyond the most that one file lists. */
  readonly marksLeftOut: number;
  readonly cycles: readonly Cycle[];
  readonly minutes: readonly Minute[];
}

const MOST_MARKS = 5000;
/** Samples further apart than this are a gap in the recording, not a time that was seen. */
const GAP_S = 1.5;

/**
 * Sums up a stream of samples, events and notes as they pass; times count from the start of the file and never fall.
 */
export interface Digester {
  sample(at_s: number, q: ArrayLike<number>, state: Pick<RobotState, "moving" | "safety" | "step">): void;
  event(at_s: number, code: string, level: EventLevel, sentence: string): void;
  note(note: Note): void;
  result(): Digest;
  /** The cycle that is under way, for the file that follows. */
  readonly open: OpenCycle | null;
}
export interface OpenCycle {
  readonly from_s: number;
  readonly firstStep: string;
  readonly lastStep: string;
  readonly byStep: boolean;
}

class Mean {
  sums: number[] = [];
  count = 0;
  add(values: readonly number[]): void {
    if (values.length === 0) return;
    if (this.sums.length !== values.length) {
      this.sums = values.map(() => 0);
      this.count = 0;
    }
    for (let i = 0; i < values.length; i++) this.sums[i]! += Math.abs(values[i]!);
    this.count++;
  }
  take(): number[] {
    const means = this.count === 0 ? [] : this.sums.map(sum => rounded(sum / this.count, 4));
    this.sums = [];
    this.count = 0;
    return means;
  }
}
const rounded = (value: number, digits: number): number => Number(value.toFixed(digits));

export function createDigester(joints: number, carried: OpenCycle | null = null): Digester {
  const marks: Mark[] = [];
  const cycles: Cycle[] = [];
  const minutes: Minute[] = [];
  const torque = new Mean();
  const current = new Mean();
  const temperature = new Mean();
  const last = new Float64Array(joints);
  let travel = new Float64Array(joints);
  let last_s = NaN;
  let minute = -1;
  let recorded_s = 0;
  let moving_s = 0;
  let stopped_s = 0;
  let marksLeftOut = 0;
  let open: OpenCycle | null = carried;
  let step = carried?.lastStep ?? "";

  function mark(at: Mark): void {
    if (marks.length < MOST_MARKS) marks.push(at);
    else marksLeftOut++;
  }
  function closeMinute(): void {
    if (minute < 0) return;
    minutes.push({
      minute,
      recorded_s: rounded(recorded_s, 3),
      moving_s: rounded(moving_s, 3),
      stopped_s: rounded(stopped_s, 3),
      travel: Array.from(travel, each => rounded(each, 6)),
      torque_Nm: torque.take(),
      current_A: current.take(),
      temperature_C: temperature.take(),
    });
    recorded_s = moving_s = stopped_s = 0;
    travel = new Float64Array(joints);
  }
  function turnTo(at_s: number): void {
    const now = Math.floor(at_s / 60);
    if (now === minute) return;
    closeMinute();
    minute = now;
  }
  function close(at_s: number, ending: Cycle["ending"]): void {
    if (open) cycles.push({ from_s: rounded(open.from_s, 6), to_s: rounded(at_s, 6), ending });
    open = null;
  }
  function stepTo(at_s: number, next: string): void {
    if (next === "") {
      if (open?.byStep) close(at_s, "done");
    } else if (!open) open = { from_s: at_s, firstStep: next, lastStep: next, byStep: true };
    else if (open.firstStep === "") open = { ...open, firstStep: next };
    else if (next === open.firstStep && step !== "") {
      const { byStep } = open;
      close(at_s, "again");
      open = { from_s: at_s, firstStep: next, lastStep: next, byStep };
    }
    step = next;
  }

  return {
    get open() {
      return open && { ...open, lastStep: step };
    },
    sample(at_s, q, state) {
      turnTo(at_s);
      const dt_s = at_s - last_s;
      if (dt_s >= 0 && dt_s <= GAP_S) {
        recorded_s += dt_s;
        if (state.moving) moving_s += dt_s;
        if (state.safety !== "normal") stopped_s += dt_s;
        for (let i = 0; i < joints; i++) travel[i]! += Math.abs(q[i]! - last[i]!);
      }
      for (let i = 0; i < joints; i++) last[i] = q[i]!;
      last_s = at_s;
      if (state.step !== step) stepTo(at_s, state.step);
    },
    event(at_s, code, level, sentence) {
      mark({ at_s, kind: "event", level, code, sentence });
      if (code === "run") {
        close(at_s, "again");
        open = { from_s: at_s, firstStep: "", lastStep: "", byStep: false };
      } else if (code === "done" || code === "stopped" || code === "refused") close(at_s, code);
    },
    note(note) {
      if (note.kind === "alarm" && note.active)
        mark({ at_s: note.at_s, kind: "alarm", level: "error", code: note.code, sentence: note.sentence });
      else if (note.kind === "operator")
        mark({ at_s: note.at_s, kind: "operator", level: "info", code: note.action, sentence: note.detail });
      else if (note.kind === "command" && note.outcome !== "sent")
        mark({
          at_s: note.at_s,
          kind: "operator",
          level: note.outcome === "done" ? "info" : "warning",
          code: note.name,
          sentence: [note.by, note.outcome, note.sentence].filter(part => part !== "").join(", "),
        });
      else if (note.kind === "load") {
        turnTo(note.at_s);
        torque.add(note.torque_Nm);
        current.add(note.current_A);
        temperature.add(note.temperature_C);
      }
    },
    result() {
      closeMinute();
      minute = -1;
      const still = open;
      if (still) close(Math.max(still.from_s, Number.isNaN(last_s) ? still.from_s : last_s), "open");
      return { marks, marksLeftOut, cycles, minutes };
    },
  };
}

const isRecord = (value: unknown): value is Record<string, unknown> =>
  typeof value === "object" && value !== null && !Array.isArray(value);
const list = (value: unknown): readonly unknown[] => (Array.isArray(value) ? value : []);
const finite = (value: unknown): number => (typeof value === "number" && Number.isFinite(value) ? value : 0);
const text = (value: unknown): string => (typeof value === "string" ? value : "");
const oneOf = <T extends string>(value: unknown, all: readonly T[], otherwise: T): T =>
  all.find(known => known === value) ?? otherwise;

/** The cycle that was under way where a file begins, as it stands in its metadata. */
export function openCycleFrom(json: unknown): OpenCycle | null {
  if (!isRecord(json) || typeof json["from_s"] !== "number") return null;
  return {
    from_s: finite(json["from_s"]),
    firstStep: text(json["firstStep"]),
    lastStep: text(json["lastStep"]),
    byStep: json["byStep"] === true,
  };
}

/** A digest as it stands in a file; null when it is none. */
export function digestFrom(json: unknown): Digest | null {
  if (
    !isRecord(json) ||
    !Array.isArray(json["marks"]) ||
    !Array.isArray(json["cycles"]) ||
    !Array.isArray(json["minutes"])
  )
    return null;
  const numbers = (value: unknown): number[] => list(value).map(finite);
  return {
    marksLeftOut: finite(json["marksLeftOut"]),
    marks: json["marks"].filter(isRecord).map(of => ({
      at_s: finite(of["at_s"]),
      kind: oneOf(of["kind"], ["event", "alarm", "operator"], "event"),
      level: oneOf(of["level"], ["info", "warning", "error"], "info"),
      code: text(of["code"]),
      sentence: text(of["sentence"]),
    })),
    cycles: json["cycles"].filter(isRecord).map(of => ({
      from_s: finite(of["from_s"]),
      to_s: finite(of["to_s"]),
      ending: oneOf(of["ending"], ["again", "done", "stopped", "refused", "open"], "open"),
    })),
    minutes: json["minutes"].filter(isRecord).map(of => ({
      minute: finite(of["minute"]),
      recorded_s: finite(of["recorded_s"]),
      moving_s: finite(of["moving_s"]),
      stopped_s: finite(of["stopped_s"]),
      travel: numbers(of["travel"]),
      torque_Nm: numbers(of["torque_Nm"]),
      current_A: numbers(of["current_A"]),
      temperature_C: numbers(of["temperature_C"]),
    })),
  };
}
