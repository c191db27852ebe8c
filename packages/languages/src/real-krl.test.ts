import { robotById, type Executed, type MoveStep, type Step } from "@twincell/core";
import { expect, test } from "vitest";
import { krl } from "./index.ts";

/*
 * Programs as the pendant's inline forms write them, all statements of a form kept. What changes where the robot goes
 * and cannot be carried out is refused with its line.
 */
const robot = robotById("kuka_kr6_2")!;
const program = (statements: readonly string[], data: readonly string[] = []): string =>
  [
    "&ACCESS RVP",
    "DEF PROG( )",
    ";FOLD INI;%{PE}",
    "BAS (#INITMOV,0 )",
    ";ENDFOLD (INI)",
    ...statements,
    "END",
    "DEFDAT  PROG",
    "EXT  BAS (BAS_COMMAND  :IN,REAL  :IN )",
    "DECL E6POS XP1={X 1200.0,Y 0.0,Z 900.0,A 0.0,B 90.0,C 0.0,S 2,T 2,E1 0.0}",
    "DECL E6POS XP2={X 1250.0,Y 100.0,Z 900.0,A 0.0,B 90.0,C 0.0,S 2,T 2,E1 0.0}",
    'DECL FDAT FP1={TOOL_NO 1,BASE_NO 2,IPO_FRAME #BASE,POINT2[] " ",TQ_STATE FALSE}',
    "DECL PDAT PPDAT1={VEL 100.0,ACC 40.0,APO_DIST 30.0,APO_MODE #CPTP,GEAR_JERK 50.0}",
    "DECL LDAT LCPDAT1={VEL 2.0,ACC 50.0,APO_DIST 25.0,APO_FAC 50.0,ORI_TYP #VAR,CIRC_TYP #BASE}",
    ...data,
    "ENDDAT",
    "",
  ].join("\r\n");
/** Lines of the program in front of its statements. */
const BEFORE = 5;

function executed(text: string): Step[] {
  const answer = krl.interpret(text, robot);
  if (answer.kind === "not-understood") throw new Error(answer.faults.map(({ sentence }) => sentence).join(" "));
  return carriedOut(answer.run()).flatMap(({ step }) => (step ? [step] : []));
}
function carriedOut(run: Iterator<Executed, void>): Executed[] {
  const all: Executed[] = [];
  for (let next = run.next(); !next.done; next = run.next()) all.push(next.value);
  return all;
}
/** Where and why a text is not carried out, as it is read or as it runs. */
function refusal(text: string): { readonly line: number; readonly sentence: string } | null {
  const answer = krl.interpret(text, robot);
  if (answer.kind === "not-understood") return answer.faults[0]!;
  try {
    carriedOut(answer.run());
    return null;
  } catch (problem) {
    return problem as { readonly line: number; readonly sentence: string };
  }
}

const SPTP =
  "SPTP XP1 WITH $VEL_AXIS[1] = SVEL_JOINT( 50), $TOOL = STOOL2( FP1), $BASE = SBASE( FP1.BASE_NO), $IPO_MODE = SIPO_MODE( FP1.IPO_FRAME), $LOAD = SLOAD( FP1.TOOL_NO), $ACC_AXIS[1] = SACC_JOINT( PPDAT1), $APO = SAPO_PTP( PPDAT1), $GEAR_JERK[1] = SGEAR_JERK( PPDAT1), $COLLMON_TOL_PRO[1] = USE_CM_PRO_VALUES( 0) C_SPL";
const SLIN =
  "SLIN XP2 WITH $VEL = SVEL_CP( 0.3, , LCPDAT1), $TOOL = STOOL2( FP1), $BASE = SBASE( FP1.BASE_NO), $IPO_MODE = SIPO_MODE( FP1.IPO_FRAME), $LOAD = SLOAD( FP1.TOOL_NO), $ACC = SACC_CP( LCPDAT1), $ORI_TYPE = SORI_TYP( LCPDAT1), $APO = SAPO( LCPDAT1), $JERK = SJERK( LCPDAT1), $COLLMON_TOL_PRO[1] = USE_CM_PRO_VALUES( 0) C_SPL";

test("inline forms of spline motions take speed, acceleration and approximation from their data", () => {
  const [joint, line, last] = executed(program([SPTP, SLIN, "SPTP XP1"])) as MoveStep[];
  expect(joint).toMatchObject({ path: "ptp", speed: { ratio: 0.5 }, acceleration: { ratio: 0.4 } });
  expect(line).toMatchObject({ path: "lin", speed: { mps: Math.fround(0.3) }, blend_m: 0.025 });
  expect(line!.acceleration).toMatchObject({ ratio: expect.closeTo(0.5, 6) as number });
  // What WITH sets is for that motion alone.
  expect(last).toMatchObject({ speed: { ratio: 1 }, blend_m: 0 });
  expect(last!.acceleration).toBeUndefined();
});

test("a tool that stands in the cell (#TCP) is refused with its line, in the data of BAS, of a spline motion and assigned", () => {
  const fixed = ["DECL FDAT FP9={TOOL_NO 1,BASE_NO 2,IPO_FRAME #TCP}"];
  const sentence =
    "With #TCP the tool stands in the cell and the robot carries the part, which is not understood here.";
  expect(
    refusal(program(["FDAT_ACT=FP9", "BAS(#FRAMES)", "PDAT_ACT=PPDAT1", "BAS(#PTP_PARAMS,50)"], fixed)),
  ).toMatchObject({ line: BEFORE + 4, sentence });
  expect(refusal(program([SPTP.replaceAll("FP1", "FP9")], fixed))).toMatchObject({ line: BEFORE + 1, sentence });
  expect(refusal(program(["$IPO_MODE=#TCP", "PTP XP1"]))).toMatchObject({ line: BEFORE + 1, sentence });
  expect(refusal(program(["$IPO_MODE=#BASE", "PTP XP1"]))).toBeNull();
});

test("an orientation that is kept whatever the target says (#CONSTANT) is refused with its line", () => {
  const kept = ["DECL LDAT LCPDAT9={VEL 2.0,ACC 50.0,APO_DIST 25.0,ORI_TYP #CONSTANT}"];
  const sentence = "With #CONSTANT the orientation of the target is not taken, which is not understood here.";
  expect(refusal(program(["LDAT_ACT=LCPDAT9", "FDAT_ACT=FP1", "BAS(#CP_PARAMS,0.5)", "LIN XP2"], kept))).toMatchObject({
    line: BEFORE + 3,
    sentence,
  });
  expect(refusal(program([SLIN.replaceAll("LCPDAT1", "LCPDAT9")], kept))).toMatchObject({ sentence });
  expect(refusal(program(["$ORI_TYPE=#CONSTANT", "LIN XP2"]))).toMatchObject({ line: BEFORE + 1, sentence });
});

test("a function in WITH that is not the controller's own is refused, not passed over", () => {
  expect(refusal(program(["SPTP XP1 WITH $APO = SNOBODY_KNOWS( PPDAT1)"]))).toMatchObject({
    line: BEFORE + 1,
    sentence: '"SNOBODY_KNOWS" is no function that is understood here.',
  });
});
