export * from "./faults.ts";
export * from "./lines.ts";
export * from "./numbers.ts";
export * from "./tokens.ts";
