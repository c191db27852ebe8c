import {
  add,
  cross,
  distance,
  dot,
  fromAxisAngle,
  isClosed,
  massProperties,
  meshBounds,
  norm,
  normalize,
  ownRobotFile,
  pose,
  robotFromArm,
  robotOfFile,
  scale,
  subtract,
  transformMesh,
  weldMesh,
  type Joint,
  type LinkMass,
  type Pose,
  type Quaternion,
  type TriangleMesh,
  type Vector3,
} from "@twincell/core";
import type { ImportedPart } from "../import/part.ts";
import type { NotUnderstood } from "../refusal.ts";
import { lightLinks } from "./drawn-links.ts";
import type { RobotRead } from "./robot-from-files.ts";

/** A part of the robot where it stands in the world [m] while every joint is at 0. Link 0 is the base. */
export interface RigPart {
  readonly name: string;
  /** `#rrggbb`. */
  readonly color: string;
  readonly mesh: TriangleMesh;
  readonly link: number;
}

/** An axis as it was picked, in the world: a turning joint, or one that slides along it. */
export interface RigJoint {
  readonly name: string;
  readonly kind: "revolute" | "prismatic";
  /** A point of the axis [m], and its direction: turns count right-handed about it. */
  readonly through_m: Vector3;
  readonly axis: Vector3;
  /** Limits [rad; m where it slides] with 0 where the parts stand, and full speed [rad/s; m/s]. */
  readonly lower: number;
  readonly upper: number;
  readonly speed: number;
}

export interface Rig {
  readonly name: string;
  readonly parts: readonly RigPart[];
  /** Base first: each carries the next. */
  readonly joints: readonly RigJoint[];
  /** Middle of the mounting face [m] and its outward direction; the last axis when absent. */
  readonly flange?: { readonly at_m: Vector3; readonly axis: Vector3 };
  /** Of all parts alike [kg/m³]: masses and inertias are those of solids of this density. */
  readonly density_kgm3: number;
}

/** The robot of a rig, as it is kept with a cell, and where its base stands. */
export interface Rigged extends RobotRead {
  readonly worldFromBase: Pose<"world", "base">;
}

/** Points at most this far apart are one [m]; directions, as sines, are parallel. */
const SAME_M = 1e-6;
const UPRIGHT = 1e-3;

/**
 * A robot out of parts and picked axes (rows T-52, N-05). Its links are those parts; all link frames are turned like
 * the world while every joint is at 0, and stand in the picked points:
 *
 *   parentFromJoint_k = Trans(p_k − p_{k−1}),   p_0 the base,   axis_k as picked
 *
 * The base stands at the lowest point of the base's parts: under axis 1 where that is upright, else under their middle.
 * Masses: m = ρ V and I = ρ ∫ (|r|² 1 − r rᵀ) dV about the common centre of the link's parts; a part with open edges
 * counts with the box around it, and a note says so. Without parts on every moving link the robot has no masses.
 *
 * @returns one sentence for a rig that is no robot.
 */
