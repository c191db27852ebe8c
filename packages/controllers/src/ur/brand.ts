import type { DriverKind } from "../driver/index.ts";
import { UR_CANNOT } from "./cannot.ts";
import { UR_PORTS, countsAsUr } from "./codec/models.ts";
import { createUrAdapter } from "./adapter/index.ts";
import { createVirtualUr } from "./virtual/index.ts";

export const universalRobots: DriverKind = {
  id: "ur",
  name: "Universal Robots",
  dialect: "urscript",
  ports: { ...UR_PORTS },
  vendor: "Universal Robots",
  cannot: UR_CANNOT,
  drives: countsAsUr,
  face: createUrAdapter,
  virtual: createVirtualUr,
};
