import { describe, expect, test } from "vitest";
import type { CellGeometry } from "../../collision/cell.ts";
import { boxMesh } from "../../mesh/solids.ts";
import { emptyProgram, type MoveStep, type Program, type Step } from "../../program/program.ts";
import { linkSolids } from "../../robots/shapes/index.ts";
import { robotById } from "../../robots/library/index.ts";
import { identity, pose, type Pose } from "../../spatial/pose.ts";
import { fromAxisAngle, multiply, type Quaternion } from "../../spatial/quaternion.ts";
import { degrees, radians } from "../../spatial/units.ts";
import type { Vector3 } from "../../spatial/vector.ts";
import { checkProgram } from "../check.ts";
import type { StepVerdict } from "../verdict.ts";
import { repairAll } from "./repair-all.ts";
import { shiftedPose, RepairSearch, withRepair, type Explanation, type RepairOptions } from "./repair-search.ts";

const robot = robotById("staubli_rx90l")!;
const TORCH: Pose<"flange", "tcp"> = { position: [0, 0, 0.15], quaternion: [0, 0, 0, 1] };
const DOWN: Quaternion = [1, 0, 0, 0];
const tilted = (about: Vector3, angle_deg: number): Quaternion =>
  multiply(fromAxisAngle(about, radians(angle_deg)), DOWN);
const at = (position: Vector3, quaternion: Quaternion = DOWN, frame = "world"): MoveStep["target"] => ({
  pose: { position, quaternion },
  frame,
  tool: "torch",
});
const move = (
  id: string,
  path: MoveStep["path"],
  target: MoveStep["target"],
  more: Partial<MoveStep> = {},
): MoveStep => ({
  id,
  type: "move",
  path,
  target,
  speed: path === "ptp" ? { ratio: 0.4 } : { mps: 0.1 },
  blend_m: 0,
  ...more,
});
const programOf = (steps: readonly Step[], frames: Program["frames"] = {}): Program => ({
  ...emptyProgram(robot.id),
  tools: { torch: TORCH },
  frames,
  steps,
});
const cellOf = (...boxes: readonly (readonly [id: string, centre: Vector3, size: Vector3])[]): CellGeometry => ({
  worldFromBase: identity(),
  links: linkSolids(robot),
  objects: boxes.map(([id, centre, size]) => ({
    id,
    name: id,
    worldFromObject: pose(centre),
    mesh: boxMesh(size),
  })),
  allowedPairs: [],
  shapeError_m: 0,
});
const home = move("home", "ptp", { q: [...robot.home_rad] });
const verdictOf = (program: Program, options: RepairOptions, id: string): StepVerdict =>
  checkProgram(program, robot, options).verdict.steps.find(step => step.id === id)!.verdict;
const explained = (program: Program, id: string, options: RepairOptions = {}): Explanation => {
  const explanation = new RepairSearch(program, robot, options).explain(id);
  if (explanation === undefined) throw new Error(`${id} is not bad.`);
  return explanation;
};

/** A torch held at a slant along a straight edge: joint 5 comes to its limit on the way. */
const edge = programOf([
  home,
  move("a", "ptp", at([0.55, -0.15, 0.35], tilted([0, 1, 0], 20))),
  move("b", "lin", at([0.35, 0.15, 0.55], tilted([0, 1, 0], 62))),
]);

