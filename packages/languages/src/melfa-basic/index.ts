import type { Dialect } from "@twincell/core";
import { skippingDialect } from "../parser/index.ts";
import { CANNOT, IDIOMS, emitMelfa } from "./emit.ts";
import { interpretMelfa, parseMelfa } from "./interpret.ts";
import { LINES } from "./lines.ts";

/**
 * MELFA-BASIC V and VI of Mitsubishi's controllers. docs/languages/melfa-basic.md says what is known of it, and from
 * where.
 */
export const melfaBasic: Dialect = skippingDialect({
  id: "melfa-basic",
  brand: "Mitsubishi",
  name: "MELFA-BASIC",
  extensions: [".prg"],
  maturity: "experimental",
  cannot: CANNOT,
  idioms: IDIOMS,
  resolution: { stopsAtNewTool: true },
  emit: emitMelfa,
  parse: parseMelfa,
  interpret: interpretMelfa,
  lines: LINES,
});
