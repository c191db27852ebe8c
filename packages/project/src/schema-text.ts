import { z } from "zod";
import { cellSchema, textProgramSchema } from "./schema.ts";
import { NEWEST } from "./versions.ts";

/**
 * The JSON schema of the newest cell file, as docs/cell.schema.json prints it. What only `openDocument` checks is not
 * in it.
 */
export function cellJsonSchema(): Record<string, unknown> {
  const cell = z.toJSONSchema(cellSchema, { io: "input" }) as Record<string, unknown> & {
    readonly properties: Record<string, unknown>;
  };
  // Only the whole document says which dialect of JSON schema it is.
  const textProgram = Object.fromEntries(
    Object.entries(z.toJSONSchema(textProgramSchema, { io: "input" })).filter(([key]) => key !== "$schema"),
  );
  return {
    $id: `twincell.cell.v${NEWEST}`,
    title: `Twincell cell, version ${NEWEST}`,
    description:
      "Metres, kilograms, seconds, radians; quaternions x y z w; right-handed, z up. The reader in packages/project/src/open.ts also checks what a schema cannot: unique names and ids, robots, tools, objects and files that exist, quaternions of length 1.",
    ...cell,
    properties: {
      ...cell.properties,
      programs: { type: "array", items: { anyOf: [{ $ref: "program.schema.json" }, { $ref: "#/$defs/textProgram" }] } },
    },
    $defs: { textProgram },
  };
}
