import type { DriverKind } from "@twincell/controllers";
import type { Robot } from "@twincell/core";
import { PLUG_IN, PLUG_IN_PORT } from "@twincell/protocol";
import { createPlugInAdapter } from "./plug-in-face.ts";

/**
 * A maker's own driver as a brand for that robot, whoever makes it. There is no virtual controller: what a plug-in does
 * is not known here.
 */
export const plugInFor = (robot: Robot): DriverKind => ({
  id: PLUG_IN,
  name: "Plug-in",
  dialect: "l-irl",
  ports: { [PLUG_IN]: PLUG_IN_PORT },
  vendor: robot.vendor,
  drives: () => true,
  cannot: [{ row: "texts", because: "A plug-in takes steps, no program texts." }],
  face: createPlugInAdapter,
  virtual: () =>
    Promise.resolve({
      kind: "taken",
      sentence: "A plug-in has no virtual controller: give the address where it runs.",
    }),
});
