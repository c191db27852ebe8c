export { loadEngine, MUJOCO_VERSION, type Engine } from "./engine.ts";
export * from "./world.ts";
export { touches, OVERLAP_M, type Touch } from "./contacts.ts";
export { solidGeoms, solidMass, solidMesh, type Geom } from "./model/solid-geoms.ts";
export { sceneXml, partMass } from "./model/scene.ts";
