export { fanuc } from "./brand.ts";
export { createFanucAdapter, type FanucAdapterOptions } from "./adapter/adapter.ts";
export {
  createVirtualFanuc,
  type FanucPendant,
  type FanucStarted,
  type VirtualFanuc,
  type VirtualFanucOptions,
} from "./virtual/controller.ts";
