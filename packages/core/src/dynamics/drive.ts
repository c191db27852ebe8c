/** Stiffness and damping of a joint's drive, and the torque it never exceeds. */
export interface DriveGains {
  /** [N m/rad] */
  readonly stiffness: number;
  /** [N m s/rad] */
  readonly damping: number;
  readonly torqueMax_Nm: number;
}

/** What a drive is laid out for: full torque is reached at these errors together. */
export interface DriveTask {
  /** Inertia that the drive moves [kg m²]. The source takes the link's mass for it (E-23). */
  readonly inertia: number;
  readonly torqueMax_Nm: number;
  /** Largest errors of angle [rad] and speed [rad/s] before the torque is at its limit. */
  readonly errorMax_rad: number;
  readonly speedErrorMax_rad_s: number;
}

/**
 * Torque of a joint's drive (row L-12, with the signs of physics, E-23), held within its limit (rows L-15, L-70).
 *
 *   τ = k (target − q) + b (targetSpeed − q̇),   |τ| ≤ τ_max
 */
export function driveTorque(
  gains: DriveGains,
  target_rad: number,
  q_rad: number,
  targetSpeed_rad_s: number,
  qd_rad_s: number,
): number {
  const torque_Nm = gains.stiffness * (target_rad - q_rad) + gains.damping * (targetSpeed_rad_s - qd_rad_s);
  return Math.max(-gains.torqueMax_Nm, Math.min(gains.torqueMax_Nm, torque_Nm));
}

/** Damping that just does not swing (rows L-13, L-14):  b = 2 √(k J). */
export const criticalDamping = (stiffness: number, inertia: number): number => 2 * Math.sqrt(stiffness * inertia);

/** How a drive swings: below 1 it overshoots, at 1 it is as fast as without:  ζ = b / (2 √(k J)). */
export const dampingRatio = (stiffness: number, damping: number, inertia: number): number =>
  damping / (2 * Math.sqrt(stiffness * inertia));

/**
 * Gains from what the drive may cost, in closed form (row L-16): full torque at both largest errors, critically damped.
 *
 *   τ_max = k EP + b EV,  b = 2 √(k m)   ⇒   √k = ( √(m EV² + EP τ_max) − EV √m ) / EP
 *
 * @see Devic, Vidakovic, Zivkovic, Machines 2024, 12(7) 480, Eqs 6–8; golden G-01.
 */
export function driveGains({ inertia, torqueMax_Nm, errorMax_rad, speedErrorMax_rad_s }: DriveTask): DriveGains {
  const root =
    (Math.sqrt(inertia * speedErrorMax_rad_s ** 2 + errorMax_rad * torqueMax_Nm) -
      speedErrorMax_rad_s * Math.sqrt(inertia)) /
    errorMax_rad;
  const stiffness = root * root;
  return { stiffness, damping: criticalDamping(stiffness, inertia), torqueMax_Nm };
}

/**
 * The gains of a joint of a real arm: critically damped for what it turns there, the links' inertia M_ii and its own
 * rotor's.
 *
 *   b = 2 √( k (M_ii + J gear²) )
 *
 * @param massDiagonal_kgm2  M_ii of `massMatrix`, rotors included.
 */
export const armDriveGains = (stiffness: number, massDiagonal_kgm2: number, torqueMax_Nm: number): DriveGains => ({
  stiffness,
  damping: criticalDamping(stiffness, massDiagonal_kgm2),
  torqueMax_Nm,
});
