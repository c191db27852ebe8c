export * from "./codec.ts";
export * from "./shape.ts";
