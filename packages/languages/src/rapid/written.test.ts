/**
 * A module as a person would write it by the statements of RAPID: the emitter writes the same; and what RAPID refuses.
 */
import { emptyProgram, pose, radians, robotById, type MoveStep, type Program, type Step } from "@twincell/core";
import { expect, test } from "vitest";
import { proveText, runnableFile } from "../prove.ts";
import { rapid } from "./index.ts";

const robot = robotById("abb_irb120")!;
const on = (id: string, frame: string, z_m: number, more: Partial<MoveStep> = {}): MoveStep => ({
  id,
  type: "move",
  path: "lin",
  target: { pose: pose([0, 0, z_m], [0, 1, 0, 0]), frame, tool: "flange" },
  speed: { mps: 0.1 },
  blend_m: 0,
  ...more,
});
const program = (steps: readonly Step[]): Program => ({
  ...emptyProgram(robot.id, "Fill tray"),
  frames: { table: pose([0.3, -0.05, 0.3]) },
  signals: { part: { kind: "digital-in" } },
  pallets: {
    tray: {
      frame: "table",
      origin: pose([0.01, 0.02, 0]),
      rowEnd: [0.07, 0.02, 0],
      columnEnd: [0.01, 0.05, 0],
      rows: 2,
      columns: 3,
      layers: 1,
      layer_m: 0,
      order: "rows-zigzag",
    },
  },
  steps: [
    {
      id: "h",
      name: "Home",
      type: "move",
      path: "ptp",
      target: { q: [0, 0, 0, 0, 90, 0].map(radians), tool: "flange" },
      speed: { mps: 1 },
      blend_m: 0,
    },
    ...steps,
  ],
});
const half = { acceleration: { ratio: 0.5 } } as const;
const whole = program([
  on("a", "table", 0.2, { blend_m: 0.002 }),
  on("b", "table", 0.1),
  { id: "l", type: "payload", mass_kg: 1.25, center_m: [0.01, 0, 0.05] },
  { id: "pal", type: "pallet", pallet: "tray", steps: [on("c", "tray", 0.05, half)] },
  on("d", "table", 0.2, half),
  { id: "if", type: "if", when: { signal: "part", is: true }, then: [on("e", "table", 0.1)] },
  on("f", "table", 0.2),
  { id: "r", type: "repeat", times: 2, steps: [on("g", "table", 0.1)] },
  on("i", "table", 0.25),
]);
function written(of: Program): readonly string[] {
  const emitted = rapid.emit(of, robot);
  if (emitted.kind === "cannot") throw new Error(emitted.sentence);
  expect(proveText(rapid, runnableFile(rapid, emitted.files)!, of, robot).kind).toBe("proven");
  return emitted.files[0]!.text.split("\r\n");
}

test("behind every loop and decision what a motion needs is said anew, data of a routine are declared in it", () => {
  const lines = written(whole);
  expect(lines.slice(lines.indexOf("  PROC main()"))).toEqual([
    "  PROC main()",
    "    VAR num tray_at:=0;",
    "    ConfJ\\On;",
    "    ConfL\\On;",
    "    ! Home",
    "    AccSet 100,100;",
    "    MoveAbsJ Home,v1000,fine,tool0;",
    "    MoveL p10,v100,z2,tool0\\WObj:=table;",
    "    MoveL p20,v100,fine,tool0\\WObj:=table;",
    "    GripLoad load;",
    "    FOR tray_layer FROM 0 TO 0 STEP 1 DO",
    "      FOR tray_line FROM 0 TO 1 STEP 1 DO",
    "        FOR tray_along FROM 0 TO 2 STEP 1 DO",
    "          tray_at:=tray_along;",
    "          IF tray_line MOD 2=1 THEN",
    "            tray_at:=2-tray_along;",
    "          ENDIF",
    "          tray.oframe:=[[10+30*tray_at,20+30*tray_line,0],[1,0,0,0]];",
    "          AccSet 50,100;",
    "          MoveL p30,v100,fine,tool0\\WObj:=tray;",
    "        ENDFOR",
    "      ENDFOR",
    "    ENDFOR",
    "    AccSet 50,100;",
    "    MoveL p40,v100,fine,tool0\\WObj:=table;",
    "    IF DInput(part)=1 THEN",
    "      AccSet 100,100;",
    "      MoveL p50,v100,fine,tool0\\WObj:=table;",
    "    ENDIF",
    "    AccSet 100,100;",
    "    MoveL p60,v100,fine,tool0\\WObj:=table;",
    "    FOR count FROM 1 TO 2 DO",
    "      AccSet 100,100;",
    "      MoveL p70,v100,fine,tool0\\WObj:=table;",
    "    ENDFOR",
    "    AccSet 100,100;",
    "    MoveL p80,v100,fine,tool0\\WObj:=table;",
    "  ENDPROC",
    "ENDMODULE",
    "",
  ]);
});

test("a zone between the predefined ones is made as they are: half as much again for the turn, a degree for ten millimetres of it; a load has its own name", () => {
  const lines = written(whole);
  expect(lines).toContain("  CONST zonedata z2:=[FALSE,2,3,3,0.3,3,0.3];");
  expect(lines).toContain("  CONST loaddata load:=[1.25,[10,0,50],[1,0,0,0],0,0,0];");
});

test("a datum that nothing declares is given no value; one of the module, of the routine or of its head is", () => {
  const module = (...lines: string[]): string =>
    [
      "MODULE a",
      "VAR num here;",
      "PERS robtarget place;",
      "PROC main()",
      ...lines,
      "ENDPROC",
      "PROC rest(num s)",
      "s:=s+1;",
      "WaitTime s;",
      "ENDPROC",
      "ENDMODULE",
      "",
    ].join("\n");
  expect(
    rapid.interpret(
      module(
        "VAR num own;",
        "VAR robtarget p;",
        "own:=1;",
        "here:=own;",
        "p:=[[300,0,400],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];",
        "place:=p;",
        "rest here;",
      ),
      robot,
    ).kind,
  ).toBe("ready");
  expect(rapid.interpret(module("WaitTime 1;", "  count:=1;"), robot)).toMatchObject({
    kind: "not-understood",
    faults: [{ line: 6, column: 3, sentence: '"count" is not declared.', expected: "a datum that is declared" }],
  });
});
