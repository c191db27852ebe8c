export * from "./program.ts";
export * from "./verdict.ts";
export * from "./parse.ts";
export * from "./edit.ts";
export * from "./stepper.ts";
