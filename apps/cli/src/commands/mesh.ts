import { seededRandom } from "@twincell/core";
import {
  endingOf,
  joinedMesh,
  lightened,
  withFewColors,
  writeGlb,
  writeStl,
  type ImportedPart,
} from "@twincell/formats";
import { given } from "../io/arguments.ts";
import { writeOne } from "../io/output.ts";
import { readShapes, SHAPE_HELP, SHAPE_OPTIONS } from "../io/shapes.ts";
import { UseFault, type Command } from "../io/usage.ts";

/** The samples of the deviation are the same every time. */
const SEED = 1;
const MOST_MATERIALS = 20;

export const meshCommand: Command = {
  name: "mesh",
  summary: "make a model light: fewer triangles, few materials, measured deviation",
  usage: `twincell mesh PATH -o OUT.glb [--faces N] [--unit U]

Writes the parts as GLB (or STL, without names and colours) with at most about N triangles and at most ${MOST_MATERIALS} materials, and prints
{"format","faces_before","faces","materials_before","materials","lower_m","upper_m","bounds_change_m","max_deviation_m",
"rms_deviation_m","samples","open_edges_before","open_edges","unit","fixes"}. The deviation is measured at samples of both surfaces, each
against the other; between the samples it may be larger. Without --faces every triangle stays.

  -o FILE         the file to write: .glb or .stl
  --faces N       triangles wanted, 4 or more

${SHAPE_HELP}`,
  async run(args) {
    const options = given(args, {
      ...SHAPE_OPTIONS,
      output: { type: "string", short: "o" },
      faces: { type: "string" },
      json: { type: "boolean" },
    });
    const [path] = options.positionals;
    const output = options.text("output");
    const adapters = options.number("faces");
    if (path === undefined) throw new UseFault("PATH is missing.", "Give a file of shapes.");
    if (output === undefined || !["glb", "stl"].includes(endingOf(output)))
      throw new UseFault("-o wants a file that ends in .glb or .stl.");
    if (adapters !== undefined && !(Number.isInteger(adapters) && adapters >= 4))
      throw new UseFault(`--faces wants a whole number from 4 on, not ${adapters}.`);
    const read = await readShapes(path, options);
    const parts = read.flatMap((each): readonly ImportedPart[] => each.parts);
    const light = await lightened(parts, adapters ?? Infinity, seededRandom(SEED));
    const kept = withFewColors(light.parts, MOST_MATERIALS);
    await writeOne(
      output,
      endingOf(output) === "glb" ? writeGlb(kept) : writeStl(joinedMesh(kept.map(({ mesh }) => mesh))),
    );
    process.stdout.write(
      `${JSON.stringify({
        format: read.map(({ report }) => report.format).join(", "),
        ...light.report,
        unit: read[0]!.unit,
        fixes: read.flatMap(({ report }) => report.fixes),
      })}\n`,
    );
    return 0;
  },
};
