import { pose, robotById } from "@twincell/core";
import { val3 } from "./index.ts";
import { describeDialect, type DialectBench } from "../testing/describe-dialect.ts";
import { linesOf } from "../testing/lines.ts";
import { describeStructure } from "../testing/describe-structure.ts";

const bench: DialectBench = {
  robot: robotById("staubli_rx160")!,
  worldFromBase: pose([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]),
  paths: ["ptp", "lin", "circ"],
  structured: true,
  signals: linesOf("val3"),
};

describeDialect(val3, bench);
describeStructure(val3, bench);
