export * from "./topology.ts";
export { featureEdges, type EdgeChain, type FeatureEdges, type FeatureOptions } from "./features.ts";
export * from "./pick.ts";
