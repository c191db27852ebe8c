export * from "./empty.ts";
export * from "./edge-trace.ts";
export * from "./traced-carton.ts";
export * from "./as-joints.ts";
export * from "./conveyor-pallet.ts";
export * from "./tasks.ts";
export * from "./gallery.ts";
