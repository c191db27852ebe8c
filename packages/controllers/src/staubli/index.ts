export { staubli } from "./brand.ts";
export { createStaubliAdapter, type StaubliAdapterOptions } from "./adapter/index.ts";
export {
  createVirtualStaubli,
  type StaubliMode,
  type StaubliPendant,
  type StaubliStarted,
  type VirtualStaubli,
  type VirtualStaubliOptions,
} from "./virtual/index.ts";
