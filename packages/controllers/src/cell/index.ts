export {
  BETWEEN_ROBOTS_M,
  createSharedCell,
  YIELDED_M,
  type CellMember,
  type PlaceOptions,
  type Seen,
  type SharedCell,
  type SharedCellOptions,
} from "./shared-cell.ts";
