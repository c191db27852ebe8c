/**
 * Listings written out by hand from the statements of TP, not by the emitter; and what they mean, worked out by hand
 * from those statements, not by the interpreter.
 */
import { readFileSync } from "node:fs";
import {
  SignalTable,
  angleBetween,
  compose,
  distance,
  emptyProgram,
  flangePose,
  fromMatrix,
  pose,
  radians,
  robotById,
  seededRandom,
  type MoveStep,
  type Program,
  type Robot,
  type Step,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { PROOF_TOLERANCE } from "../prove.ts";
import { damaged, expectSane } from "../testing/damage.ts";
import { fanucLs } from "./index.ts";
import { readInTime } from "../testing/reading-time.ts";

const robot = robotById("fanuc_lrmate200id")!;
const numbered = (lines: readonly string[]): string =>
  lines.map((line, i) => `${String(i + 1).padStart(4)}:${/^[JLC] PR?\[/.test(line) ? "" : "  "}${line} ;`).join("\r\n");
const listing = (name: string, lines: readonly string[], positions: readonly string[] = []): string =>
  [
    `/PROG  ${name}`,
    "/ATTR",
    "OWNER\t\t= MNEDITOR;",
    'COMMENT\t\t= "";',
    `LINE_COUNT\t= ${lines.length};`,
    "PROTECT\t\t= READ_WRITE;",
    "/MN",
    numbered(lines),
    "/POS",
    ...positions,
    "/END",
    "",
  ].join("\r\n");
const at = (n: number, xyzwpr: readonly number[], config = "N U T, 0, 0, 0", frames = "UF : 0, UT : 1"): string => {
  const [x, y, z, w, p, r] = xyzwpr;
  return `P[${n}]{\n   GP1:\n\t${frames},\t\tCONFIG : '${config}',\n\tX = ${x}  mm,\tY = ${y}  mm,\tZ = ${z}  mm,\n\tW = ${w} deg,\tP = ${p} deg,\tR = ${r} deg\n};`;
};
const joints = (n: number, j: readonly number[]): string =>
  `P[${n}]{\n   GP1:\n\tUF : 0, UT : 1,\t\n${j.map((angle, i) => `\tJ${i + 1}= ${angle} deg`).join(",\n")}\n};`;
function executed(
  text: string,
  signals = new SignalTable(),
  of: Robot = robot,
  worldFromBase = pose<"world", "base">(),
): Step[] {
  const answer = fanucLs.interpret(text, of, worldFromBase);
  if (answer.kind === "not-understood") throw new Error(JSON.stringify(answer.faults));
  const steps: Step[] = [];
  const run = answer.run(signals);
  for (let next = run.next(); next.done !== true && steps.length < 1000; next = run.next())
    if (next.value.step !== undefined) steps.push(next.value.step);
  return steps;
}
const moves = (lines: readonly string[], positions: readonly string[]): MoveStep[] =>
  executed(listing("A", lines, positions)).filter((step): step is MoveStep => step.type === "move");
const rounded = (v: number): number => Math.round(v * 1e6) / 1e6 + 0;
const mm = (step: MoveStep): number[] => {
  if ("q" in step.target) throw new Error("joint angles");
  return step.target.pose.position.map(v => rounded(v * 1000));
};
const faultOf = (text: string): unknown => {
  const answer = fanucLs.interpret(text, robot);
  return answer.kind === "not-understood" ? answer.faults[0] : undefined;
};

describe("executing TP", () => {
  test("J3 is shown against the horizon: the arm's own angle is J3 + J2", () => {
    const [move] = moves(["J P[1] 100% FINE"], [joints(1, [10, 20, -30, 40, -50, 60])]);
    expect(move!.target).toEqual({
      q: [10, 20, -10, 40, -50, 60].map(angle => expect.closeTo(radians(angle), 12)),
      tool: "UTOOL 1",
    });
  });

  test("positions count from the height of axis 2, fixed angles X-Y-Z; .5 without its zero is a number", () => {
    // All joints 0 but J5 at −90°: 50 + 335 mm ahead, 330 + 35 − 80 mm above axis 2, the flange straight down.
    const [pose0, straight] = moves(
      ["J P[1] 50% FINE", "L P[2] 100mm/sec CNT50"],
      [
        at(1, [385, 0, 285, 180, 0, 0]),
        at(2, [385, 100, 285, 180, 0, 90]).replace("385 ", "385.000 ").replace("R = 90", "R = .5"),
      ],
    );
    expect(mm(pose0!)).toEqual([385, 0, 285 + 330]);
    const reached = flangePose(robot.arm, [0, 0, 0, 0, -Math.PI / 2, 0]);
    if ("q" in pose0!.target) throw new Error("joint angles");
    expect(distance(pose0!.target.pose.position, reached.position)).toBeLessThan(1e-9);
    expect(angleBetween(pose0!.target.pose.quaternion, reached.quaternion)).toBeLessThan(1e-9);
    expect(pose0!.target.branch).toEqual({ shoulder: "front", elbow: "up", wrist: "positive" });
    expect([
      pose0!.path,
      pose0!.speed,
      pose0!.blend_ratio,
      straight!.path,
      straight!.speed,
      straight!.blend_ratio,
    ]).toEqual(["ptp", { ratio: 0.5 }, undefined, "lin", { mps: 0.1 }, 0.5]);
  });

  test("W, P, R: Rz(R)·Ry(P)·Rx(W)", () => {
    const q = (w: number, p: number, r: number): number[] => {
      const [step] = moves(["L P[1] 100mm/sec FINE"], [at(1, [400, 0, 200, w, p, r])]);
      if ("q" in step!.target) throw new Error("joint angles");
      return step!.target.pose.quaternion.map(rounded);
    };
    expect(q(90, 0, 0)).toEqual([0.707107, 0, 0, 0.707107]);
    expect(q(0, 90, 0)).toEqual([0, 0.707107, 0, 0.707107]);
    // First about x, then about the z that stays: x goes to y, so the axis is (1, 1, 1).
    expect(q(90, 0, 90)).toEqual([0.5, 0.5, 0.5, 0.5]);
  });

  test("an arc has its first point on the way, in two lines, with or without a colon before the second", () => {
    const positions = [
      at(1, [400, 0, 200, 180, 0, 0]),
      at(2, [400, 50, 250, 180, 0, 0]),
      at(3, [400, 100, 200, 180, 0, 0]),
    ];
    for (const second of ["    :  P[3] 200cm/min FINE    ;", "         P[3] 200cm/min FINE    ;"]) {
      const text = listing("ARC", ["J P[1] 10% FINE", "C P[2]"], positions).replace(
        "C P[2] ;",
        `C P[2]    \r\n${second}`,
      );
      const [, arc] = executed(text) as MoveStep[];
      expect([arc!.path, mm(arc!), arc!.speed]).toEqual([
        "circ",
        [400, 100, 530],
        { mps: expect.closeTo(200 / 6000, 12) },
      ]);
      expect(arc!.via).toMatchObject({ pose: { position: [0.4, 0.05, expect.closeTo(0.58, 12)] } });
    }
  });

  test("CONFIG chooses the posture, its numbers the turn; a move by joints goes to another turn where they ask for it", () => {
    const taught = [10, 20, 30, 20, -60, 30].map(radians);
    const { position, quaternion } = compose(pose<"world", "base">([0, 0, -0.33]), flangePose(robot.arm, taught));
    const [x, y, z, w] = quaternion;
    const deg = (v: number): number => (v * 180) / Math.PI;
    // R = Rz·Ry·Rx read off the quaternion.
    const wpr = [
      deg(Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))),
      deg(Math.asin(2 * (w * y - z * x))),
      deg(Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))),
    ];
    const there = (config: string): MoveStep =>
      moves(
        ["J P[1] 10% FINE"],
        [
          at(
            1,
            [...position.map(v => v * 1000), ...wpr].map(v => Number(v.toFixed(9))),
            config,
          ),
        ],
      )[0]!;
    expect(there("N U T, 0, 0, 0").target).toMatchObject({
      branch: { shoulder: "front", elbow: "up", wrist: "positive" },
    });
    expect(there("F U T, 0, 0, 0").target).toMatchObject({
      branch: { shoulder: "front", elbow: "up", wrist: "negative" },
    });
    // Kept as steps it is refused; executed as it is the nearest posture is taken, which is said.
    const behind = listing("A", ["J P[1] 10% FINE"], [at(1, [640, 0, 0, 180, 0, 0], "N U B, 0, 0, 0")]);
    expect(fanucLs.parse(behind, robot)).toMatchObject({
      faults: [{ sentence: "The position is not reached in its configuration." }],
    });
    expect(fanucLs.interpret(behind, robot)).toMatchObject({
      kind: "ready",
      notExecuted: expect.arrayContaining([
        expect.objectContaining({
          sentence: expect.stringMatching(/does not reach the position in its configuration/),
        }),
      ]) as unknown,
    });
    const turned = there("N U T, 0, 0, -1").target;
    expect("q" in turned && turned.q.map(angle => Math.round(deg(angle)))).toEqual([10, 20, 30, 20, -60, 30 - 360]);
  });

  test("frames and tools are set up from registers, chosen by number, and must be those of the position", () => {
    const setup = [
      "PR[1:torch]=LPOS",
      "PR[1,1]=0",
      "PR[1,2]=0",
      "PR[1,3]=100",
      "PR[1,4]=0",
      "PR[1,5]=0",
      "PR[1,6]=0",
      "UTOOL[1]=PR[1:torch]",
      "PR[2:table]=PR[1]",
      "PR[2,1]=400",
      "PR[2,3]=(-100)",
      "PR[2,6]=90",
      "UFRAME[3]=PR[2:table]",
    ];
    const steps = executed(
      listing(
        "A",
        [...setup, "UFRAME_NUM=3", "UTOOL_NUM=1", "L P[1] 250mm/sec FINE"],
        [at(1, [10, 20, 30, 180, 0, 0], "N U T, 0, 0, 0", "UF : 3, UT : 1")],
      ),
    );
    expect(steps[0]).toMatchObject({
      target: { frame: "table", tool: "torch", pose: { position: [0.01, 0.02, expect.closeTo(0.03, 12)] } },
    });
    const ready = fanucLs.interpret(
      listing(
        "A",
        [...setup, "UFRAME_NUM=3", "UTOOL_NUM=1", "L P[1] 250mm/sec FINE"],
        [at(1, [10, 20, 30, 180, 0, 0], "N U T, 0, 0, 0", "UF : 3, UT : 1")],
      ),
      robot,
      pose([1, 0, 0.5]),
    );
    expect(ready).toMatchObject({
      context: {
        frames: { table: { position: [1.4, 0, expect.closeTo(0.5 + 0.33 - 0.1, 12)] } },
        tools: { torch: { position: [0, 0, 0.1] } },
      },
    });
    expect(
      faultOf(listing("A", ["UFRAME_NUM=2", "L P[1] 250mm/sec FINE"], [at(1, [400, 0, 200, 180, 0, 0])])),
    ).toMatchObject({ line: 9, sentence: "P[1] was taught with UFRAME 0, and 2 is in use." });
  });

  test("waits, lines, pulses, messages, loops, decisions, programs and registers", () => {
    const text =
      listing("MAIN", [
        "!a remark; it says nothing",
        "R[1:rounds]=0",
        "FOR R[2]=3 DOWNTO 1",
        "WAIT   0.50(sec)",
        "R[1]=(R[1]+R[2])",
        "ENDFOR",
        "WAIT R[1]",
        "DO[3:lamp]=ON",
        "DO[3]=PULSE,0.5sec",
        "AO[1]=2.5",
        "RO[1]=ON",
        "RO[2]=OFF",
        "MESSAGE[Part 5: done]",
        "IF (DI[1:part]=ON AND R[1]=6) THEN",
        "WAIT   1.00(sec)",
        "ELSE",
        "CALL OTHER",
        "ENDIF",
        "IF DI[1]=ON,JMP LBL[2]",
        "RO[1]=OFF",
        "LBL[2:behind]",
        "WAIT DI[2]=OFF",
        "$WAITTMOUT=250",
        "WAIT AI[1]>3 TIMEOUT,LBL[9]",
        "//DO[7]=ON",
        "PAYLOAD[1]",
        "OVERRIDE=50%",
        "ABORT",
        "END",
        "LBL[9]",
        "ABORT",
      ]) + listing("OTHER", ["WAIT   9.00(sec)"]);
    const rest = (open: boolean): Step[] => executed(text, new SignalTable([["part", open]]));
    const before = [
      { s: 0.5 },
      { s: 0.5 },
      { s: 0.5 },
      { s: 6 },
      { type: "set", signal: "lamp", to: true },
      { signal: "lamp", pulse_s: 0.5 },
      { signal: "AO[1]", to: 2.5 },
      { type: "gripper", closed: true },
      { signal: "RO[2]", to: false },
      { type: "message", text: "Part 5: done" },
    ];
    const behind = [
      { type: "wait-for", when: { signal: "DI[2]", is: false } },
      { when: { signal: "AI[1]", above: 3 }, timeout_s: 2.5 },
      { type: "stop" },
    ];
    expect(rest(true)).toMatchObject([...before, { s: 1 }, ...behind]);
    expect(rest(false)).toMatchObject([...before, { s: 9 }, { type: "gripper", closed: false }, ...behind]);
  });

  test("labels and jumps: a loop without end is read as one, others are written out", () => {
    const forever = listing("A", ["LBL[1]", "WAIT   1.00(sec)", "JMP LBL[1]"]);
    expect(executed(forever)).toHaveLength(1000);
    expect(fanucLs.parse(forever, robot)).toMatchObject({
      program: { steps: [{ type: "repeat", times: "forever", steps: [{ type: "wait" }] }] },
    });
    const counted = listing("A", [
      "R[1]=0",
      "LBL[1]",
      "R[1]=R[1]+1",
      "WAIT   1.00(sec)",
      "IF R[1]<3,JMP LBL[1]",
      "WAIT   2.00(sec)",
    ]);
    expect(executed(counted)).toMatchObject([{ s: 1 }, { s: 1 }, { s: 1 }, { s: 2 }]);
    expect(fanucLs.parse(counted, robot)).toMatchObject({
      warnings: [{ line: 1 }],
      program: { steps: [{}, {}, {}, {}] },
    });
    expect(faultOf(listing("A", ["LBL[1]", "R[1]=1", "JMP LBL[1]"]))).toMatchObject({
      expected: "a motion, a wait or an end",
    });
  });

  test("SELECT goes where the value says, ELSE where none does; registers of positions keep their names; a name may begin with a sign", () => {
    const text = (value: number): string =>
      listing("-BCKED2-", [
        `R[1:KIND]=${value}`,
        "PR[5,3:ABOVE TABLE]=12",
        "SELECT R[1:KIND]=1,JMP LBL[1]",
        "       =2,JMP LBL[2]",
        "       ELSE,JMP LBL[9]",
        "LBL[1]",
        "DO[1]=ON",
        "END",
        "LBL[2]",
        "DO[2]=ON",
        "END",
        "LBL[9]",
        "DO[9]=ON",
      ]);
    const set = (value: number): unknown =>
      executed(text(value)).map(step => (step.type === "set" ? step.signal : step.type));
    expect([set(1), set(2), set(7)]).toEqual([["DO[1]"], ["DO[2]"], ["DO[9]"]]);
  });

  test("a search ends at its line; its label says what happens when nothing comes", () => {
    const positions = [at(1, [400, 0, 200, 180, 0, 0])];
    expect(
      moves(["SKIP CONDITION DI[5]=ON", "L P[1] 20mm/sec FINE ACC50 Skip,LBL[1]", "LBL[1]"], positions),
    ).toMatchObject([
      { acceleration: { ratio: 0.5 }, until: { when: { signal: "DI[5]", is: true }, missing: "continue" } },
    ]);
    expect(
      moves(["SKIP CONDITION DI[5]=OFF", "L P[1] 20mm/sec FINE Skip,LBL[1]", "END", "LBL[1]", "ABORT"], positions),
    ).toMatchObject([{ until: { when: { is: false }, missing: "fault" } }]);
  });

  test("an offset shifts along the axes of the frame; nothing that is not known is guessed", () => {
    const positions = [at(1, [400, 0, 200, 180, 0, 0])];
    const shifted = moves(
      [
        "PR[3]=LPOS",
        ...[1, 2, 3, 4, 5, 6].map(i => `PR[3,${i}]=${i < 4 ? i * 10 : 0}`),
        "L P[1] 20mm/sec FINE Offset,PR[3]",
      ],
      positions,
    );
    expect(mm(shifted[0]!)).toEqual([410, 20, 560]);
    expect(faultOf(listing("A", ["J P[7] 10% FINE"], positions))).toMatchObject({
      line: 8,
      sentence: "P[7] is not in the list of positions.",
    });
    expect(fanucLs.parse(listing("A", ["CALL NOBODY"]), robot)).toMatchObject({
      kind: "not-understood",
      faults: [
        {
          sentence:
            "NOBODY is called here and is in none of the files: give the file that holds it as well, or let the call do nothing.",
        },
      ],
    });
    expect(faultOf(listing("A", ["WEAVE SINE[1]"]))).toMatchObject({
      line: 8,
      column: 8,
      sentence: '"WEAVE" is no statement of TP that is executed here.',
    });
    expect(
      fanucLs.parse(
        listing(
          "A",
          ["J P[1] 10% FINE"],
          [
            "P[1]{\n   GP1:\n\tUF : 0, UT : 1,\tCONFIG : 'N U T, 0, 0, 0',\n\tX = ******** mm, Y = ******** mm, Z = ******** mm,\n\tW = ******** deg, P = ******** deg, R = ******** deg\n};",
          ],
        ),
        robot,
      ),
    ).toMatchObject({ faults: [{ sentence: "The position was never taught: it is ********." }] });
  });
});

