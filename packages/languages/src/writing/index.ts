export * from "./text-writer.ts";
export * from "./names.ts";
export * from "./numbers.ts";
export * from "./cannot.ts";
export * from "./place.ts";
export * from "./walk.ts";
export * from "./steps.ts";
export * from "./pattern.ts";
