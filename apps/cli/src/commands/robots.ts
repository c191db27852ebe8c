import { LIBRARY } from "@twincell/core";
import { given } from "../io/arguments.ts";
import { lineWriter } from "../io/json-lines.ts";
import type { Command } from "../io/usage.ts";

export const robotsCommand: Command = {
  name: "robots",
  summary: "the robots of the library",
  usage: `twincell robots

One JSON line per robot: id, name, vendor, family, dof, payload_kg, reach_m, where each number comes from, what was assumed.`,
  async run(args) {
    given(args, { json: { type: "boolean" } });
    const writer = lineWriter();
    for (const robot of LIBRARY) {
      writer.write({
        id: robot.id, name: robot.name, vendor: robot.vendor, family: robot.family.kind, dof: robot.arm.joints.length,
        payload_kg: robot.payload_kg, reach_m: robot.reach_m, reach_measured_to: robot.reachMeasuredTo,
        base: robot.frames.base, tip: robot.frames.tip,
        limits: robot.arm.joints.map(({ name, limits }) => ({ joint: name, ...limits })),
        source: robot.sources, assumptions: robot.assumptions,
      });
    }
    await writer.end();
    return 0;
  },
};
