export * from "./egm.ts";
