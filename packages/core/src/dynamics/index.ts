export * from "./model.ts";
export { dynamicsScratch, type DynamicsScratch } from "./placed.ts";
export * from "./inverse-dynamics.ts";
export * from "./mass-matrix.ts";
export * from "./forward-dynamics.ts";
export * from "./drive.ts";
export * from "./computed-torque.ts";
