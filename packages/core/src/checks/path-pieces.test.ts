import { describe, expect, test } from "vitest";
import type { CellGeometry } from "../collision/cell.ts";
import { boxMesh } from "../mesh/solids.ts";
import { emptyProgram, type MoveStep, type Program, type Step } from "../program/program.ts";
import { robotById } from "../robots/library/index.ts";
import { linkSolids } from "../robots/shapes/index.ts";
import { identity, type Pose } from "../spatial/pose.ts";
import type { Quaternion } from "../spatial/quaternion.ts";
import { degrees, radians } from "../spatial/units.ts";
import { samplePlan } from "../trajectory/sample.ts";
import { checkProgram } from "./check.ts";
import { pathPieces } from "./path-pieces.ts";

const robot = robotById("staubli_rx90l")!;
const TORCH: Pose<"flange", "tcp"> = { position: [0, 0, 0.15], quaternion: [0, 0, 0, 1] };
const DOWN: Quaternion = [1, 0, 0, 0];
const move = (id: string, path: MoveStep["path"], target: MoveStep["target"]): MoveStep => ({
  id,
  type: "move",
  path,
  target,
  speed: path === "lin" ? { mps: 0.2 } : { ratio: 0.5 },
  blend_m: 0,
});
const at = (x: number, y: number, z: number): MoveStep["target"] => ({
  pose: { position: [x, y, z], quaternion: DOWN },
  frame: "world",
  tool: "torch",
});
const programOf = (...steps: readonly Step[]): Program => ({
  ...emptyProgram(robot.id),
  tools: { torch: TORCH },
  steps,
});
const ready = move("ready", "ptp", { q: [0, -1, 2, 0, 0.6, 0] });
const pieces = (program: Program, cell?: CellGeometry) => {
  const checked = checkProgram(program, robot, cell ? { cell } : {});
  return { checked, pieces: pathPieces(checked, program, robot, cell) };
};

describe("the path of the TCP in pieces of one verdict", () => {
  test("L-39 while joint 5 is swept from 30° to 125° the verdict changes at 110° and at 120°, 10° before its limit and there", () => {
    const fifth = (deg: number) => move(`j5 ${deg}`, "ptp", { q: [0, -1, 2, 0, radians(deg), 0] });
    const { checked, pieces: cut } = pieces(programOf(fifth(30), fifth(125)));
    const swept = cut.filter(({ step }) => step === "j5 125");
    expect(swept.map(({ verdict }) => verdict)).toEqual(["ok", "warn", "bad"]);
    const q = new Float64Array(6);
    const fifthAt = (t_s: number): number => {
      samplePlan(checked.plan, t_s, q);
      return degrees(q[4]!);
    };
    expect(fifthAt(swept[1]!.from_s)).toBeCloseTo(110, 1);
    expect(fifthAt(swept[2]!.from_s)).toBeCloseTo(120, 1);
    for (const [i, piece] of swept.entries()) {
      if (i === 0) continue;
      expect(piece.from_s).toBe(swept[i - 1]!.to_s);
      expect(piece.points[0]).toEqual(swept[i - 1]!.points.at(-1));
    }
  });

  test("only the part of a move in which the arm is inside a box is bad", () => {
    const box: CellGeometry = {
      worldFromBase: identity(),
      links: linkSolids(robot),
      objects: [
        {
          id: "post",
          name: "Post",
          worldFromObject: { position: [0.6, 0, 0.35], quaternion: [0, 0, 0, 1] },
          mesh: boxMesh([0.1, 0.1, 0.7]),
        },
      ],
      allowedPairs: [],
      shapeError_m: 0,
    };
    const { pieces: cut } = pieces(
      programOf(ready, move("a", "ptp", at(0.6, -0.4, 0.4)), move("b", "lin", at(0.6, 0.4, 0.4))),
      box,
    );
    const across = cut.filter(({ step }) => step === "b");
    expect(across.map(({ verdict }) => verdict).filter(verdict => verdict === "bad")).toHaveLength(1);
    expect(across[0]!.verdict).toBe("ok");
    expect(across.at(-1)!.verdict).toBe("ok");
  });

  test("L-38 a straight line leads to a target that nothing reaches, and on from there", () => {
    const { pieces: cut } = pieces(
      programOf(ready, move("far", "ptp", at(2.5, 0, 0.4)), move("back", "ptp", at(0.7, 0, 0.4))),
    );
    const far = cut.find(({ step }) => step === "far")!;
    expect(far).toMatchObject({ verdict: "bad" });
    expect(far.to_s).toBe(far.from_s);
    expect(far.points.at(-1)).toEqual([2.5, 0, 0.4]);
    expect(far.points[0]).toEqual(
      cut
        .filter(({ step }) => step === "ready")
        .at(-1)!
        .points.at(-1),
    );
  });

  test("a program that is ok has no piece that is not, and they leave out no motion", () => {
    const { checked, pieces: cut } = pieces(
      programOf(ready, move("a", "ptp", at(0.7, 0.1, 0.4)), move("b", "lin", at(0.7, -0.1, 0.4))),
    );
    expect(checked.verdict.ok).toBe(true);
    expect(new Set(cut.map(({ verdict }) => verdict))).toEqual(new Set(["ok"]));
    expect(cut.map(({ step }) => step)).toEqual(["ready", "a", "b"]);
  });
});
