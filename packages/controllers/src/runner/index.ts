export * from "./runner.ts";
export * from "./text.ts";
