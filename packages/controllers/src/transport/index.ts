export * from "./port.ts";
export * from "./weather.ts";
export * from "./memory.ts";
