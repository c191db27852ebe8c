import { pose, robotById } from "@twincell/core";
import { inform, informExamplePulses } from "../index.ts";
import { describeDialect, type DialectBench } from "../testing/describe-dialect.ts";

const bench: DialectBench = {
  robot: robotById("yaskawa_gp8")!,
  worldFromBase: pose([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]),
  paths: ["ptp", "lin", "circ", "spline"],
  structured: true,
  unrolls: true,
};

describeDialect(inform, bench);
describeDialect(informExamplePulses, bench);
