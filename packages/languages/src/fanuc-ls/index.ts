import { identity, type Dialect, type EmittedFile } from "@twincell/core";
import { skippingDialect } from "../parser/index.ts";
import { CANNOT, IDIOMS, FASTEST_MMPS, emitFanucLs } from "./emit.ts";
import { interpretFanucLs, parseFanucLs } from "./interpret.ts";
import { LINES } from "./lines.ts";

/** The main program and those that it calls, one behind the other: what the controller holds together. */
const asOne = (files: readonly EmittedFile[]): EmittedFile => ({
  name: files[0]?.name ?? "",
  text: files.map(({ text }) => text).join(""),
  lines: files.flatMap(({ lines }) => lines),
});

/** TP programs of R-30iA, R-30iB and later controllers as ASCII listings. */
export const fanucLs: Dialect = skippingDialect({
  id: "fanuc-ls",
  brand: "FANUC",
  name: "FANUC TP",
  extensions: [".ls", ".va"],
  maturity: "experimental",
  cannot: CANNOT,
  idioms: IDIOMS,
  // Whole percent, whole mm/s, hundredths of a second; angles and lengths in thousandths: six joints of a listing
  // together move the tool by no more.
  resolution: {
    ratio: 0.005,
    leastRatio: 0.01,
    mps: 0.0005,
    mostMps: FASTEST_MMPS / 1000,
    wait_s: 0.005,
    position_m: 4e-5,
    angle_rad: 5.3e-5,
    posesAsAngles: true,
  },
  runnable: asOne,
  emit: (program, robot, worldFromBase = identity()) => emitFanucLs(program, robot, worldFromBase),
  parse: parseFanucLs,
  interpret: interpretFanucLs,
  lines: LINES,
});
