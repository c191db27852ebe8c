/** How far an executed text may be from the program that it is compared with. */
export const PROOF_TOLERANCE = { position_m: 1e-5, angle_rad: (1e-3 / 180) * Math.PI } as const;
