import { pose, robotById } from "@twincell/core";
import { describe } from "vitest";
import { poseList } from "../index.ts";
import { describeDialect, type DialectBench } from "../testing/describe-dialect.ts";

const worldFromBase = pose<"world", "base">([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]);

describe.each(["staubli_rx90l", "ur10e", "kuka_lbr_iiwa_14_r820"])("on %s", id => {
  const bench: DialectBench = {
    robot: robotById(id)!,
    worldFromBase,
    paths: ["ptp", "lin", "circ", "spline"],
    structured: true,
  };
  describeDialect(poseList, bench);
});
