import type { FleetEntry } from "@twincell/protocol";
import { robotById } from "@twincell/core";
import { Box, History } from "lucide-react";
import { isOwnRobot, newestRecording } from "../../runtime/fleet.ts";
import { lookForServer } from "../../runtime/robot/station-hosts.ts";
import { closeDialog } from "../../stores/dialogs.ts";
import { notify } from "../../stores/notices.ts";
import { shortName } from "../../stores/robot.ts";
import { showMode } from "../../stores/view.ts";
import { say, words } from "../../messages/index.ts";
import { fixed, moment, timeOfDay } from "../../messages/numbers.ts";
import { keyOf } from "./order.ts";

interface Props {
  readonly robot: FleetEntry;
  readonly lit: boolean;
  readonly onLight: (key: string | null) => void;
}
const DAY_MS = 86_400_000;
/** The time of day, with the day where that is not the last one. */
export const timeOf = (time_ms: number): string =>
  Date.now() - time_ms < DAY_MS ? timeOfDay(time_ms) : moment(time_ms);
const modelOf = ({ model }: FleetEntry): string => {
  const robot = robotById(model);
  return robot ? shortName(robot) : model;
};
const newsOf = ({ state, news, heard_ms }: FleetEntry): string =>
  state === "no-link" && heard_ms > 0 ? words.fleet.lastSeen(timeOf(heard_ms)) : say(news);
const percent = (share: number): string => `${Math.round(100 * share)} %`;
const delay = ({ roundTrip_s }: FleetEntry): string =>
  roundTrip_s === null ? "–" : words.fleet.ms(fixed(1000 * roundTrip_s, 1));

/** The twin of a robot of this server in this page; of another one the studio of its server. */
export async function openTwin(robot: FleetEntry): Promise<void> {
  if (await isOwnRobot(robot.id)) {
    lookForServer();
    closeDialog();
    showMode("run");
  } else if (robot.url !== "") window.open(robot.url, "_blank", "noopener");
  else notify("warn", words.fleet.elsewhere(robot.site));
}
export async function openHistory(robot: FleetEntry): Promise<void> {
  if (!(await isOwnRobot(robot.id)) && robot.url !== "") {
    window.open(robot.url, "_blank", "noopener");
    return;
  }
  const found = await newestRecording(robot.id);
  if (typeof found === "string") {
    notify("warn", found);
    return;
  }
  closeDialog();
  await (await import("../../runtime/robot/cell-control.ts")).openRecordingFiles([found]);
}

const HOURS_OF_PART = 1 / 6;
/** Share in motion of each ten minutes, the newest at the right. */
function UseLine({ robot }: { readonly robot: FleetEntry }) {
  const line = robot.use_line.length > 1 ? robot.use_line : [robot.use, robot.use];
  const at = (value: number, i: number): string => `${(100 * i) / (line.length - 1)},${24 - 22 * Math.min(1, value)}`;
  const hours = fixed(robot.use_line.length * HOURS_OF_PART, 1);
  return (
    <svg
      className="fleet-line"
      viewBox="0 0 100 26"
      preserveAspectRatio="none"
      role="img"
      aria-label={words.fleet.useLine(String(Math.round(100 * robot.use)), hours)}
    >
      <polygon points={`0,26 ${line.map(at).join(" ")} 100,26`} />
      <polyline points={line.map(at).join(" ")} />
    </svg>
  );
}

function Acts({ robot }: { readonly robot: FleetEntry }) {
  return (
    <span className="fleet-acts">
      <button className="btn primary" aria-label={words.fleet.twinOf(robot.name)} onClick={() => void openTwin(robot)}>
        <Box aria-hidden />
        {words.fleet.twin}
      </button>
      <button className="btn" aria-label={words.fleet.historyOf(robot.name)} onClick={() => void openHistory(robot)}>
        <History aria-hidden />
        {words.fleet.history}
      </button>
    </span>
  );
}

export function FleetCard({ robot, lit, onLight }: Props) {
  const { name, state, use, site } = robot;
  return (
    <li
      className="fleet-card"
      data-state={state}
      data-lit={lit}
      onPointerEnter={() => onLight(keyOf(robot))}
      onPointerLeave={() => onLight(null)}
    >
      <div className="fleet-head">
        <i className="fleet-dot" data-state={state} aria-hidden />
        <b className="grow">{name}</b>
        <span className="fleet-state">{words.fleet.states[state]}</span>
      </div>
      <span className="small muted fleet-model">
        {modelOf(robot)} · {site}
      </span>
      <div className="fleet-use">
        <UseLine robot={robot} />
        <span className="fleet-numbers">
          <b>{percent(use)}</b>
          <span className="small muted">{delay(robot)}</span>
        </span>
      </div>
      <span className="small fleet-news">{newsOf(robot)}</span>
      <Acts robot={robot} />
    </li>
  );
}

export function FleetRow({ robot, lit, onLight }: Props) {
  const { name, state, use, site } = robot;
  return (
    <li
      className="fleet-row"
      data-state={state}
      data-lit={lit}
      onPointerEnter={() => onLight(keyOf(robot))}
      onPointerLeave={() => onLight(null)}
    >
      <i className="fleet-dot" data-state={state} aria-hidden />
      <b>{name}</b>
      <span className="muted">
        {modelOf(robot)} · {site}
      </span>
      <span className="fleet-state">{words.fleet.states[state]}</span>
      <span>{percent(use)}</span>
      <span className="muted">{delay(robot)}</span>
      <Acts robot={robot} />
    </li>
  );
}
