export * from "./controller.ts";
export * from "./execution.ts";
