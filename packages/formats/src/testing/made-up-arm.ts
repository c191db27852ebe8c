import {
  fromAxisAngle,
  normalize,
  normalizeQuaternion,
  pose,
  seededRandom,
  type LinkMass,
  type Pose,
  type SerialArm,
} from "@twincell/core";

const random = seededRandom(29);
const any = (): number => Math.round(2000 * random() - 1000) / 1000;
const TURNS = [
  [0, 0, 0, 1],
  fromAxisAngle([0, 1, 0], Math.PI / 2),
  fromAxisAngle([0, 1, 0], -Math.PI / 2),
  fromAxisAngle([1, 0, 0], Math.PI),
  fromAxisAngle([0, 1, 0], Math.PI / 2 - 1e-9),
  null,
  null,
] as const;

/** An arm no maker builds: pitches of 90° and a hair less, axes in any direction. */
export const madeUpArm: SerialArm = {
  name: 'Made <up> & "odd"',
  joints: TURNS.map((turn, i) => ({
    name: `joint_${i + 1}`,
    axis: i % 2 === 0 ? normalize([any(), any(), any()]) : [0, 0, -1],
    parentFromJoint: pose([any(), any(), any()], turn ? [...turn] : normalizeQuaternion([any(), any(), any(), any()])),
    limits: {
      lower_rad: -2 - i / 7,
      upper_rad: 1 + i / 3,
      speed_rad_s: 1 + i / 9,
      acceleration_rad_s2: 4 * (1 + i / 9),
      torque_Nm: 10 * (i + 1),
    },
  })),
  lastJointFromFlange: pose([0.1, -0.2, 0.3], normalizeQuaternion([0.1, 0.7, -0.1, 0.7])),
};
export const madeUpMasses: readonly LinkMass[] = madeUpArm.joints.map((_, i) => ({
  mass_kg: 1 + i / 3,
  linkFromCentre: pose([any(), any(), any()], normalizeQuaternion([any(), any(), any(), any()])),
  inertia_kgm2: [0.2 + i, 0.3 + i, 0.4 + i, 0.01, -0.02, 0.03],
}));
export const madeUpSide = { name: "base", baseFromSide: pose([0, 0, 0.4], fromAxisAngle([0, 0, 1], Math.PI)) as Pose };
