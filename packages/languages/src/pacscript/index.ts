import type { Dialect } from "@twincell/core";
import { skippingDialect } from "../parser/index.ts";
import { CANNOT, IDIOMS, emitPac } from "./emit.ts";
import { interpretPac, parsePac } from "./interpret.ts";
import { LINES } from "./lines.ts";

/** PacScript of Denso's RC8 controllers. docs/languages/pacscript.md says what is known of it, and from where. */
export const pacScript: Dialect = skippingDialect({
  id: "pacscript",
  brand: "Denso",
  name: "PacScript",
  extensions: [".pcs", ".pac"],
  maturity: "experimental",
  cannot: CANNOT,
  idioms: IDIOMS,
  resolution: { wait_s: 0.000501 },
  emit: emitPac,
  parse: parsePac,
  interpret: interpretPac,
  lines: LINES,
});
