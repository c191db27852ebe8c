/** One buzz of a controller, if it has a motor. @param strength 0 … 1 */
export function pulse(source: XRInputSource, strength: number, duration_ms: number): void {
  const motor = source.gamepad?.hapticActuators?.[0];
  if (motor) void motor.pulse(strength, duration_ms);
}
