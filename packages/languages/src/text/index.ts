export * from "./faults.ts";
export * from "./lines.ts";
export * from "./numbers.ts";
export * from "./tokens.ts";
export * from "./waits-outside.ts";
export * from "./rehearse.ts";
export * from "./line-cursor.ts";
export * from "./jumps.ts";
