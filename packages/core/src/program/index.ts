export * from "./program.ts";
export * from "./verdict.ts";
export * from "./parse.ts";
export * from "./edit.ts";
export * from "./stepper.ts";
export * from "./check.ts";
export { NEAR_LIMIT_RAD } from "./checks/limits.ts";
export { NEAR_SINGULAR_RAD } from "./checks/singular.ts";
