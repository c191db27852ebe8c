/** What is felt in the hand: how strongly, 0 … 1, and how long [ms] (row M-22). */
const FEELS = {
  contact: [1, 90],
  limit: [0.7, 45],
  grasp: [0.35, 25],
  gripper: [0.5, 60],
  emergency: [1, 200],
} as const;
export type Feel = keyof typeof FEELS;

/** One buzz of a controller, if it has a motor: bare hands feel nothing and hear it all the same. */
export function feel(source: XRInputSource, what: Feel): void {
  const motor = source.gamepad?.hapticActuators?.[0];
  const [strength, duration_ms] = FEELS[what];
  if (motor) void motor.pulse(strength, duration_ms);
}
