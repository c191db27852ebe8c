import type { Robot } from "@twincell/core";
import { useState } from "react";
import { showJoints, theLive } from "../../runtime/live.ts";
import { takeRobot } from "../../runtime/robot/motion-owner.ts";
import { NumberField } from "../../ui/NumberField.tsx";
import { useLive } from "../../ui/useLive.ts";
import { words } from "../../messages/index.ts";

/** Typed joint angles are taken ten times a second at most from the moving robot. */
const EVERY_MS = 100;

/** Joint angles that can be typed: the robot takes them at once, inside their limits. */
export function JointFields({ robot }: { robot: Robot }) {
  const [q, setQ] = useState<readonly number[]>(() => Array.from(theLive().q_rad));
  const [clock] = useState(() => ({ waiting: false }));
  useLive(() => {
    if (clock.waiting) return;
    clock.waiting = true;
    setTimeout(() => {
      clock.waiting = false;
      setQ(Array.from(theLive().q_rad));
    }, EVERY_MS);
  });
  return (
    <div className="fields-3">
      {robot.arm.joints.map(({ name, limits }, i) => (
        <NumberField
          key={name}
          label={words.inspector.joint(i + 1)}
          mark={words.time.joint(i + 1)}
          quantity="angle"
          value={q[i] ?? 0}
          min={limits.lower_rad}
          max={limits.upper_rad}
          onChange={value => {
            takeRobot("jog");
            const next = Array.from(theLive().q_rad);
            next[i] = value;
            showJoints(next);
            setQ(next);
          }}
        />
      ))}
    </div>
  );
}
