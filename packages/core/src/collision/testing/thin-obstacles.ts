import {
  boxMesh,
  CellCollider,
  certifyMotion,
  checkMotion,
  fromAxisAngle,
  jointLine,
  flangePose,
  pose,
  transformMesh,
  transformPoint,
  verifyCertificate,
  type JointMotion,
  type Random,
  type Vector3,
} from "../../index.ts";
import { planarArm, planarCell } from "./test-arm.ts";

const needle = transformMesh(boxMesh([0.1, 0.0002, 0.0002]), pose([0.05, 0, 0]));
const plate = boxMesh([0.002, 0.0001, 0.002]);
const SAMPLES_APART_M = 0.005;

/**
 * How many plates 0.1 mm thin, each across the way of a needle 0.2 mm thin, are seen by samples 5 mm apart and by the
 * continuous check.
 */
export interface ThinResult {
  /** Cases in which samples 5 mm apart along the way of the tip see nothing. */
  readonly unsampled: number;
  /** Of these, how many motions the continuous check let pass, or stopped only after the plate. */
  readonly missed: number;
  /**
   * Cases with the plate 5 mm above the way, that were proven clear, and whose certificates were confirmed by the
   * second proof.
   */
  readonly certified: number;
  readonly confirmed: number;
}

/**
 * Draws random motions until `cases` plates are between the samples; every `certifyEach`-th is also certified with the
 * plate out of the way.
 */
export function thinObstacles(cases: number, certifyEach: number, random: Random): ThinResult {
  const collider = new CellCollider(
    planarCell([{ id: "plate", name: "Plate", mesh: plate, worldFromObject: pose() }], {
      tool: { name: "needle", mesh: needle },
    }),
    planarArm,
  );
  const q = new Float64Array(3);
  const tipAt = (motion: JointMotion, t: number, along_m: number): Vector3 => {
    motion.sample(t, q);
    return transformPoint(flangePose(planarArm, q), [along_m, 0, 0]);
  };
  let unsampled = 0;
  let missed = 0;
  let certified = 0;
  let confirmed = 0;
  while (unsampled < cases) {
    const from = [0, 1, 2].map(() => 2.4 * random() - 1.2);
    const motion = jointLine(
      from,
      from.map(angle => angle + random() - 0.5),
    );
    const at = 0.2 + 0.6 * random();
    const middle = tipAt(motion, at, 0.0995);
    const next = tipAt(motion, at + 1e-6, 0.0995);
    const across = fromAxisAngle([0, 0, 1], Math.atan2(next[1] - middle[1], next[0] - middle[0]) - Math.PI / 2);
    let way_m = 0;
    for (let i = 0, last = tipAt(motion, 0, 0.1); i < 50; i++) {
      const here = tipAt(motion, (i + 1) / 50, 0.1);
      way_m += Math.hypot(here[0] - last[0], here[1] - last[1]);
      last = here;
    }
    collider.moveObject("plate", pose(middle, across));
    let seen = false;
    for (let i = 0, n = Math.ceil(way_m / SAMPLES_APART_M); i <= n && !seen; i++) {
      motion.sample(i / n, q);
      seen = collider.collides(q);
    }
    if (seen) continue;
    unsampled++;
    const verdict = checkMotion(collider, motion, 0, 1);
    if (verdict.kind !== "contact" || verdict.b !== "plate" || verdict.at > at + 1e-3) missed++;
    if (unsampled % certifyEach !== 0) continue;
    collider.moveObject("plate", pose([middle[0], middle[1], 0.03], across));
    const { certificate } = certifyMotion(collider, motion, 0, 1, { margin_m: 0.001 });
    if (!certificate) continue;
    certified++;
    if (verifyCertificate(collider, planarArm, motion, certificate).kind === "confirmed") confirmed++;
  }
  return { unsampled, missed, certified, confirmed };
}
