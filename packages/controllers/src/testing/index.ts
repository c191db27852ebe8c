export { manualScheduler } from "@twincell/core";
export * from "./contract.ts";
export * from "./ended.ts";
export * from "./network.ts";
export * from "./in-memory-adapter.ts";
export * from "./numeric.ts";
export * from "./rows.ts";
export * from "./spoiled.ts";
export { createVirtualController } from "../virtual/index.ts";
