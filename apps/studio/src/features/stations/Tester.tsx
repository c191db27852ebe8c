import { useState } from "react";
import { flangePose, type CommandOutcome, type Vector3 } from "@twincell/core";
import { fixedXyz, fromFixedXyz } from "../../runtime/jog/fixed-xyz.ts";
import { stationLive } from "../../runtime/robot/stations.ts";
import type { ConnectedRobot } from "../../runtime/robot/connected-robot.ts";
import { Chooser } from "../../ui/Choice.tsx";
import { NumberField } from "../../ui/NumberField.tsx";
import { say, words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";

type Action = keyof typeof words.direct.testerActions;
const ACTIONS = Object.keys(words.direct.testerActions) as Action[];

/** The four actions of row T-35 with their inputs, tried one at a time; the result is told in words. */
export function Tester({
  id,
  robot,
  may,
}: {
  readonly id: string;
  readonly robot: ConnectedRobot;
  readonly may: boolean;
}) {
  const [action, setAction] = useState<Action>("print-joints");
  const [joint, setJoint] = useState(1);
  const [angles_rad, setAngles] = useState(() => robot.jointAngles());
  const [endpoint, setEndpoint] = useState<readonly number[]>(() => endpointOf(id));
  const [result, setResult] = useState("");
  const choose = (next: Action): void => {
    setAction(next);
    setResult("");
    setAngles(robot.jointAngles());
    setEndpoint(endpointOf(id));
  };
  const tell = (outcome: Promise<CommandOutcome>): void => {
    setResult("");
    void outcome.then(ended => setResult(ended.kind === "done" ? words.direct.moved : say(ended.why.sentence)));
  };
  const test = (): void => {
    switch (action) {
      case "print-joints":
        setResult(
          robot
            .jointAngles()
            .map(q => `${fixed((q * 180) / Math.PI, 3)}°`)
            .join("  "),
        );
        break;
      case "move-joint":
        tell(robot.moveJoint(joint, angles_rad[joint - 1] ?? 0));
        break;
      case "move-joints":
        tell(robot.moveJoints(angles_rad));
        break;
      case "move-endpoint": {
        const [x = 0, y = 0, z = 0, rx = 0, ry = 0, rz = 0] = endpoint;
        tell(robot.moveToPose({ position: [x, y, z], quaternion: fromFixedXyz(rx, ry, rz) }));
      }
    }
  };
  const angle = (index: number) => (
    <NumberField
      key={index}
      label={`${words.direct.angle} ${words.direct.joint(index + 1)}`}
      mark={words.direct.joint(index + 1)}
      quantity="angle"
      value={angles_rad[index] ?? 0}
      onChange={value => setAngles(angles_rad.map((q, j) => (j === index ? value : q)))}
    />
  );
  return (
    <section className="direct-tester" aria-label={words.direct.tester}>
      <div className="direct-buttons">
        <Chooser
          label={words.direct.testerAction}
          value={action}
          options={ACTIONS.map(value => ({ value, words: words.direct.testerActions[value] }))}
          onChange={choose}
        />
        <button className="btn" disabled={action !== "print-joints" && !may} onClick={test}>
          {words.direct.test}
        </button>
      </div>
      <div className="direct-inputs">
        {action === "move-joint" && (
          <>
            <NumberField
              label={words.direct.jointNumber}
              quantity="plain"
              decimals={0}
              value={joint}
              min={1}
              max={angles_rad.length}
              onChange={value => setJoint(Math.round(value))}
            />
            {angle(joint - 1)}
          </>
        )}
        {action === "move-joints" && angles_rad.map((_, index) => angle(index))}
        {action === "move-endpoint" &&
          words.direct.axes.map((name, index) => (
            <NumberField
              key={name}
              label={name}
              mark={name}
              quantity={index < 3 ? "length" : "angle"}
              value={endpoint[index] ?? 0}
              onChange={value => setEndpoint(endpoint.map((was, j) => (j === index ? value : was)))}
            />
          ))}
      </div>
      <output className="small direct-result" aria-label={words.direct.result}>
        {result}
      </output>
    </section>
  );
}

/** x y z [m] of the flange in the base, and its rotations about the fixed x, y and z [rad]. */
function endpointOf(id: string): number[] {
  const live = stationLive(id);
  if (!live) return [];
  const { position, quaternion } = flangePose(live.robot.arm, live.q_rad);
  const turned = fixedXyz(quaternion, new Float64Array(3));
  return [...(position as Vector3), ...turned];
}
