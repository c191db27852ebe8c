import { emptyProgram, robotById } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { dialectById, DIALECTS, executeText, NOT_GIVEN, runnableFile } from "./index.ts";

/** A text of each language: a motion, the call of a program that no file has, in the line of that number, a motion. */
const TEXTS: Readonly<Record<string, readonly [robot: string, line: number, text: string]>> = {
  krl: [
    "kuka_kr6r900sixx",
    3,
    `DEF MAIN ( )
PTP {A1 0, A2 -90, A3 90, A4 0, A5 0, A6 0}
GREIFER ( )
PTP {A1 10, A2 -90, A3 90, A4 0, A5 0, A6 0}
END
`,
  ],
  rapid: [
    "abb_irb120",
    4,
    `MODULE M
PROC main()
MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, tool0;
GREIFER;
MoveAbsJ [[10,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, tool0;
ENDPROC
ENDMODULE
`,
  ],
  urscript: [
    "ur10e",
    3,
    `def main():
  movej([0,-1.57,1.57,0,0,0])
  GREIFER()
  movej([0.2,-1.57,1.57,0,0,0])
end
main()
`,
  ],
  "v-plus": [
    "staubli_rx90l",
    3,
    `.PROGRAM main()
MOVE #PPOINT(0,-90,90,0,0,0)
CALL GREIFER
MOVE #PPOINT(10,-90,90,0,0,0)
.END
`,
  ],
  "kawasaki-as": [
    "kawasaki_rs007l",
    3,
    `.PROGRAM main()
JMOVE #PPOINT(0,0,0,0,0,0)
CALL GREIFER
JMOVE #PPOINT(10,0,0,0,0,0)
.END
`,
  ],
  spel: [
    "epson_c4_a601s",
    4,
    `Function main
Motor On
Go AglToPls(0, 0, 0, 0, 0, 0)
Call GREIFER
Go AglToPls(10, 0, 0, 0, 0, 0)
Fend
`,
  ],
  "melfa-basic": [
    "mitsubishi_rv7fl",
    2,
    `1 Mov J1
2 CallP "GREIFER"
3 Mov J2
4 End
J1=(0.0,0.0,90.0,0.0,90.0,0.0)
J2=(10.0,0.0,90.0,0.0,90.0,0.0)
`,
  ],
  pacscript: [
    "denso_vs060",
    4,
    `Sub Main
TakeArm
Move P, J(0, 0, 90, 0, 90, 0)
Call GREIFER
Move P, J(10, 0, 90, 0, 90, 0)
End Sub
`,
  ],
  "fanuc-ls": [
    "fanuc_lrmate200id",
    4,
    `/PROG MAIN
/MN
   1:J P[1] 10% FINE ;
   2:CALL GREIFER ;
   3:J P[2] 10% FINE ;
/POS
P[1]{
   GP1:
	UF : 0, UT : 1,
	J1= 0.000 deg, J2= 0.000 deg, J3= 0.000 deg,
	J4= 0.000 deg, J5= -30.000 deg, J6= 0.000 deg
};
P[2]{
   GP1:
	UF : 0, UT : 1,
	J1= 10.000 deg, J2= 0.000 deg, J3= 0.000 deg,
	J4= 0.000 deg, J5= -30.000 deg, J6= 0.000 deg
};
/END
`,
  ],
};
/** Languages without calls, and those whose texts are made below. */
const NO_CALLS = ["l-irl"];
const EMITTED: Readonly<Record<string, readonly [robot: string, after: RegExp, call: string]>> = {
  inform: ["yaskawa_gp8", /^MOVJ.*\r?\n/m, "CALL JOB:GREIFER\r\n"],
  val3: ["staubli_rx160", /^\s*movej.*\r?\n/m, "call GREIFER()\r\n"],
};

function written(id: string): readonly [robot: string, line: number, text: string] {
  const [robot, after, call] = EMITTED[id]!;
  const it = robotById(robot)!;
  const dialect = dialectById(id)!;
  const step = (name: string, by: number) =>
    ({
      id: name,
      type: "move",
      path: "ptp",
      target: { q: it.home_rad.map((q, i) => (i === 0 ? q + by : q)) },
      speed: { ratio: 0.2 },
      blend_m: 0,
    }) as const;
  const answer = dialect.emit({ ...emptyProgram(robot, "main"), steps: [step("a", 0.1), step("b", 0.2)] }, it);
  if (answer.kind === "cannot") throw new Error(answer.sentence);
  const { text } = runnableFile(dialect, answer.files)!;
  const at = after.exec(text)!;
  const cut = at.index + at[0].length;
  return [robot, text.slice(0, cut).split("\n").length, text.slice(0, cut) + call + text.slice(cut)];
}

