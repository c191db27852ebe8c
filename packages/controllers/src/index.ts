export * from "./refusals.ts";
export * from "./virtual/index.ts";
