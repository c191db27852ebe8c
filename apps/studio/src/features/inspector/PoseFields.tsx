import type { Pose, Vector3 } from "@twincell/core";
import { fixedXyz, fromFixedXyz } from "../../runtime/jog/fixed-xyz.ts";
import { shownUnit } from "../../ui/expression.ts";
import { NumberField } from "../../ui/NumberField.tsx";
import { words } from "../../messages/index.ts";

const MARKS = ["X", "Y", "Z"] as const;
const TURNS = ["Rx", "Ry", "Rz"] as const;

/** Six numbers of a pose in two columns wide enough for −12 345.67: mm, and degrees about the fixed axes x, y, z. */
export function PoseFields({
  pose,
  disabled = false,
  onChange,
}: {
  pose: Pose;
  disabled?: boolean;
  onChange: (pose: Pose, done: boolean) => void;
}) {
  const angles = fixedXyz(pose.quaternion, new Float64Array(3));
  const place = (axis: number, value: number, done: boolean): void => {
    const position: Vector3 = [pose.position[0], pose.position[1], pose.position[2]];
    position[axis] = value;
    onChange({ position, quaternion: pose.quaternion }, done);
  };
  const turn = (axis: number, value: number, done: boolean): void => {
    const next = Float64Array.from(angles);
    next[axis] = value;
    onChange({ position: pose.position, quaternion: fromFixedXyz(next[0]!, next[1]!, next[2]!) }, done);
  };
  return (
    <div className="pose-fields">
      <div className="stack" role="group" aria-label={words.inspector.position}>
        <Unit words={words.inspector.position} unit={shownUnit("length")} />
        {MARKS.map((mark, i) => (
          <NumberField
            key={mark}
            label={`${words.inspector.position} ${mark}`}
            mark={mark}
            quantity="length"
            unitAbove
            value={pose.position[i]!}
            disabled={disabled}
            onChange={(value, done) => place(i, value, done)}
          />
        ))}
      </div>
      <div className="stack" role="group" aria-label={words.inspector.rotation}>
        <Unit words={words.inspector.rotation} unit={shownUnit("angle")} />
        {TURNS.map((mark, i) => (
          <NumberField
            key={mark}
            label={`${words.inspector.rotation} ${mark}`}
            mark={mark}
            quantity="angle"
            unitAbove
            value={angles[i]!}
            disabled={disabled}
            onChange={(value, done) => turn(i, value, done)}
          />
        ))}
      </div>
    </div>
  );
}

const Unit = ({ words: text, unit }: { words: string; unit: string }) => (
  <span className="pose-unit" aria-hidden>
    {text} <span className="dim">{unit}</span>
  </span>
);
