export {
  createVirtualYaskawa,
  type VirtualYaskawa,
  type VirtualYaskawaOptions,
  type YaskawaPendant,
  type YaskawaStart,
} from "./controller.ts";
export type { Faults as YaskawaFaults } from "./faults.ts";
export type { Interpret as YaskawaInterpret, KeySwitch as YaskawaKeySwitch } from "./machine.ts";
