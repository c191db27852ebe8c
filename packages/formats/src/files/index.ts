export * from "./source.ts";
export * from "./resolve.ts";
