export * from "./forward.ts";
export * from "./branch.ts";
export * from "./reach.ts";
