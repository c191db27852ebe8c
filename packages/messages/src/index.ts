export * from "./acts.ts";
export * from "./ask.ts";
export * from "./tell.ts";
export * from "./read.ts";
export * from "./host.ts";
export * from "./client.ts";
