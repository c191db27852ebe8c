export * from "./stretch.ts";
export * from "./continuity.ts";
export * from "./choose.ts";
