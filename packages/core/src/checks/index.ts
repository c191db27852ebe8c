export * from "./verdict.ts";
export * from "./check.ts";
export * from "./certificate.ts";
export * from "./certificate-file.ts";
export type { CornerArea } from "./corner-area.ts";
export type { CornerCertificate, RefutedClaim } from "./corner-certificate.ts";
export type { CornerPiece } from "./corners.ts";
export * from "./detour.ts";
export { keptSentence } from "./collision.ts";
export { SHARP_RAD, tracedEdgeOf, type TracedEdgeRecord } from "./edges.ts";
export { standOf } from "./stand.ts";
export { GRIP_REACH_M, movedBy, radiusOf, SEAT_M, type CarriedPart, type Seat } from "./grasped-parts.ts";
export { checkHand, type HandCheck, type JointLoad } from "./hand-check.ts";
export * from "./lesson.ts";
export { NEAR_LIMIT_RAD } from "./limits.ts";
export { NEAR_SINGULAR_RAD } from "./singular.ts";
export {
  baseField,
  baseShift,
  ROOMY_RAD,
  suggestBase,
  type BaseField,
  type BaseSquare,
  type SuggestedBase,
} from "./base-field.ts";
export { reachReport, reachTable, type ReachPoint, type ReachReport } from "./reach-report.ts";
export { pathPieces, type PathPiece } from "./path-pieces.ts";
export * from "./repair/index.ts";
