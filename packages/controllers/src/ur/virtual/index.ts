export type { UrPendant } from "./pendant.ts";
export { createVirtualUr, type UrState, type UrStarted, type VirtualUr, type VirtualUrOptions } from "./controller.ts";
export type { UrFaults } from "./faults.ts";