describe("golden poses", () => {
  const orientations = JSON.parse(
    readFileSync(new URL("../../../../fixtures/conventions/orientations.json", import.meta.url), "utf8"),
  ) as {
    readonly cases: readonly {
      readonly matrix: readonly (readonly number[])[];
      readonly fanuc_WPR_yaskawa_RxRyRz_deg: readonly number[];
    }[];
  };
  interface Sample {
    readonly q: readonly number[];
    readonly vendor_pose: {
      readonly X: number;
      readonly Y: number;
      readonly Z: number;
      readonly W: number;
      readonly P: number;
      readonly R: number;
    };
  }
  const samples = (
    JSON.parse(
      readFileSync(new URL("../../../../fixtures/kinematics/fanuc_lrmate200id.forward.json", import.meta.url), "utf8"),
    ) as { readonly samples: readonly Sample[] }
  ).samples;

  test("47 orientations, 7 of them singular: W, P, R mean the matrix that scipy and robodk say", () => {
    expect(orientations.cases).toHaveLength(47);
    for (const { matrix, fanuc_WPR_yaskawa_RxRyRz_deg: wpr } of orientations.cases) {
      const wanted = fromMatrix(matrix.slice(0, 3).flatMap(row => row.slice(0, 3)));
      const [step] = moves(["L P[1] 100mm/sec FINE"], [at(1, [400, 0, 200, ...wpr])]);
      if ("q" in step!.target) throw new Error("no pose");
      expect(angleBetween(step!.target.pose.quaternion, wanted)).toBeLessThan(PROOF_TOLERANCE.angle_rad);
    }
  });

  test("200 postures: what is written are the numbers of pinocchio and robodk, to the last of three decimals", () => {
    let written = 0;
    for (const { q, vendor_pose } of samples) {
      const step: MoveStep = {
        id: "a",
        type: "move",
        path: "lin",
        target: {
          pose: compose(pose<"frame", "base">(), compose(flangePose(robot.arm, q), pose<"flange", "tcp">())),
          frame: "world",
          tool: "flange",
        },
        speed: { mps: 0.1 },
        blend_m: 0,
      };
      const program: Program = { ...emptyProgram(robot.id), steps: [step] };
      const emitted = fanucLs.emit(program, robot);
      if (emitted.kind === "cannot") continue;
      written++;
      for (const name of ["X", "Y", "Z"] as const)
        expect(
          Math.abs(
            Number(new RegExp(`\\t${name} = +(-?[0-9.]+)  mm`).exec(emitted.files[0]!.text)![1]) - vendor_pose[name],
          ),
        ).toBeLessThan(5.1e-4);
      if (Math.abs(vendor_pose.P) > 89.9) continue;
      for (const name of ["W", "P", "R"] as const) {
        const off =
          Number(new RegExp(`${name} = +(-?[0-9.]+) deg`).exec(emitted.files[0]!.text)![1]) - vendor_pose[name];
        expect(Math.abs(Math.sin((off / 360) * Math.PI))).toBeLessThan((5.1e-4 / 360) * Math.PI);
      }
    }
    expect(written).toBeGreaterThan(190);
  });
});

