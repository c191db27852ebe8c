export { createGuard, GUARD_NOTICE, type Guard, type GuardOptions, type Commander } from "./guard.ts";
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
