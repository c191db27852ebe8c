import { identity } from "@twincell/core";
import { skippingDialect } from "../text/index.ts";
import { CANNOT, emitUrScript } from "./emit.ts";
import { interpretUrScript } from "./interpret.ts";
import { parseUrScript } from "./parse.ts";
import { LINES } from "./lines.ts";
/** URScript of Universal Robots' CB3 and e-Series controllers. */
export const urScript = skippingDialect({
    id: "urscript",
    brand: "Universal Robots",
    name: "URScript",
    extensions: [".script"],
    maturity: "experimental",
    cannot: CANNOT,
    emit: (program, robot, worldFromBase = identity()) => emitUrScript(program, robot, worldFromBase),
    parse: (text, robot, worldFromBase = identity()) => parseUrScript(text, robot, worldFromBase),
    interpret: (text, robot, worldFromBase = identity()) => interpretUrScript(text, robot, worldFromBase),
    lines: LINES,
});
