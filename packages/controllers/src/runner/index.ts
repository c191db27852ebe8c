export * from "./runner.ts";
export * from "./text.ts";
export * from "./lines.ts";
