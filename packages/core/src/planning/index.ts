export { WayChecker, distanceBetween, type WayRules } from "./way-checker.ts";
export { findWay, lengthOf, type WayOptions, type WayOutcome } from "./find-way.ts";
export { shorten } from "./shorten.ts";
export { untangle, type Untangled } from "./untangle.ts";
export { COLLISION_BEHAVIOURS, HandGuard, type CollisionBehaviour, type HandStep } from "./hand-guard.ts";
