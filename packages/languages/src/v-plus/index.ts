import { identity, type Dialect } from "@twincell/core";
import { skippingDialect } from "../parser/index.ts";
import { CANNOT, IDIOMS, emitVPlus } from "./emit.ts";
import { interpretVPlus } from "./interpret.ts";
import { isPointList, parseVPlus } from "./parse.ts";
import { LINES } from "./lines.ts";

/** V+ of Adept MC and Stäubli CS7 controllers. */
export const vPlus: Dialect = skippingDialect(
  {
    id: "v-plus",
    brand: "Stäubli / Adept",
    name: "V+",
    extensions: [".v2", ".pg", ".vp", ".txt"],
    maturity: "proven",
    cannot: CANNOT,
    idioms: IDIOMS,
    // TOOL is carried out when the motion before it has ended.
    resolution: { stopsAtNewTool: true },
    emit: emitVPlus,
    parse: (text, robot, worldFromBase = identity()) => parseVPlus(text, robot, worldFromBase),
    interpret: (text, robot, worldFromBase = identity()) => interpretVPlus(text, robot, worldFromBase),
    lines: LINES,
  },
  isPointList,
);
