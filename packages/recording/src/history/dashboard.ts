import type { EventLevel } from "../state.ts";
import type { History } from "./history.ts";

/** A figure that the source gives, or that it does not give it. */
export type Reported<T> = { readonly kind: "reported"; readonly value: T } | { readonly kind: "not-reported" };

/** One point of a trend: the mean over a stretch of time that begins there. */
export interface TrendPoint {
  readonly at_s: number;
  readonly values: readonly number[];
}
export interface JointTravel {
  /** Counts from 1. */
  readonly joint: number;
  /** Σ|Δq| over the history [rad, or m of a joint that slides]. */
  readonly travel: number;
  /** The same for each hour that was recorded. */
  readonly perHour: number;
  /**
   * Share of the joint's service interval that the history used up, and in how many recorded hours the rest will be;
   * without an interval nobody knows.
   */
  readonly service: Reported<{ readonly share: number; readonly hoursLeft: number }>;
}
export interface AlarmCount {
  readonly code: string;
  readonly level: EventLevel;
  readonly sentence: string;
  readonly count: number;
  readonly last_s: number;
}
export type Hint =
  | { readonly kind: "slower"; readonly by: number; readonly from_s: number; readonly to_s: number }
  | { readonly kind: "load-rises" | "temperature-rises"; readonly joint: number; readonly by: number }
  | { readonly kind: "alarm-repeats"; readonly code: string; readonly count: number }
  | { readonly kind: "service-due"; readonly joint: number; readonly share: number };

/** What a history says about production: cycle times, use, alarms, loads, wear (row T-56). */
export interface Dashboard {
  readonly cycles: {
    readonly count: number;
    readonly median_s: number;
    readonly fastest_s: number;
    readonly slowest_s: number;
    readonly times: readonly { readonly at_s: number; readonly takes_s: number }[];
  };
  readonly use: {
    readonly recorded_s: number;
    readonly moving_s: number;
    readonly stopped_s: number;
    readonly trend: readonly TrendPoint[];
  };
  readonly alarms: readonly AlarmCount[];
  /** Torque where it is reported, else current. */
  readonly load: Reported<{ readonly unit: "N m" | "A"; readonly trend: readonly TrendPoint[] }>;
  readonly temperature: Reported<{ readonly trend: readonly TrendPoint[] }>;
  readonly travel: readonly JointTravel[];
  readonly hints: readonly Hint[];
}

export interface DashboardOptions {
  /**
   * What a joint may travel between two services [rad, or m], base first; 0 where nobody said. Makers publish it with
   * the robot's papers.
   */
  readonly serviceTravel?: readonly number[];
}

/** Trends have at most about this many points. */
const MAX_POINTS = 200;
/** A change smaller than this is not worth a sentence. */
const SLOWER = 0.05;
const RISES = 0.15;
const REPEATS = 3;
const DUE = 0.8;

