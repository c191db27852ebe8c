import type { Robot } from "@twincell/core";
import { DRIVER_KINDS, drivesRobot } from "@twincell/controllers";
import { useMemo } from "react";
import { robotFileFor, saveRobotFile, saveUrdf } from "../../runtime/robot-files.ts";
import { languagesOf } from "../../stores/languages.ts";
import { showNumber } from "../../ui/expression.ts";
import { say, words } from "../../messages/index.ts";
import { digits } from "../../messages/numbers.ts";
import { Picture } from "./Picture.tsx";

/** Everything that is known of a robot, and what is not. */
export function Details({
  robot,
  onRemove = null,
}: {
  readonly robot: Robot;
  readonly onRemove?: ((robot: Robot) => void) | null;
}) {
  const languages = useMemo(() => languagesOf(robot).filter(({ why }) => why === null), [robot]);
  const drivers = useMemo(() => DRIVER_KINDS.filter(kind => drivesRobot(kind, robot)), [robot]);
  return (
    <section className="robots-details stack" aria-label={robot.name} aria-live="polite">
      <Picture robot={robot} width={360} height={200} />
      <h3>{robot.name}</h3>
      {robot.madeUpGeometry && (
        <p className="export-proof">
          <i className="mark" data-verdict="warn" aria-hidden />
          {words.robots.madeUpSays}
        </p>
      )}
      <dl className="facts">
        <div>
          <dt>{words.robots.vendor}</dt>
          <dd translate="no">{robot.vendor || words.robots.unknown}</dd>
        </div>
        <div>
          <dt>{words.robots.axes}</dt>
          <dd>{robot.arm.joints.length}</dd>
        </div>
        <div>
          <dt>{words.inspector.payload}</dt>
          <dd>{robot.payload_kg === undefined ? words.robots.unknown : `${digits(robot.payload_kg)} kg`}</dd>
        </div>
        <div>
          <dt>{words.inspector.reach}</dt>
          <dd>{showNumber(robot.reach_m, "length", 0)} mm</dd>
        </div>
        <div>
          <dt>{words.inspector.repeatability}</dt>
          <dd>
            {robot.repeatability_m === undefined
              ? words.robots.unknown
              : `±${showNumber(robot.repeatability_m, "length", 3)} mm`}
          </dd>
        </div>
        <div>
          <dt>{words.inspector.shapeError}</dt>
          <dd>{showNumber(robot.shapeError_m, "length", 0)} mm</dd>
        </div>
        <div>
          <dt>{words.own.inverse}</dt>
          <dd>{robot.family.kind === "general" ? words.own.numerical : words.own.closedForm}</dd>
        </div>
        <div>
          <dt>{words.robots.languages}</dt>
          <dd translate="no">{languages.map(({ dialect }) => dialect.name).join(", ") || words.robots.noneKnown}</dd>
        </div>
        <div>
          <dt>{words.robots.drivers}</dt>
          <dd translate="no">{drivers.map(({ name }) => name).join(", ") || words.robots.noneKnown}</dd>
        </div>
      </dl>
      {languages.length === 0 && <p className="muted small">{words.export.noLanguage(robot.name)}</p>}
      {drivers.length === 0 && <p className="muted small">{words.robots.noDriver(robot.name)}</p>}
      <details className="small">
        <summary>{words.robots.sources}</summary>
        <ul className="notes">
          {Object.entries(robot.sources).map(([what, source]) => (
            <li key={what}>
              {what}: {say(source)}
            </li>
          ))}
        </ul>
      </details>
      {robot.assumptions.length > 0 && (
        <>
          <h4 className="dim small">{words.inspector.assumptions}</h4>
          <ul className="notes small">
            {robot.assumptions.map(says => (
              <li key={says}>{say(says)}</li>
            ))}
          </ul>
        </>
      )}
      <div className="robot-files">
        <button type="button" className="btn small" onClick={() => saveRobotFile(robotFileFor(robot), robot)}>
          {words.own.saveFile}
        </button>
        <button type="button" className="btn small" title={words.own.saveUrdfSays} onClick={() => void saveUrdf(robot)}>
          {words.own.saveUrdf}
        </button>
      </div>
      {onRemove && (
        <button type="button" className="btn small" onClick={() => onRemove(robot)}>
          {words.own.remove(robot.name)}
        </button>
      )}
    </section>
  );
}
