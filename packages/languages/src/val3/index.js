import { identity } from "@twincell/core";
import { skippingDialect } from "../text/index.ts";
import { CANNOT, emitVal3 } from "./emit.ts";
import { interpretVal3 } from "./interpret.ts";
import { parseVal3 } from "./parse.ts";
import { LINES } from "./lines.ts";
/** Programs and data one behind the other: what the controller loads of an application. */
function asOne(files) {
    const parts = files.filter(({ name }) => !name.endsWith(".pjx"));
    return { name: parts[0]?.name ?? "", text: parts.map(({ text }) => text).join(""), lines: parts.flatMap(({ lines }) => lines) };
}
/** VAL 3 of Stäubli's CS8 and CS9 controllers. */
export const val3 = skippingDialect({
    id: "val3",
    brand: "Stäubli",
    name: "VAL 3",
    extensions: [".pgx", ".dtx", ".pjx"],
    maturity: "experimental",
    cannot: CANNOT,
    runnable: asOne,
    emit: (program, robot, worldFromBase = identity()) => emitVal3(program, robot, worldFromBase),
    parse: (text, robot, worldFromBase = identity()) => parseVal3(text, robot, worldFromBase),
    interpret: (text, robot, worldFromBase = identity()) => interpretVal3(text, robot, worldFromBase),
    lines: LINES,
});