export async function robotFromRig(rig: Rig): Promise<Rigged | NotUnderstood> {
  const wrong = faultOf(rig);
  if (wrong !== undefined) return { kind: "not-understood", sentence: wrong };
  const base = baseOf(rig);
  const pivots: readonly Vector3[] = [base, ...rig.joints.map(({ through_m }) => through_m)];
  const joints = rig.joints.map(
    ({ name, kind, axis, lower, upper, speed }, i): Joint => ({
      name,
      ...(kind === "prismatic" ? { kind } : {}),
      parentFromJoint: pose(subtract(pivots[i + 1]!, pivots[i]!)),
      axis: normalize(axis),
      limits: { lower_rad: lower, upper_rad: upper, speed_rad_s: speed, acceleration_rad_s2: speed / RAMP_S },
    }),
  );
  const last = rig.joints.at(-1)!;
  const { at_m, axis: out } = rig.flange ?? { at_m: last.through_m, axis: last.axis };
  const arm = {
    name: rig.name,
    joints,
    lastJointFromFlange: pose<"joint", "flange">(subtract(at_m, last.through_m), fromZTo(normalize(out))),
  };
  const parts = rig.parts.map(
    ({ color, mesh, link }): ImportedPart => ({
      name: String(link),
      path: [],
      color,
      mesh: transformMesh(mesh, pose(scale(pivots[link]!, -1)) as Pose),
    }),
  );
  const { links, shapeError_m, notes } = await lightLinks(parts, parts, joints.length);
  const weighed = massesOf(rig, pivots);
  const robot = robotFromArm(arm, {
    id: rig.name,
    name: rig.name,
    shapeError_m,
    ...(links ? { links } : {}),
    ...(weighed.masses ? { masses: weighed.masses } : {}),
    assumptions: [
      ...weighed.notes,
      `Joint accelerations were not given: full joint speed is assumed to be reached in ${RAMP_S} s.`,
    ],
    sources: { arm: "Axes that were picked on the parts, with typed limits and speeds." },
  });
  const file = ownRobotFile(robot);
  const kept = robotOfFile(file);
  if (kept.kind === "not-a-robot")
    return { kind: "not-understood", sentence: kept.faults.map(({ sentence }) => sentence).join(" ") };
  return {
    kind: "robot",
    robot: kept.robot,
    file,
    notes: [...notes, ...kept.robot.assumptions],
    worldFromBase: pose(base),
  };
}
/** Seconds from standstill to full speed of a joint. */
const RAMP_S = 0.25;

function faultOf({ parts, joints, density_kgm3 }: Rig): string | undefined {
  if (joints.length === 0) return "A robot has at least one axis: pick a bore, a shaft or a round edge.";
  if (parts.length === 0) return "A robot has at least one part.";
  for (const [i, { axis, lower, upper, speed }] of joints.entries()) {
    const what = `joint ${i + 1}`;
    if (!(norm(axis) > SAME_M)) return `The axis of ${what} has no direction.`;
    if (!(lower < upper)) return `The lower limit of ${what} is not below its upper one.`;
    if (!(speed > 0)) return `The speed of ${what} is not above 0.`;
  }
  const beyond = parts.find(({ link }) => !Number.isInteger(link) || link < 0 || link > joints.length);
  if (beyond) return `${beyond.name} belongs to link ${beyond.link}, but the last link is ${joints.length}.`;
  return density_kgm3 > 0 ? undefined : "The density is above 0.";
}

/** Under axis 1 where it is upright, else under the middle of the base's parts; as low as they reach. */
function baseOf({ parts, joints }: Rig): Vector3 {
  const own = parts.filter(({ link }) => link === 0);
  const [{ through_m, axis }] = [joints[0]!];
  if (own.length === 0) return [...through_m];
  const boxes = own.map(({ mesh }) => meshBounds(mesh));
  const low = Math.min(...boxes.map(({ lower }) => lower[2]));
  if (Math.hypot(axis[0], axis[1]) < UPRIGHT * norm(axis)) return [through_m[0], through_m[1], low];
  const middle = (k: 0 | 1): number =>
    (Math.min(...boxes.map(({ lower }) => lower[k])) + Math.max(...boxes.map(({ upper }) => upper[k]))) / 2;
  return [middle(0), middle(1), low];
}

/** The shortest turn that takes z to a unit vector. */
function fromZTo(axis: Vector3): Quaternion {
  const across = cross([0, 0, 1], axis);
  const sine = norm(across);
  if (sine < 1e-12) return axis[2] > 0 ? [0, 0, 0, 1] : [1, 0, 0, 0];
  return fromAxisAngle(scale(across, 1 / sine), Math.atan2(sine, axis[2]));
}

interface Body {
  readonly mass_kg: number;
  readonly centre_m: Vector3;
  /** Ixx, Iyy, Izz, Ixy, Ixz, Iyz about the centre [kg m²]. */
  readonly inertia_kgm2: readonly number[];
}

