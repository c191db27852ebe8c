import { identity, type Dialect } from "@twincell/core";
import { skippingDialect } from "../parser/index.ts";
import { CANNOT, IDIOMS, emitUrScript } from "./emit.ts";
import { interpretUrScript, parseUrScript } from "./interpret.ts";
import { LINES } from "./lines.ts";

/** URScript of Universal Robots' CB3 and e-Series controllers. */
export const urScript: Dialect = skippingDialect({
  id: "urscript",
  brand: "Universal Robots",
  name: "URScript",
  extensions: [".script", ".urscript"],
  maturity: "experimental",
  cannot: CANNOT,
  idioms: IDIOMS,
  emit: (program, robot, worldFromBase = identity()) => emitUrScript(program, robot, worldFromBase),
  parse: parseUrScript,
  interpret: interpretUrScript,
  lines: LINES,
});
