export * from "./codec.ts";
export * from "./shape.ts";
export * from "./connection-cell.ts";
