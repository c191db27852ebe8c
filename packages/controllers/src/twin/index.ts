export * from "./twin.ts";
export * from "./deviation.ts";
export * from "./look-ahead.ts";
