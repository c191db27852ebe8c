import { pose, robotById } from "@twincell/core";
import { fanucLs } from "./index.ts";
import { describeDialect, type DialectBench } from "../testing/describe-dialect.ts";
import { describeStructure } from "../testing/describe-structure.ts";

const bench: DialectBench = {
  robot: robotById("fanuc_lrmate200id")!,
  worldFromBase: pose([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]),
  paths: ["ptp", "lin", "circ"],
  structured: true,
};

describeDialect(fanucLs, bench);
describeStructure(fanucLs, bench);
