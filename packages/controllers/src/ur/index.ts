export { universalRobots } from "./brand.ts";
export { createUrAdapter } from "./adapter/index.ts";
export * from "./virtual/index.ts";
export { UR_PORTS, type UrPorts } from "./codec/models.ts";
export { ROBOT_MODE, RUNTIME, SAFETY_MODE } from "./codec/modes.ts";
