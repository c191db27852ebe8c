/** Numbers that RTDE, the primary interface and the dashboard share, with the names the dashboard gives them. */
export const ROBOT_MODE = {
  NO_CONTROLLER: -1,
  DISCONNECTED: 0,
  CONFIRM_SAFETY: 1,
  BOOTING: 2,
  POWER_OFF: 3,
  POWER_ON: 4,
  IDLE: 5,
  BACKDRIVE: 6,
  RUNNING: 7,
  UPDATING_FIRMWARE: 8,
} as const;
export type RobotModeName = keyof typeof ROBOT_MODE;
export const SAFETY_MODE = {
  NORMAL: 1,
  REDUCED: 2,
  PROTECTIVE_STOP: 3,
  RECOVERY: 4,
  SAFEGUARD_STOP: 5,
  SYSTEM_EMERGENCY_STOP: 6,
  ROBOT_EMERGENCY_STOP: 7,
  VIOLATION: 8,
  FAULT: 9,
  VALIDATE_JOINT_ID: 10,
  UNDEFINED: 11,
  AUTOMATIC_MODE_SAFEGUARD_STOP: 12,
  SYSTEM_3PE_STOP: 13,
  TP_3PE_STOP: 14,
  IMMI_EMERGENCY_STOP: 15,
  IMMI_SAFEGUARD_STOP: 16,
  PROFISAFE_WAITING_FOR_PARAMETERS: 17,
  PROFISAFE_AUTOMATIC_SAFEGUARD_STOP: 18,
  PROFISAFE_SAFEGUARD_STOP: 19,
  PROFISAFE_EMERGENCY_STOP: 20,
  SAFETY_API_SAFEGUARD_STOP: 22,
} as const;
export type SafetyModeName = keyof typeof SAFETY_MODE;
export const RUNTIME = { STOPPING: 0, STOPPED: 1, PLAYING: 2, PAUSING: 3, PAUSED: 4, RESUMING: 5 } as const;
export const ROBOT_STATUS = { powerOn: 1, programRunning: 2, teachButton: 4, powerButton: 8 } as const;
export const JOINT_MODE = { running: 253, idle: 255, powerOff: 239 } as const;
/** A protective stop cannot be unlocked sooner after it came about [s]. */
export const UNLOCK_AFTER_S = 5;

const nameIn =
  <T extends Readonly<Record<string, number>>>(table: T) =>
  (code: number): string =>
    Object.entries(table).find(([, value]) => value === code)?.[0] ?? String(code);
export const robotModeName = nameIn(ROBOT_MODE);
export const safetyModeName = nameIn(SAFETY_MODE);

export const EMERGENCY_STOPS: ReadonlySet<number> = new Set([
  SAFETY_MODE.SYSTEM_EMERGENCY_STOP,
  SAFETY_MODE.ROBOT_EMERGENCY_STOP,
  SAFETY_MODE.IMMI_EMERGENCY_STOP,
  SAFETY_MODE.PROFISAFE_EMERGENCY_STOP,
]);
export const SAFEGUARD_STOPS: ReadonlySet<number> = new Set([
  SAFETY_MODE.SAFEGUARD_STOP,
  SAFETY_MODE.AUTOMATIC_MODE_SAFEGUARD_STOP,
  SAFETY_MODE.SYSTEM_3PE_STOP,
  SAFETY_MODE.TP_3PE_STOP,
  SAFETY_MODE.IMMI_SAFEGUARD_STOP,
  SAFETY_MODE.PROFISAFE_AUTOMATIC_SAFEGUARD_STOP,
  SAFETY_MODE.PROFISAFE_SAFEGUARD_STOP,
  SAFETY_MODE.SAFETY_API_SAFEGUARD_STOP,
]);

/** Bits of safety_status_bits for a safety mode. */
export function safetyBits(mode: number): number {
  const bit = (n: number): number => 1 << n;
  const stopped = bit(10);
  if (mode === SAFETY_MODE.NORMAL) return bit(0);
  if (mode === SAFETY_MODE.REDUCED) return bit(1);
  if (mode === SAFETY_MODE.PROTECTIVE_STOP) return bit(2) | stopped;
  if (mode === SAFETY_MODE.RECOVERY) return bit(3);
  if (SAFEGUARD_STOPS.has(mode)) return bit(4) | stopped;
  if (mode === SAFETY_MODE.SYSTEM_EMERGENCY_STOP) return bit(5) | bit(7) | stopped;
  if (EMERGENCY_STOPS.has(mode)) return bit(6) | bit(7) | stopped;
  return mode === SAFETY_MODE.VIOLATION ? bit(8) | stopped : bit(9) | stopped;
}
