export * from "./rigid.ts";
export * from "./values.ts";
export * from "./upright.ts";
export * from "./reader.ts";
export * from "./machine.ts";
export * from "./doors.ts";