describe("why a step cannot be carried out", () => {
  test("a joint that leaves its limit on the way: which, by how much, over which part, and how the tool stands", () => {
    const { cause, finding, out, sentence } = explained(edge, "b");
    expect(cause).toBe("joint-limit");
    expect(finding).toMatchObject({ code: "limits.joint", joint: 5 });
    expect(degrees(Math.abs(finding.limit))).toBeCloseTo(finding.limit < 0 ? 105 : 120, 6);
    expect(out!.from).toBeGreaterThan(0.05);
    expect(out!.to).toBeCloseTo(1, 2);
    expect(sentence).toMatch(/^Joint 5 would turn to [−-]?\d+\.\d°; its limit is /);
    expect(sentence).toMatch(/ That is so from \d+ % to 100 % of the step\. There the tool stands \d+° off straight/);
    expect(sentence).toMatch(/ down, \d+ mm from axis 1\.$/);
  });

  test("the causes are told apart: too far, a joint limit, contact, too fast", () => {
    const steps = [
      home,
      move("far", "ptp", at([1.5, 0, 0.4])),
      move("near", "ptp", at([0.6, 0, 0.4])),
      move("in", "ptp", at([0.7, 0.3, 0.05])),
    ];
    const search = new RepairSearch(programOf(steps), robot, {
      cell: cellOf(["box", [0.7, 0.3, 0.1], [0.2, 0.2, 0.3]]),
    });
    expect(search.explain("far")).toMatchObject({ cause: "reach", finding: { code: "reach.too-far" } });
    expect(search.explain("in")).toMatchObject({ cause: "collision", finding: { code: "collision.contact" } });
    const fast = move("fast", "lin", at([0.6, -0.3, 0.35]), { speed: { mps: 9 } });
    const quick = explained(programOf([home, move("a", "ptp", at([0.6, 0.3, 0.35])), fast]), "fast");
    expect(quick).toMatchObject({ cause: "speed", repairs: [{ kind: "slower" }] });
    expect(search.explain("home")).toBeUndefined();
    expect(search.explain("nobody")).toBeUndefined();
    expect(
      explained(programOf([home, move("five", "ptp", { q: [0, -1, 2, 0, radians(123.4), 0] })]), "five"),
    ).toMatchObject({ cause: "joint-limit", finding: { joint: 5 } });
  });
});

describe("ways out", () => {
  const cases: readonly (readonly [string, Program, string, RepairOptions])[] = [
    ["a limit on a straight way", edge, "b", {}],
    ["a point too far away", programOf([home, move("far", "ptp", at([1.35, 0.2, 0.4]))]), "far", {}],
    [
      "a part too far away",
      programOf([home, move("far", "ptp", at([0.1, 0, 0.2], DOWN, "part"))], { part: pose([1.25, 0.1, 0.2]) }),
      "far",
      { cell: cellOf(["carton", [1.35, 0.1, 0.3], [0.2, 0.2, 0.1]]), objectsOf: () => ["carton"] },
    ],
    [
      "a point inside a box",
      programOf([home, move("in", "ptp", at([0.7, 0.3, 0.05]))]),
      "in",
      { cell: cellOf(["box", [0.7, 0.3, 0.1], [0.2, 0.2, 0.3]]) },
    ],
    [
      "a taught joint angle",
      programOf([home, move("five", "ptp", { q: [0, -1, 2, 0, radians(123.4), 0] })]),
      "five",
      {},
    ],
  ];
  test.each(cases)(
    "of %s: three at most, of different kinds, the smallest first; with each the check finds the step in order",
    (_, program, id, options) => {
      const { repairs } = explained(program, id, options);
      expect(repairs.length).toBeGreaterThan(0);
      expect(repairs.length).toBeLessThanOrEqual(3);
      expect(new Set(repairs.map(({ kind }) => kind)).size).toBe(repairs.length);
      expect(repairs.map(({ effort }) => effort)).toEqual(
        repairs.map(({ effort }) => effort).toSorted((a, b) => a - b),
      );
      for (const repair of repairs) {
        const after = withRepair(program, id, repair, options.cell, options);
        const worldFromBase =
          repair.moveBase === undefined ? undefined : shiftedPose(identity<"world", "base">(), repair.moveBase.by_m);
        const { verdict } = checkProgram(after.program, robot, {
          ...(after.cell === undefined ? {} : { cell: after.cell }),
          ...(worldFromBase === undefined ? {} : { worldFromBase }),
        });
        expect(verdict.steps.find(step => step.id === id)!.verdict).toMatch(/ok|warn/);
        expect(verdict.steps.filter(step => step.verdict === "bad")).toHaveLength(repair.reaches.bad);
        expect(verdict.duration_s).toBe(repair.reaches.duration_s);
        expect(repair.sentence).toMatch(/^[A-Z].*\.$/);
      }
      expect(verdictOf(program, options, id)).toBe("bad");
    },
    30_000,
  );

  test("the offending joint is said with the value it comes to, inside its limit", () => {
    for (const { reaches } of explained(edge, "b").repairs) {
      expect(reaches.joint).toMatchObject({ joint: 5, unit: "rad" });
      expect(Math.abs(reaches.joint!.value)).toBeLessThan(Math.abs(reaches.joint!.limit));
    }
  });

  test("the part is moved with what stands in its frame, and towards the robot", () => {
    const [, , program, id, options] = ["", ...cases[2]!] as const;
    const part = explained(program, id, options).repairs.find(({ kind }) => kind === "part")!;
    expect(part.sentence).toMatch(/^Move “part” \d+ mm towards the robot\.$|^Move “part” .* in x.*\.$/);
    const after = withRepair(program, id, part, options.cell, options);
    const by = part.moveFrame!.by_m;
    expect(after.cell!.objects[0]!.worldFromObject.position[0]).toBeCloseTo(1.35 + by[0], 12);
    expect(after.program.frames["part"]!.position[0]).toBeCloseTo(1.25 + by[0], 12);
    expect(by[0]).toBeLessThan(0);
  });

  test("a frame that moves with the part takes its points along: both steps are mended, else only one", () => {
    const program = programOf(
      [home, move("far", "ptp", at([0.1, 0, 0.2], DOWN, "part")), move("too", "ptp", at([0.1, 0, 0.2], DOWN, "side"))],
      { part: pose([1.25, 0.1, 0.2]), side: pose([1.25, -0.1, 0.2]) },
    );
    const partOf = (options: RepairOptions) =>
      explained(program, "far", options).repairs.find(({ kind }) => kind === "part")!;
    const together: RepairOptions = { framesOf: () => ["part", "side"] };
    const part = partOf(together);
    expect(part.reaches).toMatchObject({ bad: 0, badBefore: 2 });
    expect(partOf({}).reaches).toMatchObject({ bad: 1, badBefore: 2 });
    const after = withRepair(program, "far", part, undefined, together).program;
    const [x_m] = part.moveFrame!.by_m;
    expect(after.frames["part"]!.position[0]).toBeCloseTo(1.25 + x_m, 12);
    expect(after.frames["side"]!.position[0]).toBeCloseTo(1.25 + x_m, 12);
  });

  test("the robot is not moved where points are joint angles, and that is said", () => {
    const program = programOf([
      move("q", "ptp", { q: [0, -1, 2, 0, 0.6, 0] }),
      move("far", "ptp", at([1.35, 0.2, 0.4])),
    ]);
    const { repairs, tried } = explained(program, "far");
    expect(repairs.some(({ kind }) => kind === "base")).toBe(false);
    expect(tried).toContain("The robot is not moved: the program has points that are joint angles.");
  });

  test("nothing helps: what was tried is said", () => {
    const { repairs, tried } = explained(programOf([home, move("far", "ptp", at([4, 0, 0.4]))]), "far");
    expect(repairs).toEqual([]);
    expect(tried).toContain("Moving the point by up to 1 m does not help.");
    expect(tried).toContain("Tilting the tool by up to 45° does not help.");
  });
});

