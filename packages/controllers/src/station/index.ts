export * from "./station.ts";
export * from "./open.ts";
