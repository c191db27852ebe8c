import { existsSync } from "node:fs";
import { readdir } from "node:fs/promises";
import { given } from "../io/arguments.ts";
import { lineWriter } from "../io/json-lines.ts";
import { UseFault, type Command } from "../io/usage.ts";

const folder = new URL("../../../../bench/", import.meta.url);

export const benchCommand: Command = {
  name: "bench",
  summary: "measure, one JSON line per figure",
  usage: `twincell bench [NAME…]

Runs the benchmarks named (all when none is), one after the other, and prints one JSON line per figure:
{"name":"ik/kr6","unit":"us","median":…,"min":…,"max":…,"n":…}`,
  async run(args) {
    const { positionals } = given(args, { json: { type: "boolean" } });
    if (!existsSync(folder))
      throw new UseFault(
        "The benchmarks are not in the installed package.",
        "Run them in a checkout of the repository.",
      );
    const files = (await readdir(folder))
      .filter(name => name.endsWith(".ts") && name !== "figure.ts")
      .map(name => name.slice(0, -3))
      .sort();
    const unknown = positionals.find(name => !files.includes(name));
    if (unknown !== undefined)
      throw new UseFault(`There is no benchmark "${unknown}".`, `Benchmarks: ${files.join(", ")}.`);
    for (const name of positionals.length ? positionals : files) {
      const { run } = (await import(new URL(`${name}.ts`, folder).href)) as { run?: () => Promise<readonly unknown[]> };
      // Some files only hold what others measure with.
      if (run === undefined) continue;
      const writer = lineWriter();
      for (const figure of await run()) writer.write(figure);
      await writer.end();
    }
    return 0;
  },
};
