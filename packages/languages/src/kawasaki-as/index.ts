import { identity, type Dialect } from "@twincell/core";
import { skippingDialect } from "../parser/index.ts";
import { CANNOT, IDIOMS, emitAs } from "./emit.ts";
import { interpretAs, parseAs } from "./interpret.ts";
import { LINES } from "./lines.ts";

/**
 * AS of Kawasaki's D, E and F controllers. Half of what is known of it is recalled: docs/languages/kawasaki-as.md says
 * which.
 */
export const kawasakiAs: Dialect = skippingDialect({
  id: "kawasaki-as",
  brand: "Kawasaki",
  name: "AS",
  extensions: [".as", ".pg"],
  maturity: "experimental",
  cannot: CANNOT,
  idioms: IDIOMS,
  emit: (program, robot, worldFromBase = identity()) => emitAs(program, robot, worldFromBase),
  parse: parseAs,
  interpret: interpretAs,
  lines: LINES,
});