export function dashboardOf(
  history: Pick<History, "cycles" | "minutes" | "marks" | "joints" | "duration_s">,
  options: DashboardOptions = {},
): Dashboard {
  const { minutes, joints } = history;
  const sum = (pick: (minute: (typeof minutes)[number]) => number): number =>
    minutes.reduce((total, minute) => total + pick(minute), 0);
  const recorded_s = sum(minute => minute.recorded_s);
  const hours = recorded_s / 3600;
  const times = history.cycles
    .filter(cycle => cycle.ending === "again" || cycle.ending === "done")
    .map(cycle => ({ at_s: cycle.from_s, takes_s: cycle.to_s - cycle.from_s }));
  const sorted = times.map(({ takes_s }) => takes_s).sort((a, b) => a - b);
  const travel = Array.from({ length: joints }, (_, i): JointTravel => {
    const all = sum(minute => minute.travel[i] ?? 0);
    const perHour = hours > 0 ? all / hours : 0;
    const interval = options.serviceTravel?.[i] ?? 0;
    return {
      joint: i + 1,
      travel: all,
      perHour,
      service:
        interval > 0
          ? {
              kind: "reported",
              value: {
                share: all / interval,
                hoursLeft: perHour > 0 ? Math.max(0, interval - all) / perHour : Infinity,
              },
            }
          : { kind: "not-reported" },
    };
  });
  const torque = trendOf(history, minute => minute.torque_Nm);
  const current = trendOf(history, minute => minute.current_A);
  const degrees = trendOf(history, minute => minute.temperature_C);
  const load: Dashboard["load"] =
    torque.length > 0
      ? { kind: "reported", value: { unit: "N m", trend: torque } }
      : current.length > 0
        ? { kind: "reported", value: { unit: "A", trend: current } }
        : { kind: "not-reported" };
  const alarms = alarmsOf(history);
  return {
    cycles: {
      count: times.length,
      median_s: middle(sorted),
      fastest_s: sorted[0] ?? NaN,
      slowest_s: sorted.at(-1) ?? NaN,
      times,
    },
    use: {
      recorded_s,
      moving_s: sum(minute => minute.moving_s),
      stopped_s: sum(minute => minute.stopped_s),
      trend: trendOf(history, minute => (minute.recorded_s > 0 ? [minute.moving_s / minute.recorded_s] : [])),
    },
    alarms,
    load,
    temperature: degrees.length > 0 ? { kind: "reported", value: { trend: degrees } } : { kind: "not-reported" },
    travel,
    hints: [
      ...slower(times),
      ...(load.kind === "reported" ? rises("load-rises", load.value.trend) : []),
      ...rises("temperature-rises", degrees),
      ...alarms
        .filter(({ count }) => count >= REPEATS)
        .map(({ code, count }): Hint => ({ kind: "alarm-repeats", code, count })),
      ...travel.flatMap(({ joint, service }): Hint[] =>
        service.kind === "reported" && service.value.share >= DUE
          ? [{ kind: "service-due", joint, share: service.value.share }]
          : [],
      ),
    ],
  };
}

const middle = (sorted: readonly number[]): number => sorted[sorted.length >> 1] ?? NaN;

/** Means over as many minutes at a time as keep the trend short; minutes that do not report are left out. */
function trendOf(
  { minutes, duration_s }: Pick<History, "minutes" | "duration_s">,
  pick: (minute: History["minutes"][number]) => readonly number[],
): TrendPoint[] {
  const group = Math.max(1, Math.ceil(duration_s / 60 / MAX_POINTS));
  const groups = new Map<number, { sums: number[]; count: number }>();
  for (const minute of minutes) {
    const values = pick(minute);
    if (values.length === 0) continue;
    const key = Math.floor(minute.minute / group);
    const known = groups.get(key);
    if (!known || known.sums.length !== values.length) groups.set(key, { sums: [...values], count: 1 });
    else {
      values.forEach((value, i) => {
        known.sums[i]! += value;
      });
      known.count++;
    }
  }
  return [...groups]
    .sort(([a], [b]) => a - b)
    .map(([key, { sums, count }]) => ({ at_s: key * group * 60, values: sums.map(value => value / count) }));
}

function alarmsOf({ marks }: Pick<History, "marks">): AlarmCount[] {
  const counts = new Map<string, AlarmCount>();
  for (const { kind, code, level, sentence, at_s } of marks) {
    if (kind === "alarm")
      counts.set(code, { code, level, sentence, count: (counts.get(code)?.count ?? 0) + 1, last_s: at_s });
  }
  return [...counts.values()].sort((a, b) => b.count - a.count);
}

/** The last quarter of the cycles against the first. */
function slower(times: Dashboard["cycles"]["times"]): Hint[] {
  const quarter = times.length >> 2;
  if (quarter < 2) return [];
  const median = (part: typeof times): number => middle(part.map(({ takes_s }) => takes_s).sort((a, b) => a - b));
  const from_s = median(times.slice(0, quarter));
  const to_s = median(times.slice(-quarter));
  return to_s > from_s * (1 + SLOWER) ? [{ kind: "slower", by: to_s / from_s - 1, from_s, to_s }] : [];
}
function rises(kind: "load-rises" | "temperature-rises", trend: readonly TrendPoint[]): Hint[] {
  const quarter = trend.length >> 2;
  if (quarter < 2) return [];
  const mean = (part: readonly TrendPoint[], i: number): number =>
    part.reduce((sum, { values }) => sum + (values[i] ?? 0), 0) / part.length;
  return trend[0]!.values.flatMap((_, i): Hint[] => {
    const from = mean(trend.slice(0, quarter), i);
    const to = mean(trend.slice(-quarter), i);
    return from > 0 && to > from * (1 + RISES) ? [{ kind, joint: i + 1, by: to / from - 1 }] : [];
  });
}
