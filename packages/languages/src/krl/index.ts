import { identity, type Dialect, type EmittedFile } from "@twincell/core";
import { skippingDialect } from "../parser/index.ts";
import { axisList } from "./axis-list.ts";
import { CANNOT, IDIOMS, emitKrl } from "./emit.ts";
import { interpretKrl } from "./interpret.ts";
import { parseKrl } from "./parse.ts";
import { LINES } from "./lines.ts";

/** The module and its data list, one behind the other: what the controller loads together. */
function asOne(files: readonly EmittedFile[]): EmittedFile {
  const [src, dat] = files;
  if (src === undefined || dat === undefined)
    throw new RangeError(`A module of KRL is two files; ${files.length} are given.`);
  return { name: src.name, text: src.text + dat.text, lines: [...src.lines, ...dat.lines] };
}

/** KRL of KR C2, KR C4 and KR C5 controllers. */
export const krl: Dialect = skippingDialect({
  id: "krl",
  brand: "KUKA",
  name: "KRL",
  extensions: [".src", ".dat", ".sub"],
  maturity: "proven",
  cannot: CANNOT,
  idioms: IDIOMS,
  // $VEL_AXIS is a whole number of percent.
  resolution: { ratio: 0.005, leastRatio: 0.01 },
  runnable: files => asOne(files),
  forms: [axisList],
  emit: emitKrl,
  parse: (text, robot, worldFromBase = identity()) => parseKrl(text, robot, worldFromBase),
  interpret: (text, robot, worldFromBase = identity()) => interpretKrl(text, robot, worldFromBase),
  lines: LINES,
});
