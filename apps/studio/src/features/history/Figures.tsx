import type { Dashboard, Hint, JointTravel } from "@twincell/recording";
import { isSlide, robotById, type Robot } from "@twincell/core";
import { useEffect, type ReactNode } from "react";
import { useStore } from "zustand";
import { theHistory } from "../../runtime/robot/cell-control.ts";
import { historyStore } from "../../stores/history.ts";
import { serviceStore, setServiceTravel } from "../../stores/service.ts";
import { NumberField } from "../../ui/NumberField.tsx";
import { say, words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";
import { whole } from "../../messages/numbers.ts";
import { clockOf } from "./times.ts";
import { Trend } from "./Trend.tsx";

const percent = (share: number): string => fixed(100 * share, share < 0.1 && share > 0 ? 1 : 0);

/**
 * What the recording says of production: cycle times, use, alarms, loads, wear (row T-56). What the source does not
 * give is “not reported”.
 */
export default function Figures() {
  const figures = useStore(historyStore, state => state.figures);
  const name = useStore(historyStore, state => `${state.open}${state.name}${state.startedAt_ms}`);
  const service = useStore(serviceStore, state => state.travel);
  const robot = robotById(theHistory.robot);
  useEffect(() => {
    theHistory.figures();
  }, [name, service]);
  if (!figures)
    return (
      <p className="muted" role="status">
        {words.history.loading}
      </p>
    );
  const { cycles, use, alarms, load, temperature, travel, hints } = figures;
  const joints = travel.map(({ joint }) => words.history.joint(joint));
  return (
    <div className="history-figures">
      <Figure
        title={words.history.cycleTimes}
        says={
          cycles.count > 0
            ? words.history.cyclesSay(
                cycles.count,
                fixed(cycles.median_s, 2),
                fixed(cycles.fastest_s, 2),
                fixed(cycles.slowest_s, 2),
              )
            : words.history.noCycles
        }
      >
        {cycles.count > 1 && (
          <Trend
            unit=" s"
            times_s={cycles.times.map(({ at_s }) => at_s)}
            lines={[cycles.times.map(({ takes_s }) => takes_s)]}
            labels={[words.history.cycleTimes]}
          />
        )}
      </Figure>
      <Figure
        title={words.history.use}
        says={words.history.useSays(
          percent(share(use.moving_s, use)),
          percent(share(use.stopped_s, use)),
          clockOf(use.recorded_s),
        )}
      >
        {use.trend.length > 1 && (
          <Trend
            unit=" %"
            times_s={use.trend.map(({ at_s }) => at_s)}
            lines={[use.trend.map(({ values }) => 100 * values[0]!)]}
            labels={[words.history.use]}
          />
        )}
      </Figure>
      <Figure title={words.history.alarms} says={alarms.length === 0 ? words.history.noAlarms : ""}>
        <ul className="history-events">
          {alarms.map(alarm => (
            <li key={alarm.code} data-level={alarm.level}>
              <button
                className="link"
                onClick={() => {
                  theHistory.seek(alarm.last_s);
                }}
              >
                {words.history.alarmTimes(alarm.count)}
              </button>{" "}
              <span>{say(alarm.sentence)}</span>
            </li>
          ))}
        </ul>
      </Figure>
      <Joints
        title={words.history.load}
        reported={load.kind === "reported" ? load.value : null}
        unit={load.kind === "reported" ? ` ${load.value.unit}` : ""}
        labels={joints}
      />
      <Joints
        title={words.history.temperature}
        reported={temperature.kind === "reported" ? temperature.value : null}
        unit=" °C"
        labels={joints}
      />
      <Figure
        title={words.history.travel}
        says={travel.every(({ service }) => service.kind === "not-reported") ? words.history.noService : ""}
      >
        <Travel travel={travel} robot={robot} />
        {robot && <Service robot={robot} travel={service[robot.id] ?? []} />}
      </Figure>
      <Figure title={words.history.hints} says={hints.length === 0 ? words.history.noHints : ""}>
        <ul className="history-hints">
          {hints.map((hint, i) => (
            <li key={i}>{hintWords(hint)}</li>
          ))}
        </ul>
      </Figure>
    </div>
  );
}

const share = (part_s: number, { recorded_s }: Dashboard["use"]): number => (recorded_s > 0 ? part_s / recorded_s : 0);

function Figure({
  title,
  says,
  children,
}: {
  readonly title: string;
  readonly says: string;
  readonly children?: ReactNode;
}) {
  return (
    <div className="history-figure">
      <h3>{title}</h3>
      {says !== "" && <p className="small muted">{says}</p>}
      {children}
    </div>
  );
}
function Joints({
  title,
  reported,
  unit,
  labels,
}: {
  readonly title: string;
  readonly reported: { readonly trend: Dashboard["use"]["trend"] } | null;
  readonly unit: string;
  readonly labels: readonly string[];
}) {
  return (
    <Figure title={title} says={reported ? "" : words.history.notReported}>
      {reported && reported.trend.length > 1 && (
        <Trend
          unit={unit}
          times_s={reported.trend.map(({ at_s }) => at_s)}
          lines={labels.map((_, i) => reported.trend.map(({ values }) => values[i] ?? NaN))}
          labels={labels}
        />
      )}
    </Figure>
  );
}

const hoursWords = (hours: number): string =>
  Number.isFinite(hours) ? words.history.hoursOf(hours) : words.history.noEnd;

const DEGREES = 180 / Math.PI;
const MILLIMETRES = 1000;
const slides = (robot: Robot | undefined, joint: number): boolean =>
  robot?.arm.joints[joint] !== undefined && isSlide(robot.arm.joints[joint]);

/** Bars of how far each joint went, the busiest full; how much of its service interval that is, where one is known. */
function Travel({ travel, robot }: { readonly travel: readonly JointTravel[]; readonly robot: Robot | undefined }) {
  const most = Math.max(...travel.map(joint => joint.travel), 1e-9);
  const far = (joint: number, way: number): string =>
    slides(robot, joint - 1) ? `${whole(way * MILLIMETRES)} mm` : `${whole(way * DEGREES)}°`;
  return (
    <table className="history-travel">
      <tbody>
        {travel.map(({ joint, travel: all, perHour, service }) => (
          <tr key={joint}>
            <th scope="row">{words.history.joint(joint)}</th>
            <td className="bar">
              <i style={{ width: `${(100 * all) / most}%` }} />
            </td>
            <td>{far(joint, all)}</td>
            <td className="muted">
              {service.kind === "reported"
                ? words.history.served(percent(service.value.share), hoursWords(service.value.hoursLeft))
                : `${far(joint, perHour)} ${words.history.perHour}`}
            </td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

/** What each joint may travel between two services: only the robot's papers say. */
function Service({ robot, travel }: { readonly robot: Robot; readonly travel: readonly number[] }) {
  const { joints } = robot.arm;
  return (
    <details className="history-service">
      <summary>{words.history.serviceTitle}</summary>
      <p className="small muted">{words.history.serviceSays}</p>
      <div className="history-service-fields">
        {joints.map((_, i) => {
          const name = words.history.joint(i + 1);
          return (
            <NumberField
              key={name}
              label={words.history.serviceOf(name)}
              mark={name}
              quantity={slides(robot, i) ? "length" : "angle"}
              value={travel[i] ?? 0}
              min={0}
              decimals={0}
              onChange={(to, done) => {
                if (done) setServiceTravel(robot.id, i, to, joints.length);
              }}
            />
          );
        })}
      </div>
    </details>
  );
}

function hintWords(hint: Hint): string {
  switch (hint.kind) {
    case "slower":
      return words.history.slower(percent(hint.by), fixed(hint.from_s, 2), fixed(hint.to_s, 2));
    case "load-rises":
      return words.history.loadRises(hint.joint, percent(hint.by));
    case "temperature-rises":
      return words.history.temperatureRises(hint.joint, percent(hint.by));
    case "alarm-repeats":
      return words.history.repeats(hint.code, hint.count);
    case "service-due":
      return words.history.serviceDue(hint.joint, percent(hint.share));
  }
}
