import { dirname, join } from "node:path";
import { catalogueRobots, dhFromArm, LIBRARY, type Pose, type Robot } from "@twincell/core";
import { dhTableText, writeDhTable, writeStl, writeUrdf } from "@twincell/formats";
import { given, type Given } from "../io/arguments.ts";
import { lineWriter } from "../io/json-lines.ts";
import { writeOne } from "../io/output.ts";
import { robotOf, ROBOT_OPTIONS, type ChosenRobot } from "../io/robot.ts";
import { UseFault, type Command } from "../io/usage.ts";

export const robotsCommand: Command = {
  name: "robots",
  summary: "the robots of library and catalogue",
  usage: `twincell robots [--urdf R [-o FILE]] [--dh R [--convention standard|modified]]

One JSON line per robot, the library first, then the catalogue (data alone, drawn from dimensions): id, name, vendor, family, dof, payload_kg, mass_kg, reach_m and between which points, shape_error_m,
limits, where each number comes from, what was assumed. made_up_geometry marks an arm whose lengths nobody publishes.
--json is accepted; the output is JSON either way.

  --urdf R         writes that robot as a URDF instead; R may be a file, so a xacro or a D-H table becomes a URDF
  -o FILE          into this file, with a mesh per link in meshes/ beside it
  --dh R           writes its D-H table instead, as JSON that --robot reads
  --convention C   standard or modified (modified when absent)
  --text           the D-H table for people: millimetres and degrees, rounded
  --base, --tip, --arg name:=value   as for fk, for a robot from a file`,
  async run(args) {
    const options = given(args, {
      urdf: { type: "string" },
      dh: { type: "string" },
      convention: { type: "string" },
      text: { type: "boolean" },
      output: { type: "string", short: "o" },
      base: ROBOT_OPTIONS.base,
      tip: ROBOT_OPTIONS.tip,
      arg: ROBOT_OPTIONS.arg,
      json: { type: "boolean" },
    });
    const asUrdf = options.text("urdf");
    const asTable = options.text("dh");
    if (asUrdf !== undefined && asTable !== undefined)
      throw new UseFault("--urdf and --dh are given together.", "Ask for one at a time.");
    if (asUrdf !== undefined) {
      await printUrdf(await robotOf(options, asUrdf), options.text("output"));
      return 0;
    }
    if (asTable !== undefined) {
      await print(tableText(await robotOf(options, asTable), options), options.text("output"));
      return 0;
    }
    const writer = lineWriter();
    for (const robot of [...LIBRARY, ...catalogueRobots()]) writer.write(lineOf(robot));
    await writer.end();
    return 0;
  },
};

const lineOf = (robot: Robot): object => ({
  id: robot.id,
  name: robot.name,
  vendor: robot.vendor,
  family: robot.family.kind,
  dof: robot.arm.joints.length,
  payload_kg: robot.payload_kg,
  ...(robot.mass_kg === undefined ? {} : { mass_kg: robot.mass_kg }),
  reach_m: robot.reach_m,
  reach_measured_from: robot.reachMeasuredFrom,
  reach_measured_to: robot.reachMeasuredTo,
  ...(robot.madeUpGeometry === true ? { made_up_geometry: true } : {}),
  shape_error_m: robot.shapeError_m,
  base: robot.frames.base,
  tip: robot.frames.tip,
  limits: robot.arm.joints.map(({ name, limits }) => ({ joint: name, ...limits })),
  source: robot.sources,
  assumptions: robot.assumptions,
});

async function print(text: string, path: string | undefined): Promise<void> {
  if (path === undefined) process.stdout.write(text);
  else await writeOne(path, text);
}

async function printUrdf({ robot, solids }: ChosenRobot, path: string | undefined): Promise<void> {
  const { base, tip } = robot.frames;
  const hasWorld = base !== "base" && tip !== "base";
  const { solids: parts, notes } = path === undefined ? { solids: [], notes: [] } : solids();
  for (const note of notes) process.stderr.write(`twincell: ${note}\n`);
  const meshes = new Map<number, string[]>();
  for (const [i, { link, mesh }] of parts.entries()) {
    const file = `meshes/${robot.id.replace(/[^\w.-]/g, "_")}-${i}.stl`;
    await writeOne(join(dirname(path ?? ""), file), writeStl(mesh));
    meshes.set(link, [...(meshes.get(link) ?? []), file]);
  }
  await print(
    writeUrdf(robot.arm, {
      base,
      tip,
      masses: robot.masses,
      meshesOf: link => meshes.get(link) ?? [],
      ...(hasWorld ? { side: { name: "base", baseFromSide: robot.baseFromVendorWorld as Pose } } : {}),
    }),
    path,
  );
}

function tableText({ robot: { arm } }: ChosenRobot, options: Given): string {
  const convention = options.text("convention") ?? "modified";
  if (convention !== "standard" && convention !== "modified")
    throw new UseFault(`--convention wants standard or modified, not "${convention}".`);
  return options.flag("text")
    ? dhTableText(
        dhFromArm(arm, convention),
        arm.joints.map(({ name }) => name),
      )
    : writeDhTable(arm, convention);
}
