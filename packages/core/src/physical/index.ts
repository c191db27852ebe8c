export * from "./scene.ts";
export * from "./people.ts";
export * from "./grasp.ts";
export * from "./lifting.ts";
