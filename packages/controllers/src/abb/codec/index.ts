export * from "./egm.ts";
export * from "./egm-module.ts";
export * from "./rws.ts";
