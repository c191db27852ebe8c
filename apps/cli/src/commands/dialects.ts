import { DIALECTS } from "@twincell/languages";
import { given } from "../io/arguments.ts";
import { lineWriter } from "../io/json-lines.ts";
import type { Command } from "../io/usage.ts";

export const dialectsCommand: Command = {
  name: "dialects",
  summary: "the robot languages and what each cannot say",
  usage: `twincell dialects

One JSON line per dialect: id, brand, name, extensions, maturity, emits, parses, interprets, cannot.`,
  async run(args) {
    given(args, { json: { type: "boolean" } });
    const writer = lineWriter();
    for (const { id, brand: kind, name, extensions, maturity, cannot } of DIALECTS)
      writer.write({
        id,
        brand: kind,
        name,
        extensions,
        maturity,
        emits: true,
        parses: true,
        interprets: true,
        cannot,
      });
    await writer.end();
    return 0;
  },
};
