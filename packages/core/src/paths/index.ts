export * from "./topology.ts";
export { featureEdges, type EdgeChain, type FeatureEdges, type FeatureOptions } from "./features.ts";
export * from "./pick.ts";
export {
  curveOfChain,
  curvesOfLoop,
  helperCurve,
  moveCurve,
  pathDeviation,
  distanceToPolyline,
  type Deviation,
  type EdgeCurve,
} from "./curve.ts";
export * from "./trace.ts";
export * from "./refine.ts";
export { surfaceFeatureAt, type SurfaceFeature } from "./surface-feature.ts";
