export * from "./mesh.ts";
export * from "./solids.ts";
export * from "./polygon.ts";
export * from "./assemble.ts";
export * from "./measure.ts";
export * from "./weld.ts";
export * from "./mass.ts";
export * from "./link-solid.ts";
