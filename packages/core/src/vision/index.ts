export * from "./tags.ts";
export * from "./lens.ts";
export * from "./detector.ts";
export * from "./planar-pose.ts";
export * from "./pose-filter.ts";
export * from "./sheet.ts";
export * from "./tracker.ts";
export * from "./calibrate-lens.ts";
