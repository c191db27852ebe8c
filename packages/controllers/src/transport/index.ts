export * from "./port.ts";
export * from "./weather.ts";
export * from "./memory.ts";
export * from "./faulty.ts";
export { emulateNetwork, type NetworkEmulator, type FaultInjection } from "./surroundings.ts";
