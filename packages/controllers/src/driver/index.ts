export * from "./brand.ts";
export * from "./cannot.ts";
export * from "./adapter.ts";
export { Meter, type Metered } from "./meter.ts";
export { createRealController, type RealOptions } from "./controller.ts";
