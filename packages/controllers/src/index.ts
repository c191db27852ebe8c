export * from "./refusals.ts";
export * from "./virtual/index.ts";
export * from "./twin/index.ts";
export * from "./guard/index.ts";
export * from "./runner/index.ts";
export * from "./real/index.ts";
export * from "./station/index.ts";
export * from "./transport/index.ts";
