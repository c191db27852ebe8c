export { kukaAxes } from "./codec/axes.ts";
export { C3_PORT } from "./codec/c3.ts";
export { LOOP_FILES, LOOP_NAME, RSI_FILE, RSI_NAME } from "./codec/loop.ts";
export {
  createVirtualKuka,
  startLoop,
  type KukaPendant,
  type VirtualKuka,
  type VirtualKukaOptions,
} from "./virtual/controller.ts";
export { createKukaAdapter, type KukaAdapterOptions } from "./adapter/adapter.ts";
export { createKukaRsiAdapter, type KukaRsiAdapterOptions } from "./adapter/rsi-adapter.ts";
export { axisConfig, readRsiConfig, rsiConfigText, type RsiConfig } from "./codec/rsi.ts";
export type { RsiOptions } from "./virtual/rsi-run.ts";
export type { KukaFaults } from "./virtual/faults.ts";
export type { KukaMode } from "./virtual/machine.ts";
export { kuka, kukaOverRsi } from "./brand.ts";
