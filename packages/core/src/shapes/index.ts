export * from "./solids.ts";
export * from "./polygon.ts";
export * from "./assemble.ts";
export * from "./measure.ts";
export * from "./weld.ts";
export * from "./deviation.ts";
export * from "./mass.ts";
