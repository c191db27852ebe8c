export * from "./document.ts";
export * from "./open.ts";
export * from "./save.ts";
export * from "./programs.ts";
export * from "./coords.ts";
export * from "./history.ts";
export * from "./mesh/index.ts";
export * from "./example/index.ts";