describe("repair all", () => {
  test("what one shift of the robot mends is not mended point by point", () => {
    const points = [-0.2, 0, 0.2].map((y, i) => move(`p${i}`, i === 0 ? "ptp" : "lin", at([1.2, y, 0.4])));
    const { applied, left, checked, worldFromBase } = repairAll(programOf([home, ...points]), robot);
    expect(left).toEqual([]);
    expect(checked.verdict.ok).toBe(true);
    expect(applied.map(({ repair }) => repair.kind)).toEqual(["base"]);
    expect(worldFromBase.position[0]).toBeGreaterThan(0.05);
  });

  test("bad steps of different kinds are all mended, one after the other; what cannot be is left and named", () => {
    const program = programOf([
      move("q", "ptp", { q: [0, -1, 2, 0, 0.6, 0] }),
      move("far", "ptp", at([1.3, 0.2, 0.4])),
      move("five", "ptp", { q: [0, -1, 2, 0, radians(123.4), 0] }),
      move("never", "ptp", at([5, 0, 0.4])),
    ]);
    const { applied, left } = repairAll(program, robot);
    expect(applied.map(({ step }) => step)).toEqual(["far", "five"]);
    expect(left).toEqual(["never"]);
  });

  test("a good program stays the very same", () => {
    const program = programOf([home, move("a", "ptp", at([0.6, 0, 0.4]))]);
    expect(repairAll(program, robot)).toMatchObject({ applied: [], left: [], effort: 0 });
    expect(repairAll(program, robot).program).toBe(program);
  });
});
