import { standLoad } from "@twincell/core";
import type { CellDocument } from "@twincell/project";
import { robotFileFor, saveRobotFile, saveUrdf } from "../../runtime/robot-files.ts";
import { runCommand } from "../../stores/commands.ts";
import { commit, robotOf } from "../../stores/document.ts";
import { showNumber } from "../../ui/expression.ts";
import { say, words } from "../../messages/index.ts";
import { digits } from "../../messages/numbers.ts";
import { JointFields } from "./JointFields.tsx";
import { PoseFields } from "./PoseFields.tsx";

export function RobotInspector({ document }: { document: CellDocument }) {
  const robot = robotOf(document);
  if (!robot) return null;
  const load = standLoad(robot);
  const mass =
    load.kind === "known" && load.payload_kg > 0
      ? words.inspector.massLoaded(load.robot_kg, load.total_kg)
      : `${digits(robot.mass_kg ?? 0)} kg`;
  const facts = [
    [words.inspector.reach, `${showNumber(robot.reach_m, "length", 0)} mm`],
    [words.inspector.payload, robot.payload_kg === undefined ? words.robots.unknown : `${digits(robot.payload_kg)} kg`],
    [
      words.inspector.repeatability,
      robot.repeatability_m === undefined
        ? words.robots.unknown
        : `±${showNumber(robot.repeatability_m, "length", 3)} mm`,
    ],
    [words.inspector.tcpSpeed, `${digits(robot.maxTcpSpeed_mps)} m/s`],
    [words.inspector.shapeError, `${showNumber(robot.shapeError_m, "length", 0)} mm`],
    ...(robot.mass_kg === undefined ? [] : [[words.inspector.mass, mass] as const]),
  ] as const;
  return (
    <section aria-label={robot.name}>
      <h2 className="heading">
        <span className="grow">{robot.name}</span>
        <span className="tag">{words.tree.axes(robot.arm.joints.length)}</span>
      </h2>
      <div className="section stack">
        <button className="btn" onClick={() => runCommand("cell.robot")}>
          {words.robots.another}
        </button>
        <div className="robot-files">
          <button className="btn small" onClick={() => saveRobotFile(robotFileFor(robot), robot)}>
            {words.own.saveFile}
          </button>
          <button className="btn small" title={words.own.saveUrdfSays} onClick={() => void saveUrdf(robot)}>
            {words.own.saveUrdf}
          </button>
        </div>
        {robot.madeUpGeometry && (
          <p className="export-proof small">
            <i className="mark" data-verdict="warn" aria-hidden />
            {words.robots.madeUpSays}
          </p>
        )}
        <h3 className="label">{words.inspector.joints}</h3>
        <JointFields robot={robot} />
        <h3 className="label">{words.inspector.base}</h3>
        <PoseFields
          pose={document.robot.worldFromBase}
          onChange={(pose, done) =>
            commit(
              words.undo.moveRobot,
              before => ({
                ...before,
                robot: { ...before.robot, worldFromBase: { position: pose.position, quaternion: pose.quaternion } },
              }),
              done ? undefined : "robot",
            )
          }
        />
        <dl className="facts">
          {facts.map(([name, value]) => (
            <div key={name}>
              <dt>{name}</dt>
              <dd>{value}</dd>
            </div>
          ))}
        </dl>
        {robot.assumptions.length > 0 && (
          <details className="small">
            <summary>{words.inspector.assumptions}</summary>
            <ul className="notes">
              {robot.assumptions.map(says => (
                <li key={says}>{say(says)}</li>
              ))}
            </ul>
          </details>
        )}
      </div>
    </section>
  );
}
