export * from "./port.ts";
export * from "./weather.ts";
export * from "./memory.ts";
export * from "./faulty.ts";
export { surround, type Surroundings, type Trouble } from "./surroundings.ts";
