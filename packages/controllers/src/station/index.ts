export * from "./station.ts";
