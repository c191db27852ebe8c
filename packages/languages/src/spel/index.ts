import type { Dialect } from "@twincell/core";
import { skippingDialect } from "../parser/index.ts";
import { CANNOT, IDIOMS, emitSpel } from "./emit.ts";
import { interpretSpel, parseSpel } from "./interpret.ts";
import { LINES } from "./lines.ts";

/**
 * SPEL+ of Epson's RC controllers, on arms with six axes. docs/languages/spel.md says what is known of it, and from
 * where.
 */
export const spel: Dialect = skippingDialect({
  id: "spel",
  brand: "Epson",
  name: "SPEL+",
  extensions: [".prg", ".pts"],
  maturity: "experimental",
  cannot: CANNOT,
  idioms: IDIOMS,
  resolution: { ratio: 0.00501, leastRatio: 0.01, mostMps: 2 },
  emit: emitSpel,
  parse: parseSpel,
  interpret: interpretSpel,
  lines: LINES,
});
