export {
  BETWEEN_ROBOTS_M,
  createSharedCell,
  YIELDED_M,
  type Place,
  type PlaceOptions,
  type Seen,
  type SharedCell,
  type SharedCellOptions,
} from "./shared-cell.ts";
