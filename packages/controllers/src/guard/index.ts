export { createGuard, GUARD_NOTICE } from "./guard.ts";
export type { Commander, Guard, GuardOptions } from "./interface.ts";
export {
  AT_FIRST,
  guardStep,
  mayMove,
  type GuardAnswer,
  type GuardDenial,
  type GuardEffect,
  type GuardEvent,
  type GuardRules,
  type GuardState,
} from "./state.ts";
export { PlannedPath } from "./known-path.ts";
export { jointMoveSpeed, slowed, speedBound } from "./speed.ts";
export { clearOf, type ClearOf, type ClearOfOptions } from "./clear-of.ts";
