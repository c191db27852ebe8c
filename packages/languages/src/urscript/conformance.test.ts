import { pose, robotById } from "@twincell/core";
import { urScript } from "./index.ts";
import { describeStructure } from "../testing/describe-structure.ts";
import { describeDialect, type DialectBench } from "../testing/describe-dialect.ts";

const bench: DialectBench = {
  robot: robotById("ur10e")!,
  worldFromBase: pose([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]),
  paths: ["ptp", "lin", "circ"],
};

describeDialect(urScript, bench);
describeStructure(urScript, bench);
