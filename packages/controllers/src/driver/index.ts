export * from "./brand.ts";
export * from "./cannot.ts";
export * from "./adapter.ts";
export { DriverStates, Execution, type DriverPhase, type Underway } from "./states.ts";
export { startedDriver, type VirtualParts } from "./started.ts";
export { stepOfMotion } from "./motion.ts";
export { Meter, type Metered } from "./meter.ts";
export { reachableSteps, stepsRefusal } from "./sayable.ts";
export { createRealController, type RealOptions } from "./controller.ts";
