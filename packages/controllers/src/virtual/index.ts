export * from "./controller.ts";
export { neutralPendant, type NeutralPendantOptions } from "./pendant.ts";
