import { pose, robotById, type Program } from "@twincell/core";
import { val3 } from "./index.ts";
import { describeDialect, type DialectBench } from "../testing/describe-dialect.ts";
import { describeStructure } from "../testing/describe-structure.ts";

const SIGNALS: Program["signals"] = {
  lamp: { kind: "digital-out" }, blowOff: { kind: "digital-out" }, part: { kind: "digital-in" }, trayFull: { kind: "digital-in" }, level: { kind: "analogue-in" }, valve: { kind: "analogue-out" },
};
const bench: DialectBench = {
  robot: robotById("staubli_rx160")!,
  worldFromBase: pose([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]),
  paths: ["ptp", "lin", "circ"],
  structured: true,
  signals: SIGNALS,
};

describeDialect(val3, bench);
describeStructure(val3, bench);
