export * from "./station.ts";
export * from "./open.ts";
export * from "./cabinet.ts";
