import { pose, robotById } from "@twincell/core";
import { urScript } from "./index.ts";
import { describeDialect, type DialectBench } from "../testing/describe-dialect.ts";

const bench: DialectBench = {
  robot: robotById("ur10e")!,
  worldFromBase: pose([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]),
  paths: ["ptp", "lin", "circ"],
  runnable: files => files[0]!,
};

describeDialect(urScript, bench);
