export { staubli } from "./brand.ts";
export { createStaubliFace, type StaubliFaceOptions } from "./driver/index.ts";
export {
  createVirtualStaubli,
  type StaubliMode,
  type StaubliPendant,
  type StaubliStarted,
  type VirtualStaubli,
  type VirtualStaubliOptions,
} from "./virtual/index.ts";
