export * from "./arm.ts";
export * from "./slide.ts";
export * from "./stand.ts";
export * from "./jerk.ts";
export * from "./robot.ts";
export * from "./form.ts";
export * from "./vendor.ts";
