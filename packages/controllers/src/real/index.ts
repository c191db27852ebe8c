export * from "./face.ts";
