export * from "./jogged.ts";
export * from "./jog.ts";
