export {
  createVirtualStaubli,
  type StaubliPendant,
  type StaubliStarted,
  type VirtualStaubli,
  type VirtualStaubliOptions,
} from "./controller.ts";
export type { StaubliMode } from "./machine.ts";
