export * from "./program.ts";
export * from "./verdict.ts";