test("a listing of 100,000 lines is read in less than two seconds", () => {
  const lines = Array.from({ length: 100_000 }, (_, i) => `J P[${1 + (i % 50)}] 50% CNT100`);
  const text = listing(
    "LONG",
    lines,
    Array.from({ length: 50 }, (_, i) => joints(i + 1, [i, 10, -20, 30, -40, 50])),
  );
  const { parsed, least_s } = readInTime(fanucLs, text, robot);
  expect(parsed.kind === "parsed" && parsed.program.steps.length).toBe(100_000);
  expect(least_s).toBeLessThan(2);
});

test("2,000 damaged listings: no throw, no hang, every fault with its place", () => {
  const next = seededRandom(7);
  const source = listing(
    "A",
    [
      "J P[1] 50% FINE",
      "FOR R[1]=1 TO 3",
      "L P[2] 100mm/sec CNT50 Offset,PR[1]",
      "ENDFOR",
      "IF (DI[1:part]=ON) THEN",
      "CALL B",
      "ENDIF",
      "LBL[1]",
      "WAIT DI[2]=ON TIMEOUT,LBL[1]",
      "JMP LBL[1]",
    ],
    [joints(1, [0, 0, 0, 0, -90, 0]), at(2, [400, 0, 200, 180, 0, 0])],
  );
  for (let i = 0; i < 2000; i++) {
    const text = damaged(source, next);
    const answer = fanucLs.interpret(text, robot);
    if (answer.kind === "not-understood") expectSane(answer.faults, text);
  }
});
