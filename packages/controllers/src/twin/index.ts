export * from "./twin.ts";
