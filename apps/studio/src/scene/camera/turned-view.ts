import { Spherical, Vector3 } from "three";

/** Fully deflected a stick turns the view once round in so long [s]. */
const ROUND_S = 4;
/** The view never stands on its head [rad from straight above or below]. */
const LEAST_RAD = 0.1;
const arm = new Vector3();
const sphere = new Spherical();

/**
 * The eye, in scene coordinates, gone round what it looks at (row X-31): to the right and up as far as the stick is
 * deflected, −1 … 1 each, for so long. The distance stays.
 */
export function turnedView(eye: Vector3, target: Vector3, [right, up]: readonly [number, number], dt_s: number): void {
  sphere.setFromVector3(arm.subVectors(eye, target));
  const step = (2 * Math.PI * dt_s) / ROUND_S;
  sphere.theta += right * step;
  sphere.phi = Math.min(Math.PI - LEAST_RAD, Math.max(LEAST_RAD, sphere.phi + up * step));
  eye.copy(target).add(arm.setFromSpherical(sphere));
}
