import type { OrthoParallelGeometry } from "../model/robot.ts";
import { radians, wrapAngle } from "../spatial/units.ts";
import { deg, motions, type CheckScene } from "./scene.ts";

/** A bend smaller than this makes the joints around it turn fast [rad]. */
export const NEAR_SINGULAR_RAD = radians(5);

/**
 * Straight and circular paths near a singular posture: wrist straight (joints 4 and 6 in line) or arm stretched. Joint
 * moves do not mind.
 */
export function checkSingular(scene: CheckScene): void {
  const family = scene.robot.family;
  const n = scene.robot.arm.joints.length;
  if (family.kind !== "ortho-parallel") return;
  for (const segment of motions(scene)) {
    if (segment.path === "ptp") continue;
    let wrist = Number.POSITIVE_INFINITY;
    let elbow = Number.POSITIVE_INFINITY;
    let wristAt_s = 0;
    let elbowAt_s = 0;
    for (let i = 0; i < segment.times_s.length; i++) {
      const t5 = Math.abs(formulaAngle(family, segment.q_rad, i * n, 4));
      const bend = Math.min(t5, Math.PI - t5);
      const phi = Math.abs(
        wrapAngle(formulaAngle(family, segment.q_rad, i * n, 2) + Math.atan2(family.a2_m, family.c3_m)),
      );
      if (bend < wrist) {
        wrist = bend;
        wristAt_s = segment.start_s + segment.times_s[i]!;
      }
      if (phi < elbow) {
        elbow = phi;
        elbowAt_s = segment.start_s + segment.times_s[i]!;
      }
    }
    if (wrist < NEAR_SINGULAR_RAD)
      scene.add(segment.step, "warn", {
        code: "singular.wrist",
        joint: 5,
        value: wrist,
        limit: NEAR_SINGULAR_RAD,
        unit: "rad",
        at_s: wristAt_s,
        sentence: `The wrist is ${deg(wrist)} from straight; below ${deg(NEAR_SINGULAR_RAD)} joints 4 and 6 turn fast.`,
        repairs: [],
      });
    if (elbow < NEAR_SINGULAR_RAD)
      scene.add(segment.step, "warn", {
        code: "singular.elbow",
        joint: 3,
        value: elbow,
        limit: NEAR_SINGULAR_RAD,
        unit: "rad",
        at_s: elbowAt_s,
        sentence: `The elbow is ${deg(elbow)} from stretched; below ${deg(NEAR_SINGULAR_RAD)} joints 2 and 3 turn fast.`,
        repairs: [],
      });
  }
}

const formulaAngle = (family: OrthoParallelGeometry, q: Float64Array, at: number, j: 2 | 4): number =>
  wrapAngle(family.signs[j] * q[at + j]! - family.offsets_rad[j]);
