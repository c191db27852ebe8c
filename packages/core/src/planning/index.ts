export { PathValidator, distanceBetween, type PathRules } from "./path-validator.ts";
export { findPath, lengthOf, type PathOptions, type PathOutcome } from "./find-path.ts";
export { shorten } from "./shorten.ts";
export { escapeSelfCollision, type SelfCollisionEscape } from "./escape-self-collision.ts";
export { COLLISION_BEHAVIOURS, HandGuard, type CollisionBehaviour, type HandStep } from "./hand-guard.ts";
