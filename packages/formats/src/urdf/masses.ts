import { compose, toMatrix, transformPoint, type LinkMass, type Pose, type Vector3 } from "@twincell/core";
import type { UrdfRobot } from "./model.ts";

/** Where the links of a file are in the arm: the moving link they are bolted to, and how they lie to it. */
export type LinkPlaces = ReadonlyMap<string, { readonly link: number; readonly armLinkFromLink: Pose }>;

/**
 * Masses of the moving links 1 … n, each with all that is bolted to it; undefined unless every one has a mass and an
 * inertia, for half of them says nothing about torques.
 *
 *   I = Σ ( R I_k Rᵀ + m_k ( |r_k|² 1 − r_k r_kᵀ ) ),   r_k from the common centre to that of part k
 */
export function massesOf(robot: UrdfRobot, places: LinkPlaces, joints: number): readonly LinkMass[] | undefined {
  const parts: { readonly mass: number; readonly centre: Vector3; readonly inertia: readonly number[] }[][] =
    Array.from({ length: joints + 1 }, () => []);
  for (const { name, inertial } of robot.links) {
    const place = places.get(name);
    if (!place || !inertial || !(inertial.mass_kg > 0)) continue;
    const armLinkFromInertial = compose(place.armLinkFromLink, inertial.linkFromInertial as Pose);
    parts[place.link]!.push({
      mass: inertial.mass_kg,
      centre: transformPoint(armLinkFromInertial, [0, 0, 0]),
      inertia: turned(inertial.inertia_kg_m2, armLinkFromInertial),
    });
  }
  const moving = parts.slice(1);
  if (
    moving.length === 0 ||
    moving.some(link => link.length === 0 || link.some(({ inertia }) => inertia.every(value => value === 0)))
  )
    return undefined;
  return moving.map(link => {
    const mass_kg = link.reduce((sum, part) => sum + part.mass, 0);
    const centre = [0, 1, 2].map(
      k => link.reduce((sum, part) => sum + part.mass * part.centre[k]!, 0) / mass_kg,
    ) as Vector3;
    const total = [0, 0, 0, 0, 0, 0];
    for (const { mass, centre: own, inertia } of link) {
      const x = own[0] - centre[0];
      const y = own[1] - centre[1];
      const z = own[2] - centre[2];
      [
        mass * (y * y + z * z),
        mass * (x * x + z * z),
        mass * (x * x + y * y),
        -mass * x * y,
        -mass * x * z,
        -mass * y * z,
      ].forEach((steiner, k) => {
        total[k]! += inertia[k]! + steiner;
      });
    }
    const [xx, yy, zz, xy, xz, yz] = total;
    return {
      mass_kg,
      linkFromCentre: { position: centre, quaternion: [0, 0, 0, 1] },
      inertia_kgm2: [xx!, yy!, zz!, xy!, xz!, yz!],
    };
  });
}

/**
 * Inertia in the file's order (xx xy xz yy yz zz) turned into the arm link's directions, in core's order (xx yy zz xy
 * xz yz).
 */
function turned(
  [xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0]: readonly number[],
  armLinkFromInertial: Pose,
): readonly number[] {
  const R = toMatrix(armLinkFromInertial.quaternion);
  const I = [
    [xx, xy, xz],
    [xy, yy, yz],
    [xz, yz, zz],
  ];
  const at = (r: number, c: number): number => {
    let sum = 0;
    for (let i = 0; i < 3; i++) for (let j = 0; j < 3; j++) sum += R[3 * r + i]! * I[i]![j]! * R[3 * c + j]!;
    return sum;
  };
  return [at(0, 0), at(1, 1), at(2, 2), at(0, 1), at(0, 2), at(1, 2)];
}
