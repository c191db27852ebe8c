export * from "./empty.ts";
export * from "./edge-trace.ts";
