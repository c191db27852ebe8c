export * from "./arm.ts";
export * from "./robot.ts";
export * from "./derive.ts";
export * from "./foreign.ts";
export * from "./dh.ts";
export * from "./library/index.ts";
export * from "./shapes/index.ts";
