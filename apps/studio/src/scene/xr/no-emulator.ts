/**
 * Stands in for the headset emulator's rooms and menus, which the studio never opens (`emulate: false`): tests bring
 * their own emulator.
 */
export const DevUI = undefined;
export const SyntheticEnvironmentModule = undefined;
