export {
  explainCause,
  explainPose,
  repairPose,
  REPAIR_ROOM_RAD,
  type PoseCause,
  type PoseQuestion,
  type PoseRepair,
} from "./pose-repair.ts";
export { changedPose, effortOf, type PoseChange } from "./change.ts";
export {
  shiftedPose,
  RepairSearch,
  withRepair,
  type BindingCause,
  type Explanation,
  type ProvenRepair,
  type RepairOptions,
  type RepairOutcome,
} from "./repair-search.ts";
export { repairAll, type RepairedProgram } from "./repair-all.ts";
