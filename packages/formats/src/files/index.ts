export * from "./source.ts";
export * from "./zip.ts";
export * from "./resolve.ts";
