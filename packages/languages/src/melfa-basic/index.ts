import { identity, type Dialect } from "@twincell/core";
import { CANNOT, emitMelfa } from "./emit.ts";
import { interpretMelfa, parseMelfa } from "./interpret.ts";

/** MELFA-BASIC V and VI of Mitsubishi's controllers. docs/languages/melfa-basic.md says what is known of it, and from where. */
export const melfaBasic: Dialect = {
  id: "melfa-basic",
  brand: "Mitsubishi",
  name: "MELFA-BASIC",
  extensions: [".prg"],
  maturity: "experimental",
  cannot: CANNOT,
  emit: (program, robot, worldFromBase = identity()) => emitMelfa(program, robot, worldFromBase),
  parse: parseMelfa,
  interpret: interpretMelfa,
};
