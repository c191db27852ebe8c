import { useRef } from "react";
import { useStore } from "zustand";
import { cellStore } from "../../stores/cell.ts";
import { robotOf } from "../../stores/document.ts";
import { showNumber } from "../../ui/expression.ts";
import { useLive } from "../../ui/useLive.ts";
import { words } from "../../messages/index.ts";
import { nearness } from "./nearness.ts";

/** While jogging in space: all joints at a glance, and which one is closest to its limit. */
export function JointGauges() {
  const robot = useStore(cellStore, state => robotOf(state.document));
  const gauges = useRef<(HTMLElement | null)[]>([]);
  const line = useRef<HTMLParagraphElement>(null);
  useLive(live => {
    if (!robot) return;
    let closest = 0;
    let least = Infinity;
    for (const [i, { limits }] of robot.arm.joints.entries()) {
      const q = live.q_rad[i]!;
      const gauge = gauges.current[i];
      const left = Math.min(q - limits.lower_rad, limits.upper_rad - q);
      if (left < least) {
        least = left;
        closest = i;
      }
      if (!gauge) continue;
      gauge.style.left = `${Math.min(1, Math.max(0, (q - limits.lower_rad) / (limits.upper_rad - limits.lower_rad))) * 100}%`;
      const near = nearness(q, limits.lower_rad, limits.upper_rad);
      const cell = gauge.parentElement?.parentElement;
      if (cell && cell.dataset.near !== near) cell.dataset.near = near;
    }
    const says = words.jog.closest(closest + 1, showNumber(Math.max(0, least), "angle", 1));
    if (line.current && line.current.textContent !== says) line.current.textContent = says;
  });
  if (!robot) return null;
  return (
    <div>
      <div className="gauges" aria-hidden>
        {robot.arm.joints.map((joint, i) => (
          <div key={joint.name}>
            <span>{words.time.joint(i + 1)}</span>
            <span className="gauge">
              <i
                ref={element => {
                  gauges.current[i] = element;
                }}
              />
            </span>
          </div>
        ))}
      </div>
      <p className="small dim gauges-line" ref={line} />
    </div>
  );
}
