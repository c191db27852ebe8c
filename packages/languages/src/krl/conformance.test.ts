import { pose, robotById } from "@twincell/core";
import { krl } from "../index.ts";
import { describeDialect, type DialectBench } from "../testing/describe-dialect.ts";

const bench = (robot: string): DialectBench => ({
  robot: robotById(robot)!,
  worldFromBase: pose([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]),
  paths: ["ptp", "lin", "circ", "spline"],
  structured: true,
  unrolls: true,
});

describeDialect(krl, bench("kuka_kr6_2"));
describeDialect(krl, bench("kuka_kr6r900sixx"));
