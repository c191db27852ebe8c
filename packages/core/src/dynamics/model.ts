import type { LinkMass } from "../model/arm.ts";
import { isSlide } from "../model/slide.ts";
import type { Robot } from "../model/robot.ts";
import { compose, type Pose } from "../spatial/pose.ts";
import { rotate } from "../spatial/quaternion.ts";
import type { Vector3 } from "../spatial/vector.ts";

/** What the flange carries, tool included. */
export interface Payload {
  readonly mass_kg: number;
  /** Centre of mass in the flange frame [m]. */
  readonly center_m: Vector3;
  /** About the centre of mass, axes of the flange: Ixx, Iyy, Izz, Ixy, Ixz, Iyz [kg m²]. A point when left out. */
  readonly inertia_kgm2?: readonly [number, number, number, number, number, number];
}

/**
 * Two loads as one: masses add, centres average by mass, inertias move to the common centre,
 *   I = Σ I_i + m_i (d·d 1 − d dᵀ).
 */
export function carriedTogether(a: Payload, b: Payload): Payload {
  const mass_kg = a.mass_kg + b.mass_kg;
  if (!(mass_kg > 0)) return a;
  const center_m = a.center_m.map(
    (length, k) => (a.mass_kg * length + b.mass_kg * b.center_m[k]!) / mass_kg,
  ) as Vector3;
  const sum: [number, number, number, number, number, number] = [0, 0, 0, 0, 0, 0];
  for (const { mass_kg: m, center_m: c, inertia_kgm2: i = [0, 0, 0, 0, 0, 0] } of [a, b]) {
    const x = c[0] - center_m[0];
    const y = c[1] - center_m[1];
    const z = c[2] - center_m[2];
    const moved = [m * (y * y + z * z), m * (x * x + z * z), m * (x * x + y * y), -m * x * y, -m * x * z, -m * y * z];
    for (let k = 0; k < 6; k++) sum[k]! += i[k]! + moved[k]!;
  }
  return { mass_kg, center_m, inertia_kgm2: sum };
}

/** An arm as masses that turn about axes: read-only, shared by any number of callers. */
export interface DynamicsModel {
  readonly robot: Robot;
  /**
   * Per link: mass, first moment (3), inertia about the link's origin Ixx Iyy Izz Ixy Ixz Iyz; in the link's frame
   * after its turn.
   */
  readonly bodies: Float64Array;
  /** Inertia that a motor adds at its joint, rotor inertia · gear² [kg m²]; 0 where nobody publishes it. */
  readonly rotors_kgm2: Float64Array;
  /** 1 where the joint slides: its torque is a force [N], its inertia a mass [kg]. */
  readonly slides: Uint8Array;
  /** Acceleration of free fall in the base frame [m/s²]. */
  readonly gravity_mps2: Vector3;
}

export type DynamicsAnswer =
  | { readonly kind: "known"; readonly model: DynamicsModel }
  /** what is not published is not guessed. */
  | { readonly kind: "unknown"; readonly sentence: string };

/** Standard acceleration of free fall (CGPM 1901) [m/s²]. */
export const GRAVITY_MPS2 = 9.80665;
export const BODY = 10;

export interface DynamicsOptions {
  readonly payload?: Payload;
  /** How the robot stands; upright by default. Turns gravity into its base. */
  readonly worldFromBase?: Pose<"world", "base">;
}

/**
 * The masses of a robot and of what it carries, ready for the algorithms of this folder. Links 1 … n are counted; the
 * base stands still. Where a link's mass is published without centre or inertia the answer is unknown: a torque from
 * half the numbers would look like one.
 */
export function dynamicsModel(robot: Robot, options: DynamicsOptions = {}): DynamicsAnswer {
  const { joints, lastJointFromFlange } = robot.arm;
  const n = joints.length;
  const { masses } = robot;
  if (!masses || masses.length !== n) return unknown(robot, "the masses of its links are not published");
  const bodies = new Float64Array(n * BODY);
  for (let i = 0; i < n; i++) {
    const { mass_kg, linkFromCentre, inertia_kgm2 }: LinkMass = masses[i]!;
    if (!linkFromCentre || !inertia_kgm2)
      return unknown(robot, `centre of mass and inertia of link ${i + 1} are not published`);
    addBody(bodies, i, mass_kg, linkFromCentre, inertia_kgm2);
  }
  const { payload, worldFromBase } = options;
  if (payload && payload.mass_kg > 0) {
    const placed = compose(lastJointFromFlange, { position: payload.center_m, quaternion: [0, 0, 0, 1] } as Pose<
      "flange",
      "centre"
    >);
    addBody(bodies, n - 1, payload.mass_kg, placed, payload.inertia_kgm2 ?? [0, 0, 0, 0, 0, 0]);
  }
  const rotors_kgm2 = Float64Array.from(joints, ({ drive }) => (drive ? drive.rotorInertia_kgm2 * drive.gear ** 2 : 0));
  const gravity_mps2: Vector3 = [0, 0, -GRAVITY_MPS2];
  if (worldFromBase) {
    const [x, y, z, w] = worldFromBase.quaternion;
    rotate([-x, -y, -z, w], [0, 0, -GRAVITY_MPS2], gravity_mps2);
  }
  return {
    kind: "known",
    model: {
      robot,
      bodies,
      rotors_kgm2,
      slides: Uint8Array.from(joints, joint => (isSlide(joint) ? 1 : 0)),
      gravity_mps2,
    },
  };
}

const unknown = (robot: Robot, because: string): DynamicsAnswer => ({
  kind: "unknown",
  sentence: `The torques of ${robot.name} are unknown: ${because}.`,
});

/**
 * Adds a body to a link: masses, first moments, and inertias moved to the link's origin, I_o = R I Rᵀ + m (c·c 1 − c
 * cᵀ).
 */
function addBody(
  bodies: Float64Array,
  link: number,
  mass_kg: number,
  linkFromCentre: Pose,
  inertia: readonly [number, number, number, number, number, number],
): void {
  const [cx, cy, cz] = linkFromCentre.position;
  const q = linkFromCentre.quaternion;
  const ex = rotate(q, [1, 0, 0]);
  const ey = rotate(q, [0, 1, 0]);
  const ez = rotate(q, [0, 0, 1]);
  const [xx, yy, zz, xy, xz, yz] = inertia;
  const turned = (a: 0 | 1 | 2, b: 0 | 1 | 2): number =>
    ex[a] * (xx * ex[b] + xy * ey[b] + xz * ez[b]) +
    ey[a] * (xy * ex[b] + yy * ey[b] + yz * ez[b]) +
    ez[a] * (xz * ex[b] + yz * ey[b] + zz * ez[b]);
  const at = link * BODY;
  const cc = cx * cx + cy * cy + cz * cz;
  const parts = [
    mass_kg,
    mass_kg * cx,
    mass_kg * cy,
    mass_kg * cz,
    turned(0, 0) + mass_kg * (cc - cx * cx),
    turned(1, 1) + mass_kg * (cc - cy * cy),
    turned(2, 2) + mass_kg * (cc - cz * cz),
    turned(0, 1) - mass_kg * cx * cy,
    turned(0, 2) - mass_kg * cx * cz,
    turned(1, 2) - mass_kg * cy * cz,
  ];
  parts.forEach((value, i) => {
    bodies[at + i]! += value;
  });
}
