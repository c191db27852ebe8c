import { identity, type Dialect, type EmittedFile } from "@twincell/core";
import { skippingDialect } from "../parser/index.ts";
import { CANNOT, IDIOMS, emitVal3 } from "./emit.ts";
import { interpretVal3, parseVal3 } from "./interpret.ts";
import { LINES } from "./lines.ts";

/** Programs and data one behind the other: what the controller loads of an application. */
function asOne(files: readonly EmittedFile[]): EmittedFile {
  const parts = files.filter(({ name }) => !name.endsWith(".pjx"));
  return {
    name: parts[0]?.name ?? "",
    text: parts.map(({ text }) => text).join(""),
    lines: parts.flatMap(({ lines }) => lines),
  };
}

/** VAL 3 of Stäubli's CS8 and CS9 controllers. */
export const val3: Dialect = skippingDialect({
  id: "val3",
  brand: "Stäubli",
  name: "VAL 3",
  extensions: [".pgx", ".dtx", ".pjx"],
  maturity: "experimental",
  cannot: CANNOT,
  idioms: IDIOMS,
  runnable: asOne,
  emit: (program, robot, worldFromBase = identity()) => emitVal3(program, robot, worldFromBase),
  parse: parseVal3,
  interpret: interpretVal3,
  lines: LINES,
});
