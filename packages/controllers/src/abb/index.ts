export { abb } from "./brand.ts";
export { abbEgmFace, abbFace, type AbbEgmFaceOptions, type AbbFaceOptions } from "./driver/index.ts";
export {
  createVirtualAbb,
  type AbbPendant,
  type AbbStart,
  type VirtualAbb,
  type VirtualAbbOptions,
} from "./virtual/index.ts";
