import { pose, robotById } from "@twincell/core";
import { describeDialect, describeMutations, type DialectBench } from "../testing/describe-dialect.ts";
import { describeStructure } from "../testing/describe-structure.ts";
import { spel } from "./index.ts";

const bench: DialectBench = {
  robot: robotById("epson_c4_a601s")!,
  worldFromBase: pose([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]),
  paths: ["ptp", "lin", "circ"],
  structured: true,
  signals: { lamp: { kind: "digital-out", address: 5 }, "Blow off": { kind: "digital-out", address: 6 }, part: { kind: "digital-in", address: 3 }, tray_full: { kind: "digital-in", address: 4 } },
};

describeDialect(spel, bench);
describeStructure(spel, bench);
