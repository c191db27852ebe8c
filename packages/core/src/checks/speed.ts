import type { Joint } from "../model/arm.ts";
import { isSlide, jointRateText } from "../model/slide.ts";
import type { Slowed } from "../trajectory/run-timing.ts";
import type { Finding } from "./verdict.ts";
import { motions, type CheckScene } from "./scene.ts";
import { slower } from "./slower.ts";

/** Commanded speeds that a joint cannot follow (rows L-26, L-56), and joint speeds of the plan itself. */
export function checkSpeed(scene: CheckScene): void {
  const joints = scene.robot.arm.joints;
  const n = joints.length;
  for (const { step, at_s, slowed } of scene.layout.notes) {
    const move = scene.layout.moves.get(step)?.step;
    const repairs = move === undefined ? [] : slower(scene, move, slowed.wanted / slowed.limit);
    const { joint, wanted, limit } = slowed;
    scene.add(step, "bad", { ...saidOf(joints[joint - 1]!, slowed), joint, value: wanted, limit, at_s, repairs });
  }
  for (const segment of motions(scene)) {
    for (let j = 0; j < n; j++) {
      let top = 0;
      let at = 0;
      for (let i = 0; i < segment.times_s.length; i++) {
        const speed = Math.abs(segment.qd_rad_s[i * n + j]!);
        if (speed > top) {
          top = speed;
          at = i;
        }
      }
      const limit = joints[j]!.limits.speed_rad_s;
      if (top > limit * (1 + 1e-6)) {
        const at_s = segment.start_s + segment.times_s[at]!;
        const move = scene.layout.moves.get(segment.step)?.step;
        const repairs = move === undefined ? [] : slower(scene, move, top / limit);
        scene.add(segment.step, "bad", {
          joint: j + 1,
          value: top,
          limit,
          at_s,
          repairs,
          ...saidOf(joints[j]!, { joint: j + 1, wanted: top, limit, unit: "rad/s" }),
        });
      }
    }
  }
}

/** Code, unit and sentence of a joint that cannot follow. */
function saidOf(
  of: Joint,
  { joint, wanted, limit, unit }: Pick<Slowed, "joint" | "wanted" | "limit" | "unit">,
): Pick<Finding, "code" | "unit" | "sentence"> {
  const slides = isSlide(of);
  const rate = (value: number): string => jointRateText(of, value);
  switch (unit) {
    case "rad/s3":
      return {
        code: "speed.jerk",
        unit: slides ? "m/s3" : unit,
        sentence: `Joint ${joint} would need a jerk of ${rate(wanted)}³; its limit is ${rate(limit)}³.`,
      };
    case "rad/s2":
      return {
        code: "speed.acceleration",
        unit: slides ? "m/s2" : unit,
        sentence: `Joint ${joint} would accelerate at ${rate(wanted)}²; its limit is ${rate(limit)}².`,
      };
    case "rad/s":
      return {
        code: "speed.joint",
        unit: slides ? "m/s" : unit,
        sentence: `Joint ${joint} would ${slides ? "slide" : "turn"} at ${rate(wanted)}; its limit is ${rate(limit)}.`,
      };
  }
}
