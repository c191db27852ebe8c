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
  usage: `twincell robots [--maker M] [--find TEXT] [--reach MM] [--payload KG] [--text]
       twincell robots [--urdf R [-o FILE]] [--dh R [--convention standard|modified]]

One JSON line per robot, the library first, then the catalogue (data alone, drawn from dimensions): id, name, vendor,
family, dof, payload_kg (null where no source states it), mass_kg, reach_m and between which points, shape_error_m,
limits, where each number comes from, what was assumed. made_up_geometry marks an arm whose lengths nobody publishes,
unverified one whose kinematics no other program was held against. --json is accepted; the output is JSON either way.

  --maker M        robots of that maker only, by the beginning of its name: kuka, universal
  --find TEXT      robots whose id, name or maker contain every word of the text
  --reach MM       robots that reach at least that far [mm]
  --payload KG     robots that carry at least that much [kg]; those whose payload is unknown come last and say so

  --urdf R         writes that robot as a URDF instead; R may be a file, so a xacro or a D-H table becomes a URDF
  -o FILE          into this file, with a mesh per link in meshes/ beside it
  --dh R           writes its D-H table instead, as JSON that --robot reads
  --convention C   standard or modified (modified when absent)
  --text           for people: the list as a table; with --dh millimetres and degrees, rounded
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
      maker: { type: "string" },
      find: { type: "string" },
      reach: { type: "string" },
      payload: { type: "string" },
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
    const found = chosen([...LIBRARY, ...catalogueRobots()], options);
    if (found.length === 0) {
      process.stderr.write('twincell: No robot is like that. "twincell robots --text" lists all of them.\n');
      return 1;
    }
    const writer = lineWriter();
    if (options.flag("text")) for (const robot of found) process.stdout.write(textOf(robot));
    else for (const robot of found) writer.write(lineOf(robot));
    await writer.end();
    return 0;
  },
};

/** Robots by the filters of the command line; with `--payload` those of unknown payload stand last. */
function chosen(robots: readonly Robot[], options: Given): readonly Robot[] {
  const maker = options.text("maker")?.toLowerCase() ?? "";
  const words = (options.text("find") ?? "").toLowerCase().split(/\s+/);
  const reach_m = (options.number("reach") ?? 0) / 1000;
  const payload_kg = options.number("payload");
  const found = robots.filter(
    ({ id, name, vendor, ...robot }) =>
      vendor.toLowerCase().startsWith(maker) &&
      words.every(word => `${id} ${name} ${vendor}`.toLowerCase().includes(word)) &&
      robot.reach_m >= reach_m &&
      (payload_kg === undefined || robot.payload_kg === undefined || robot.payload_kg >= payload_kg),
  );
  return payload_kg === undefined
    ? found
    : found.toSorted((a, b) => Number(a.payload_kg === undefined) - Number(b.payload_kg === undefined));
}

function textOf({ id, name, arm, reach_m, payload_kg, unverified }: Robot): string {
  const payload = payload_kg === undefined ? "payload unknown" : `${payload_kg} kg`;
  const mark = unverified === true ? "  unverified" : "";
  return `${id.padEnd(28)} ${name.padEnd(36)} ${arm.joints.length} axes ${String(Math.round(reach_m * 1000)).padStart(5)} mm  ${payload}${mark}\n`;
}

const lineOf = (robot: Robot): object => ({
  id: robot.id,
  name: robot.name,
  vendor: robot.vendor,
  family: robot.family.kind,
  dof: robot.arm.joints.length,
  payload_kg: robot.payload_kg ?? null,
  ...(robot.mass_kg === undefined ? {} : { mass_kg: robot.mass_kg }),
  reach_m: robot.reach_m,
  reach_measured_from: robot.reachMeasuredFrom,
  reach_measured_to: robot.reachMeasuredTo,
  ...(robot.unverified === true ? { unverified: true } : {}),
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
