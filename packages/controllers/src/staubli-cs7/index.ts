export { staubliCs7 } from "./brand.ts";
export { createCs7Adapter, type Cs7FaceOptions } from "./adapter/index.ts";
export {
  createVirtualCs7,
  type Cs7Pendant,
  type Cs7Started,
  type VirtualCs7,
  type VirtualCs7Options,
} from "./virtual/index.ts";
