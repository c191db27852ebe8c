import { robotById } from "@twincell/core";
import { given } from "../io/arguments.ts";
import { lineWriter } from "../io/json-lines.ts";
import { controlFrom } from "../io/physics.ts";
import { UseFault, type Command } from "../io/usage.ts";

export const validateCommand: Command = {
  name: "validate",
  summary: "pick and place with contact over shapes, sizes and weights",
  usage: `twincell validate [--robot ur10e] [--widths 0.03,0.05,0.08] [--masses 0.1,1,5] [--json]

Lets a robot of the library fetch a part and put it down again, once for every shape, width and mass, and prints how each went:
placed (within 10 mm), refused, dropped, off. Exit 1 when one was not placed.

  --robot R      id of "twincell robots" (default ur10e)
  --shapes LIST  box, flat plate, cylinder, ball, cup, torus (default all)
  --widths LIST  between the fingers, in m
  --masses LIST  in kg
  --control C    of the arm: moved (as told, the default), drives, computed-torque
  --ratio R      share of the joint speeds (default 0.5)
  --json         JSON lines instead of the table`,
  async run(args) {
    const options = given(args, {
      robot: { type: "string" },
      shapes: { type: "string" },
      widths: { type: "string" },
      masses: { type: "string" },
      control: { type: "string" },
      bandwidth: { type: "string" },
      ratio: { type: "string" },
      json: { type: "boolean" },
    });
    const { loadEngine, MATRIX_SHAPES, pickAndPlace, pickMatrix } = await import("@twincell/physics");
    const known = Object.keys(MATRIX_SHAPES) as (keyof typeof MATRIX_SHAPES)[];
    const id = options.text("robot") ?? "ur10e";
    const robot = robotById(id);
    if (!robot) throw new UseFault(`There is no robot "${id}" in the library.`, "See twincell robots.");
    const shapes =
      options
        .text("shapes")
        ?.split(",")
        .map(name => known.find(each => each === name.trim()) ?? unknownShape(name, known)) ?? known;
    const widths_m = options.numbers("widths") ?? [0.03, 0.05, 0.08];
    const masses_kg = options.numbers("masses") ?? [0.1, 1, 5];
    const ratio = options.number("ratio") ?? 0.5;
    if (![...widths_m, ...masses_kg].every(value => value > 0))
      throw new UseFault("--widths and --masses want numbers above 0.");
    if (!(ratio > 0 && ratio <= 1)) throw new UseFault(`--ratio wants more than 0 and up to 1, not ${ratio}.`);
    const near_m = Math.min(0.65, 0.55 * robot.reach_m);
    const engine = await loadEngine();
    const control = controlFrom(options.text("control"), options.number("bandwidth"));
    const writer = lineWriter();
    let placed = 0;
    const cases = pickMatrix(shapes, widths_m, masses_kg);
    for (const which of cases) {
      const row = pickAndPlace(engine, which, { robot, control, ratio, from_m: [near_m, -0.2], to_m: [near_m, 0.25] });
      if (row.verdict === "placed") placed++;
      if (options.flag("json")) writer.write(row);
      else
        process.stdout.write(
          `${row.shape.padEnd(11)}${`${Math.round(row.width_m * 1000)} mm`.padStart(7)}${`${row.mass_kg} kg`.padStart(9)}  ${row.verdict.padEnd(8)}${row.verdict === "placed" ? `${(row.off_m * 1000).toFixed(2)} mm off` : row.sentence}\n`,
        );
    }
    await writer.end();
    process.stderr.write(`${placed} of ${cases.length} placed by ${robot.name}.\n`);
    return placed === cases.length ? 0 : 1;
  },
};

const unknownShape = (name: string, known: readonly string[]): never => {
  throw new UseFault(`There is no shape "${name}".`, `Shapes: ${known.join(", ")}.`);
};
