export * from "./bounds.ts";
export * from "./snap.ts";
export * from "./arrange.ts";
export * from "./measure.ts";
export * from "./mate.ts";
