import { pose, robotById } from "@twincell/core";
import { rapid } from "./index.ts";
import { describeDialect, type DialectBench } from "../testing/describe-dialect.ts";

const bench: DialectBench = {
  robot: robotById("abb_irb120")!,
  worldFromBase: pose([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]),
  paths: ["ptp", "lin", "circ"],
  runnable: files => files.find(file => file.name.endsWith(".mod"))!,
};

describeDialect(rapid, bench);
describeDialect(rapid, { ...bench, robot: robotById("abb_crb15000_5_95")! });
