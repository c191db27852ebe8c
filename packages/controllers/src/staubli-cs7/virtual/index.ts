export {
  createVirtualCs7,
  type Cs7Pendant,
  type Cs7Started,
  type VirtualCs7,
  type VirtualCs7Options,
} from "./controller.ts";
