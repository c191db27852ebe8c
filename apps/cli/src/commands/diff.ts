import { diffCells, sayDifferences } from "@twincell/project";
import { given } from "../io/arguments.ts";
import { readCell } from "../io/program.ts";
import { UseFault, type Command } from "../io/usage.ts";

export const diffCommand: Command = {
  name: "diff",
  summary: "what differs between two saved cells, readably",
  usage: `twincell diff A B [--json]

Compares two saved cells and prints one line for each difference: "+" added in B, "−" removed, "~" changed. Objects and steps are
told apart by their ids, tools, frames and programs by their names; lengths are in mm. Exit 0 when the cells are the same, 1 when
they differ. One of the two may be "-", standard input.

  --json  the differences as JSON lines`,
  async run(args) {
    const options = given(args, { json: { type: "boolean" } });
    const [a, b, ...more] = options.positionals;
    if (a === undefined || b === undefined || more.length > 0 || (a === "-" && b === "-"))
      throw new UseFault("diff wants two saved cells.", "For instance: twincell diff before.json after.json");
    const differences = diffCells(await readCell(a), await readCell(b));
    const lines = options.flag("json") ? differences.map(each => JSON.stringify(each)) : sayDifferences(differences);
    process.stdout.write(lines.map(line => `${line}\n`).join(""));
    return differences.length === 0 ? 0 : 1;
  },
};
