export {
  createVirtualAbb,
  type AbbPendant,
  type AbbStart,
  type VirtualAbb,
  type VirtualAbbOptions,
} from "./controller.ts";
