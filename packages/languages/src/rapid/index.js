import { identity } from "@twincell/core";
import { skippingDialect } from "../text/index.ts";
import { CANNOT, emitRapid } from "./emit.ts";
import { interpretRapid } from "./interpret.ts";
import { parseRapid } from "./parse.ts";
import { LINES } from "./lines.ts";
/** RAPID of ABB's IRC5 and OmniCore controllers. */
export const rapid = skippingDialect({
    id: "rapid",
    brand: "ABB",
    name: "RAPID",
    extensions: [".mod", ".pgf", ".prg", ".sys"],
    maturity: "experimental",
    cannot: CANNOT,
    emit: (program, robot, worldFromBase = identity()) => emitRapid(program, robot, worldFromBase),
    parse: (text, robot, worldFromBase = identity()) => parseRapid(text, robot, worldFromBase),
    interpret: (text, robot, worldFromBase = identity()) => interpretRapid(text, robot, worldFromBase),
    lines: LINES,
});
