export * from "./arm.ts";
export * from "./robot.ts";
export * from "./library/index.ts";
export * from "./shapes/index.ts";
