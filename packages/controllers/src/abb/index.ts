export { abb, abbOverEgm } from "./brand.ts";
export { abbEgmAdapter, abbAdapter, type AbbEgmAdapterOptions, type AbbAdapterOptions } from "./adapter/index.ts";
export {
  createVirtualAbb,
  type AbbPendant,
  type AbbStart,
  type VirtualAbb,
  type VirtualAbbOptions,
} from "./virtual/index.ts";