describe("a called program that is in none of the files", () => {
  test("every language is here", () => {
    expect([...Object.keys(TEXTS), ...Object.keys(EMITTED), ...NO_CALLS].sort()).toEqual(
      DIALECTS.map(({ id }) => id).sort(),
    );
  });

  test.each([...Object.keys(TEXTS), ...Object.keys(EMITTED)])(
    "%s: the text is refused with line, name and where to look; left out only when that is asked for, and told then",
    id => {
      const [robotId, line, text] = TEXTS[id] ?? written(id);
      const robot = robotById(robotId)!;
      const dialect = dialectById(id)!;
      const refused = { kind: "not-understood", faults: [{ line, expected: "a program among the files" }] };
      const answer = executeText(dialect, text, "main", robot);
      expect(answer).toMatchObject(refused);
      expect(answer.kind === "not-understood" && answer.faults[0]!.sentence).toMatch(
        /^GREIFER is called here and is in none of the files: give the file that holds it as well, or let the call do nothing\.$/i,
      );
      // A controller that is given such a text does not run it either.
      expect(dialect.interpret(text, robot)).toMatchObject(refused);

      const without = executeText(dialect, text, "main", robot, undefined, { missingPrograms: "leave-out" });
      if (without.kind === "not-understood") throw new Error(JSON.stringify(without.faults));
      expect(without.program.steps.filter(({ type }) => type === "move").length).toBe(2);
      const told = without.notExecuted.filter(({ expected }) => expected === NOT_GIVEN);
      expect(told.filter(each => each.line === line).map(({ sentence }) => sentence.toLowerCase())).toEqual([
        "greifer is called here and is in none of the files: what it does, motions too, is not executed.",
      ]);
    },
  );

  test.each<[id: string, robot: string, text: string, far: number]>([
    [
      "spel",
      "epson_c4_a601s",
      "Function main\nInteger n\nFor n = 1 To 2\nIf n = 1 Then Call Greifer(n) Else Go JA(20, 0, 0, 0, 0, 0)\nNext\nFend\n",
      20,
    ],
    [
      "melfa-basic",
      "mitsubishi_rv7fl",
      'For M1=1 To 2\nIf M1=1 Then CallP "GREIFER",M1 Else Mov J1\nNext M1\nEnd\nJ1=(20,0,90,0,90,0)\n',
      20,
    ],
    [
      "pacscript",
      "denso_vs060",
      "Sub Main\nDim n As Integer\nFor n = 1 To 2\nIf n = 1 Then Call Greifer(n) Else Move P, J(20, 0, 90, 0, 90, 0)\nNext\nEnd Sub\n",
      20,
    ],
  ])(
    "%s: of an If in one line only the call is left out: what stands behind Else is done",
    (id, robotId, text, far) => {
      const answer = executeText(dialectById(id)!, text, "main", robotById(robotId)!, undefined, {
        missingPrograms: "leave-out",
      });
      if (answer.kind === "not-understood") throw new Error(JSON.stringify(answer.faults));
      const joints = answer.program.steps.flatMap(step =>
        step.type === "move" && "q" in step.target ? [Math.round((step.target.q[0]! * 180) / Math.PI)] : [],
      );
      expect(joints).toEqual([far]);
      expect(answer.notExecuted.map(({ sentence }) => sentence.toLowerCase())).toContain(
        "greifer is called here and is in none of the files: what it does, motions too, is not executed.",
      );
    },
  );

  test("all of them are told at once", () => {
    const robot = robotById("kuka_kr6r900sixx")!;
    const krl = dialectById("krl")!;
    const two = TEXTS["krl"]![2].replace("GREIFER ( )", "GREIFER ( )\nAUF ( )");
    const answer = executeText(krl, two, "main", robot);
    expect(answer.kind === "not-understood" && answer.faults.map(({ line }) => line)).toEqual([3, 4]);
  });
});
