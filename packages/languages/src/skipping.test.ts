import { pose, robotById } from "@twincell/core";
import {
  fanucLs,
  inform,
  kawasakiAs,
  krl,
  melfaBasic,
  pacScript,
  poseList,
  rapid,
  spel,
  urScript,
  val3,
  vPlus,
} from "./index.ts";
import type { DialectBench } from "./testing/describe-dialect.ts";
import { describeSkipping } from "./testing/describe-skipping.ts";

const bench = (robot: string): DialectBench => ({
  robot: robotById(robot)!,
  worldFromBase: pose([0.3, -0.2, 0.75]),
  paths: ["ptp", "lin"],
});

describeSkipping(vPlus, bench("staubli_rx90l"), {
  statement: "FROBNICATE 5",
  motion: "MOVES nowhere(((",
  opens: "IF FROB(7) THEN",
  closes: "END",
});
describeSkipping(krl, bench("kuka_kr6r900sixx"), {
  statement: "FROBNICATE(5)",
  motion: "LIN NOWHERE",
  opens: "IF FROB(7) THEN",
  closes: "ENDIF",
});
describeSkipping(inform, bench("yaskawa_gp8"), {
  statement: "FROBNICATE 5",
  motion: "MOVL C09999 V=10.0",
  opens: "IFTHENEXP FROB(7)=ON",
  closes: "ENDIF",
});
describeSkipping(urScript, bench("ur10e"), {
  statement: "frobnicate(5)",
  motion: "movel(nowhere, v=0.1)",
  opens: "if frob(7):",
  closes: "end",
});
describeSkipping(rapid, bench("abb_irb120"), {
  statement: "Frobnicate 5;",
  motion: "MoveL nowhere,v100,fine,tool0;",
  opens: "IF Frob(7)=1 THEN",
  closes: "ENDIF",
});
describeSkipping(fanucLs, bench("fanuc_lrmate200id"), {
  statement: "FROBNICATE 5",
  motion: "L P[999] 100mm/sec FINE",
  opens: "IF (FROB[7]=ON) THEN",
  closes: "ENDIF",
  line: statement => `   1:${/^L P/.test(statement) ? "" : "  "}${statement} ;`,
});
describeSkipping(val3, bench("staubli_rx160"), {
  statement: "frobnicate(5)",
  motion: "movel(nowhere,flange,mdesc)",
  opens: "if frob(7)",
  closes: "endIf",
});
describeSkipping(kawasakiAs, bench("kawasaki_rs007l"), {
  statement: "FROBNICATE 5",
  motion: "LMOVE nowhere",
  opens: "IF FROB(7) THEN",
  closes: "END",
});
describeSkipping(poseList, bench("ur10e"), { statement: "FROBNICATE 5", motion: "MOVE NOWHERE" });
describeSkipping(spel, bench("epson_c4_a601s"), {
  statement: "Frobnicate 5",
  motion: "Move nowhere",
  opens: "If Frob(7) = On Then",
  closes: "EndIf",
});
describeSkipping(melfaBasic, bench("mitsubishi_rv7fl"), {
  statement: "Frobnicate 5",
  motion: "Mvs PNOWHERE",
  opens: "If Frob(7)=1 Then",
  closes: "EndIf",
});
describeSkipping(pacScript, bench("denso_vs060"), {
  statement: "Frobnicate 5",
  motion: "Move L, nowhere",
  opens: "If Frob(7) = On Then",
  closes: "End If",
});
