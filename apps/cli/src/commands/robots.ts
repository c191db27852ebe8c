import { LIBRARY, type Robot } from "@twincell/core";
import { given } from "../io/arguments.ts";
import { lineWriter } from "../io/json-lines.ts";
import type { Command } from "../io/usage.ts";

export const robotsCommand: Command = {
  name: "robots",
  summary: "the robots of the library",
  usage: `twincell robots

One JSON line per robot: id, name, vendor, family, dof, payload_kg, mass_kg, reach_m and between which points, shape_error_m,
limits, where each number comes from, what was assumed. made_up_geometry marks an arm whose lengths nobody publishes.
--json is accepted; the output is JSON either way.`,
  async run(args) {
    given(args, { json: { type: "boolean" } });
    const writer = lineWriter();
    for (const robot of LIBRARY) writer.write(lineOf(robot));
    await writer.end();
    return 0;
  },
};

const lineOf = (robot: Robot): object => ({
  id: robot.id, name: robot.name, vendor: robot.vendor, family: robot.family.kind, dof: robot.arm.joints.length,
  payload_kg: robot.payload_kg, ...(robot.mass_kg === undefined ? {} : { mass_kg: robot.mass_kg }),
  reach_m: robot.reach_m, reach_measured_from: robot.reachMeasuredFrom, reach_measured_to: robot.reachMeasuredTo,
  ...(robot.madeUpGeometry === true ? { made_up_geometry: true } : {}),
  shape_error_m: robot.shapeError_m, base: robot.frames.base, tip: robot.frames.tip,
  limits: robot.arm.joints.map(({ name, limits }) => ({ joint: name, ...limits })),
  source: robot.sources, assumptions: robot.assumptions,
});