function massesOf(
  { parts, joints, density_kgm3 }: Rig,
  pivots: readonly Vector3[],
): { readonly masses?: readonly LinkMass[]; readonly notes: readonly string[] } {
  const open = parts.filter(({ link, mesh }) => link > 0 && !isSolid(mesh));
  const notes = [
    `Masses and inertias are those of solids of ${density_kgm3} kg/m³.`,
    ...open.map(({ name }) => `${name} is not closed: it weighs as much as the box around it.`),
  ];
  const empty = joints.findIndex((_, i) => !parts.some(({ link }) => link === i + 1));
  if (empty >= 0)
    return { notes: [`Link ${empty + 1} has no part: the robot has no masses, and torques are not computed.`] };
  const masses = joints.map((_, i): LinkMass => {
    const bodies = parts.filter(({ link }) => link === i + 1).map(({ mesh }) => bodyOf(mesh, density_kgm3));
    const { mass_kg, centre_m, inertia_kgm2 } = joined(bodies);
    return {
      mass_kg,
      linkFromCentre: pose(subtract(centre_m, pivots[i + 1]!)),
      inertia_kgm2: inertia_kgm2 as [number, number, number, number, number, number],
    };
  });
  return { masses, notes };
}

const isSolid = (mesh: TriangleMesh): boolean =>
  isClosed(weldMesh(mesh, SAME_M).mesh) && massProperties(mesh).volume_m3 > 0;

/** A part as a solid; one that is not closed as the box around it. */
function bodyOf(mesh: TriangleMesh, density: number): Body {
  if (isSolid(mesh)) {
    const { volume_m3, center_m, inertia_m5 } = massProperties(mesh);
    return {
      mass_kg: density * volume_m3,
      centre_m: center_m,
      inertia_kgm2: inertia_m5.map(value => density * value),
    };
  }
  const { lower, upper } = meshBounds(mesh);
  // A sheet has no thickness: it gets a millimetre, so that nothing weighs nothing.
  const [x, y, z] = subtract(upper, lower).map(side => Math.max(side, 1e-3)) as Vector3;
  const mass_kg = density * x * y * z;
  return {
    mass_kg,
    centre_m: scale(add(lower, upper), 0.5),
    inertia_kgm2: [y * y + z * z, x * x + z * z, x * x + y * y, 0, 0, 0].map(value => (mass_kg * value) / 12),
  };
}

/** Several bodies as one, by the parallel axis theorem. */
function joined(bodies: readonly Body[]): Body {
  const mass_kg = bodies.reduce((sum, body) => sum + body.mass_kg, 0);
  const weighted = bodies.reduce((sum, body) => add(sum, scale(body.centre_m, body.mass_kg)), [0, 0, 0] as Vector3);
  const centre_m = scale(weighted, 1 / mass_kg);
  const total = [0, 0, 0, 0, 0, 0];
  for (const { mass_kg: m, centre_m: own, inertia_kgm2 } of bodies) {
    const r = subtract(own, centre_m);
    const rr = dot(r, r);
    const steiner = [rr - r[0] ** 2, rr - r[1] ** 2, rr - r[2] ** 2, -r[0] * r[1], -r[0] * r[2], -r[1] * r[2]];
    for (let k = 0; k < 6; k++) total[k] = total[k]! + inertia_kgm2[k]! + m * steiner[k]!;
  }
  return { mass_kg, centre_m, inertia_kgm2: total };
}

/** Whether two joints turn about one line: picked twice, they would cancel each other. */
export function sameAxis(a: RigJoint, b: RigJoint): boolean {
  const one = normalize(a.axis);
  if (a.kind !== b.kind || norm(cross(one, normalize(b.axis))) > UPRIGHT) return false;
  const between = subtract(b.through_m, a.through_m);
  const along = scale(one, dot(between, one));
  return a.kind === "prismatic" || distance(between, along) < 1e-4;
}
