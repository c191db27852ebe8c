export * from "./loads.ts";
export * from "./within.ts";
export * from "./gentle.ts";
export * from "./profile.ts";
export * from "./tracking.ts";
