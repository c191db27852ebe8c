export * from "./arm.ts";
export * from "./robot.ts";
export * from "./library/index.ts";
