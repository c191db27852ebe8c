export * from "./twin.ts";
export * from "./deviation.ts";
