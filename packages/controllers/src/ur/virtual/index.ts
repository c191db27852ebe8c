export { createVirtualUr, type UrOpened, type UrPendant, type UrState, type VirtualUr, type VirtualUrOptions } from "./controller.ts";
export type { UrFaults } from "./faults.ts";
