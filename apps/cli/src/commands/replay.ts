import { armScratch, flangePose, robotById } from "@twincell/core";
import type { History, Samples } from "@twincell/recording";
import { given } from "../io/arguments.ts";
import { readHistory } from "../io/history.ts";
import { lineWriter } from "../io/json-lines.ts";
import { UseFault, type Command } from "../io/usage.ts";

export const replayCommand: Command = {
  name: "replay",
  summary: "a recording as the state stream it was",
  usage: `twincell replay FILE [--from T] [--until T] [--period S] [--pace X] [--marks] [--robot ID]

Writes what was recorded, one JSON line a sample: {"t":s,"q":[…],"position":[…],"quaternion":[…],"io":{…},"step":ID,"moving","mode","safety",
"override","message"}; t counts from the start of the recording, the pose is the flange's in the robot's base. FILE may be a folder
with any number of recordings. A file that was cut off or damaged gives what is left of it, and says so on stderr.

  --from T     seconds since the start, or alarm: from 10 s before the last alarm (default 0)
  --until T    seconds since the start (default: the end)
  --period S   one line every S seconds, as it stood then, instead of one a sample
  --pace X     as it happened, X times as fast (default: at once)
  --marks      instead of samples: alarms, events, what people did and cycles, one line each
  --robot ID   which robot, where a folder holds several (default: that of the newest file)`,
  async run(args) {
    const options = given(args, {
      from: { type: "string" },
      until: { type: "string" },
      period: { type: "string" },
      pace: { type: "string" },
      marks: { type: "boolean" },
      robot: { type: "string" },
      json: { type: "boolean" },
    });
    const [path] = options.positionals;
    if (path === undefined) throw new UseFault("FILE is missing.", "Give a recording, or a folder of them.");
    const history = await readHistory(path, options.text("robot"));
    const from_s = fromOf(options.text("from"), history);
    const until_s = options.number("until") ?? history.duration_s;
    const period_s = options.number("period");
    const pace = options.number("pace");
    if (period_s !== undefined && !(period_s >= 1e-4))
      throw new UseFault(`--period wants at least 0.0001 s, not ${period_s}.`);
    if (pace !== undefined && !(pace > 0)) throw new UseFault(`--pace wants more than 0, not ${pace}.`);
    const writer = lineWriter();
    const within = (t_s: number): boolean => t_s >= from_s && t_s <= until_s;
    if (options.flag("marks")) {
      for (const mark of history.marks)
        if (within(mark.at_s))
          writer.write({
            t: rounded(mark.at_s),
            kind: mark.kind,
            level: mark.level,
            code: mark.code,
            sentence: mark.sentence,
          });
      for (const cycle of history.cycles)
        if (within(cycle.from_s))
          writer.write({ t: rounded(cycle.from_s), kind: "cycle", until: rounded(cycle.to_s), ending: cycle.ending });
      await writer.end();
      return 0;
    }
    const lines = linesOf(history);
    const begun_ms = performance.now();
    for await (const line of period_s === undefined
      ? everySample(history, from_s, until_s, lines)
      : everyPeriod(history, from_s, until_s, period_s, lines)) {
      if (pace !== undefined) {
        const wait_ms = ((line.t - from_s) / pace) * 1000 - (performance.now() - begun_ms);
        if (wait_ms > 1) {
          writer.flush();
          await new Promise(resolve => {
            setTimeout(resolve, wait_ms);
          });
        }
      }
      writer.write(line);
    }
    await writer.end();
    return 0;
  },
};

const rounded = (t_s: number): number => Number(t_s.toFixed(6));

function fromOf(text: string | undefined, history: History): number {
  if (text === undefined) return 0;
  if (text === "alarm") {
    const alarm = history.lastAlarm(Infinity);
    if (!alarm) throw new UseFault("There is no alarm in this recording.", "Give --from in seconds.");
    return Math.max(0, alarm.at_s - 10);
  }
  const from_s = Number(text);
  if (text.trim() === "" || !Number.isFinite(from_s))
    throw new UseFault(`--from wants seconds or alarm, not "${text}".`);
  if (from_s > history.duration_s)
    throw new UseFault(
      `The recording is ${history.duration_s.toFixed(2)} s long; --from ${from_s} lies behind its end.`,
    );
  return from_s;
}

type Line = { readonly t: number } & Readonly<Record<string, unknown>>;
type LineMaker = (
  t_s: number,
  q: Float64Array,
  state: Samples["states"][number],
  signals: Readonly<Record<string, boolean | number>>,
) => Line;

function linesOf(history: History): LineMaker {
  const robot = robotById(history.robot);
  const scratch = armScratch();
  return (t_s, q, state, signals) => {
    const flange =
      robot && robot.arm.joints.length === q.length ? flangePose(robot.arm, q, undefined, scratch) : undefined;
    return {
      t: rounded(t_s),
      q: Array.from(q),
      ...(flange ? { position: flange.position, quaternion: flange.quaternion } : {}),
      io: { gripper: state.gripperClosed, ...signals },
      step: state.step,
      moving: state.moving,
      mode: state.mode,
      safety: state.safety,
      override: state.override,
      message: state.message,
    };
  };
}

async function* everySample(history: History, from_s: number, until_s: number, line: LineMaker): AsyncGenerator<Line> {
  for await (const { times_s, q_rad, stateOf, states, notes, offset_s } of history.samples(from_s, until_s)) {
    let signals: Readonly<Record<string, boolean | number>> = {};
    let at = 0;
    const io = notes.flatMap(note => (note.kind === "io" ? [note] : []));
    for (let i = 0; i < times_s.length; i++) {
      while (at < io.length && io[at]!.at_s <= times_s[i]! + 1e-9) signals = io[at++]!.signals;
      const t_s = times_s[i]! + offset_s;
      if (t_s > until_s + 1e-9) return;
      if (t_s >= from_s - 1e-9)
        yield line(t_s, q_rad.subarray(i * history.joints, (i + 1) * history.joints), states[stateOf[i]!]!, signals);
    }
  }
}
async function* everyPeriod(
  history: History,
  from_s: number,
  until_s: number,
  period_s: number,
  line: LineMaker,
): AsyncGenerator<Line> {
  const last_s = Math.min(until_s, history.duration_s);
  for (let i = 0; from_s + i * period_s <= last_s + 1e-9; i++) {
    const { t_s, q_rad, state, signals } = await history.at(from_s + i * period_s);
    yield line(t_s, q_rad, state, signals);
  }
}
