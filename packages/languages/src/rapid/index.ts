import { identity, type Dialect } from "@twincell/core";
import { skippingDialect } from "../parser/index.ts";
import { CANNOT, IDIOMS, emitRapid } from "./emit.ts";
import { interpretRapid, parseRapid } from "./interpret.ts";
import { LINES } from "./lines.ts";

/** RAPID of ABB's IRC5 and OmniCore controllers. */
export const rapid: Dialect = skippingDialect({
  id: "rapid",
  brand: "ABB",
  name: "RAPID",
  extensions: [".mod", ".modx", ".pgf", ".prg", ".sys", ".sysx"],
  maturity: "experimental",
  cannot: CANNOT,
  idioms: IDIOMS,
  emit: (program, robot, worldFromBase = identity()) => emitRapid(program, robot, worldFromBase),
  parse: parseRapid,
  interpret: interpretRapid,
  lines: LINES,
});
