export * from "./mesh.ts";
export * from "./cell.ts";
