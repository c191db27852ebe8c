export * from "./tree.ts";
export * from "./scanner.ts";
export * from "./cursor.ts";
export * from "./expression.ts";
export * from "./machine.ts";
export * from "./constants.ts";
export * from "./changes.ts";
export * from "./outline.ts";
