import type { Brand } from "../real/index.ts";
import { UR_CANNOT } from "./cannot.ts";
import { UR_PORTS } from "./codec/models.ts";
import { createUrFace } from "./driver/index.ts";
import { createVirtualUr } from "./virtual/index.ts";

export const universalRobots: Brand = {
  id: "ur",
  name: "Universal Robots",
  dialect: "urscript",
  ports: { ...UR_PORTS },
  vendor: "Universal Robots",
  cannot: UR_CANNOT,
  face: createUrFace,
  virtual: createVirtualUr,
};
