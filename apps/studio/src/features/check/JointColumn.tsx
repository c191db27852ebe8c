import type { Robot } from "@twincell/core";
import { useRef } from "react";
import { showNumber } from "../../ui/expression.ts";
import { useLive } from "../../ui/useLive.ts";
import { words } from "../../messages/index.ts";

const NEAR_RAD = (10 * Math.PI) / 180;

/** Row L-40: the joints one under another, the one at fault red with a mark. */
export function JointColumn({ robot }: { robot: Robot }) {
  const numbers = useRef<(HTMLElement | null)[]>([]);
  const gauges = useRef<(HTMLElement | null)[]>([]);
  const rows = useRef<(HTMLElement | null)[]>([]);
  useLive(live => {
    for (const [i, { limits }] of robot.arm.joints.entries()) {
      const q = live.q_rad[i]!;
      const number = numbers.current[i];
      const gauge = gauges.current[i];
      const row = rows.current[i];
      if (!number || !gauge || !row) continue;
      const text = `${showNumber(q, "angle")}°`;
      const left = Math.min(q - limits.lower_rad, limits.upper_rad - q);
      const near = left < -1e-6 ? "bad" : left < NEAR_RAD ? "near" : "";
      if (number.textContent !== text) number.textContent = text;
      gauge.style.left = `${Math.min(1, Math.max(0, (q - limits.lower_rad) / (limits.upper_rad - limits.lower_rad))) * 100}%`;
      if (row.dataset.near !== near) row.dataset.near = near;
    }
  });
  return (
    <div className="joint-column">
      {robot.arm.joints.map((joint, i) => (
        <div
          key={joint.name}
          className="joint-line"
          ref={element => {
            rows.current[i] = element;
          }}
        >
          <span className="axis-name">{words.time.joint(i + 1)}</span>
          <span className="gauge" aria-hidden>
            <i
              ref={element => {
                gauges.current[i] = element;
              }}
            />
          </span>
          <span
            className="num"
            ref={element => {
              numbers.current[i] = element;
            }}
          />
        </div>
      ))}
    </div>
  );
}
