import type { RobotServer } from "@twincell/protocol";
import type { ApiRobots } from "./robots.ts";

export interface RequestCounts {
  /** By class of status: 2, 4, 5. */
  readonly byClass: Map<number, number>;
}
const label = (text: string): string => text.replace(/[\\"\n]/g, char => (char === "\n" ? "\\n" : `\\${char}`));

/** Text of the exposition format 0.0.4 of Prometheus. At most 32 robots are open, so they may be labels. */
export function metricsText(host: RobotServer, robots: ApiRobots, requests: RequestCounts, up_s: number): string {
  const lines: string[] = [];
  const family = (name: string, type: "gauge" | "counter", help: string, values: readonly [string, number][]): void => {
    lines.push(`# HELP ${name} ${help}`, `# TYPE ${name} ${type}`);
    for (const [labels, value] of values) lines.push(`${name}${labels} ${value}`);
  };
  const each = (value: (station: RobotServer["stations"][number]) => number): [string, number][] =>
    host.stations.map(station => [`{robot="${label(station.words.id)}"}`, value(station)]);
  family("twincell_up_seconds", "gauge", "Seconds since the server was started.", [["", up_s]]);
  family(
    "twincell_http_requests_total",
    "counter",
    "Answers of the HTTP API by class of status.",
    [...requests.byClass].map(([status, count]) => [`{status="${status}xx"}`, count]),
  );
  family("twincell_robots", "gauge", "Open robots.", [["", host.stations.length]]);
  family(
    "twincell_robot_connected",
    "gauge",
    "1 while the controller is connected.",
    each(({ link }) => (link?.state === "open" ? 1 : 0)),
  );
  family(
    "twincell_robot_samples_total",
    "counter",
    "State samples that came from the controller.",
    each(({ words }) => robots.samples(words.id)),
  );
  family(
    "twincell_robot_samples_missing",
    "gauge",
    "Samples that the controller's own count says are missing since it was connected.",
    each(({ link }) => link?.missing ?? 0),
  );
  family(
    "twincell_robot_emergency_stop",
    "gauge",
    "1 while an emergency stop holds the robot.",
    each(({ guard }) => (guard.state.emergency ? 1 : 0)),
  );
  return `${lines.join("\n")}\n`;
}
