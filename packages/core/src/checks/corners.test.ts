import { describe, expect, test } from "vitest";
import { CellCollider } from "../collision/cell-collider.ts";
import type { CellGeometry } from "../collision/cell.ts";
import { flangePose } from "../kinematics/forward.ts";
import { boxMesh } from "../mesh/solids.ts";
import type { Robot } from "../model/robot.ts";
import { applyRepair } from "../program/edit.ts";
import { emptyProgram, type MoveStep, type Program } from "../program/program.ts";
import { seededRandom } from "../random.ts";
import { robotById } from "../robots/library/index.ts";
import { linkSolids } from "../robots/shapes/index.ts";
import { pose, type Pose } from "../spatial/pose.ts";
import type { Quaternion } from "../spatial/quaternion.ts";
import type { Vector3 } from "../spatial/vector.ts";
import { cornerRuleOf, withRuledCorners, withStops } from "../trajectory/corner-rules.ts";
import { planProgram } from "../trajectory/planner.ts";
import { samplePlan } from "../trajectory/sample.ts";
import { checkProgram } from "./check.ts";

const rx90 = robotById("staubli_rx90l")!;
const gp8 = robotById("yaskawa_gp8")!;
const ur10e = robotById("ur10e")!;
const lrMate = robotById("fanuc_lrmate200id")!;
const DOWN: Quaternion = [1, 0, 0, 0];
/** The same arm, of whose controllers nothing is known. */
const bare = ({ vendorSection: _, ...robot }: Robot): Robot => robot;

const cellOf = (robot: Robot, ...boxes: readonly [at: Vector3, side_m: Vector3][]): CellGeometry => ({
  worldFromBase: pose(),
  links: linkSolids(robot),
  objects: boxes.map(([at, side], i) => ({
    id: `box-${i + 1}`,
    name: "Box",
    worldFromObject: pose(at),
    mesh: boxMesh(side),
  })),
  tool: { name: "Tool", mesh: shifted(boxMesh([0.01, 0.01, 0.15]), 0.075) },
  allowedPairs: [],
  shapeError_m: 0,
});
const shifted = (mesh: ReturnType<typeof boxMesh>, z_m: number): ReturnType<typeof boxMesh> => ({
  ...mesh,
  positions: mesh.positions.map((value, i) => (i % 3 === 2 ? value + z_m : value)),
});
const TOOLS = { torch: pose<"flange", "tcp">([0, 0, 0.15]) };
const lin = (id: string, at: Vector3, blend_m = 0): MoveStep => ({
  id,
  type: "move",
  path: "lin",
  target: { pose: { position: at, quaternion: DOWN }, frame: "world", tool: "torch" },
  speed: { mps: 0.2 },
  blend_m,
});
const ptp = (id: string, q: readonly number[], blend_m = 0): MoveStep => ({
  id,
  type: "move",
  path: "ptp",
  target: { q },
  speed: { ratio: 0.5 },
  blend_m,
});
const programOf = (robot: Robot, ...steps: readonly MoveStep[]): Program => ({
  ...emptyProgram(robot.id),
  tools: TOOLS,
  steps,
});
const READY: readonly number[] = [0, -1, 2, 0, 0.6, 0];
/** Along x, then along y; the corner is at (0.6, 0). */
const square = (blend_m: number): Program =>
  programOf(
    rx90,
    ptp("ready", READY),
    lin("to", [0.45, 0, 0.3]),
    lin("corner", [0.6, 0, 0.3], blend_m),
    lin("on", [0.6, 0.15, 0.3]),
  );
const codesOf = (program: Program, robot: Robot, cell: CellGeometry): readonly string[] =>
  checkProgram(program, robot, { cell }).bad.map(({ code }) => code);

describe("a corner that is rounded is proven for whatever curve the controller takes in it", () => {
  test("T-63 what only the sharp corner meets is red, with the corner's sentence", () => {
    // Beyond the point, where the planned curve does not come to.
    const cell = cellOf(rx90, [
      [0.615, -0.015, 0.3],
      [0.03, 0.03, 0.1],
    ]);
    const { bad, verdict } = checkProgram(square(0.06), rx90, { cell });
    expect(bad.map(({ code }) => code)).toEqual(["collision.corner"]);
    expect(verdict.ok).toBe(false);
    expect(bad[0]!.sentence).toMatch(
      /^The tool .* “Box” at \d+\.\d\d s.* The controller may round this corner otherwise than planned: use zone 0, or leave more room\.$/,
    );
    // Stopping there would not help.
    expect(bad[0]!.repairs).toEqual([]);
    expect(codesOf(square(0), rx90, cell)).toEqual(["collision.contact", "collision.contact"]);
  });

  test("T-63 what only a wider curve meets is red, and zone 0 is the way out", () => {
    const cell = cellOf(rx90, [
      [0.565, 0.035, 0.3],
      [0.012, 0.012, 0.1],
    ]);
    const program = square(0.06);
    const { bad } = checkProgram(program, rx90, { cell });
    expect(bad.map(({ code }) => code)).toEqual(["collision.corner"]);
    const [repair] = bad[0]!.repairs;
    expect(repair).toMatchObject({ kind: "zone", replace: { id: "corner", blend_m: 0 } });
    expect(checkProgram(applyRepair(program, "corner", repair!), rx90, { cell }).verdict.ok).toBe(true);
    expect(codesOf(square(0.02), rx90, cell)).toEqual([]);
  });

  test("with room all round it stays green", () => {
    expect(
      codesOf(
        square(0.06),
        rx90,
        cellOf(rx90, [
          [0.8, 0.3, 0.3],
          [0.1, 0.1, 0.1],
        ]),
      ),
    ).toEqual([]);
  });

  test("T-63 a corner that the arm reaches not all over is said, with zone 0 as the way out, and the program is not called clear", () => {
    const { tool: _, ...far } = cellOf(ur10e, [
      [-1.5, 1.5, 0.3],
      [0.1, 0.1, 0.1],
    ]);
    const at = (id: string, position: Vector3, blend_m = 0): MoveStep => ({
      ...lin(id, position, blend_m),
      target: { pose: { position, quaternion: DOWN }, frame: "world", tool: "flange" },
    });
    // Both ways lead past the column of the arm, and the chord that cuts the corner off leads through it.
    const program: Program = {
      ...programOf(ur10e),
      steps: [
        { ...at("ready", [-0.3, -0.6, 0.3]), path: "ptp", speed: { ratio: 0.5 } },
        at("corner", [0.4, 0, 0.3], 0.6),
        at("on", [-0.3, 0.6, 0.3]),
      ],
    };
    const { verdict, bad } = checkProgram(program, ur10e, { cell: far });
    const corner = verdict.steps.find(({ id }) => id === "corner")!;
    expect(bad).toEqual([]);
    expect(corner.verdict).toBe("unknown");
    expect(corner.findings.map(({ code }) => code)).toEqual(["collision.corner-out-of-reach"]);
    expect(corner.findings[0]!.sentence).toMatch(/^The corner at \d+\.\d\d s is not proven clear all over: /);
    expect(verdict.ok).toBe(false);
    const sharp = applyRepair(program, "corner", corner.findings[0]!.repairs[0]!);
    expect(checkProgram(sharp, ur10e, { cell: far }).verdict.ok).toBe(true);
  });

  test("T-63 levels and shares count where the robot's language has no distances: a GP8 takes PL=1 for 4 mm", () => {
    const q = (s: number, l: number): number[] => [s, l, -0.2, 0, -1.2, 0];
    const program = programOf(gp8, ptp("a", q(0, 0)), ptp("b", q(0.5, 0), 0.004), ptp("c", q(0.5, 0.5)));
    const between = flangePose(gp8.arm, q(0.5 - 0.012, 0.012)) as Pose;
    const corner = flangePose(gp8.arm, q(0.5, 0)) as Pose;
    const into = between.position.map((v, k) => v - corner.position[k]!) as Vector3;
    const length = Math.hypot(...into);
    // A small ball's worth of box where 12.5 mm of rounding leads, and 4 mm do not.
    const at = corner.position.map((v, k) => v + (into[k]! / length) * 0.012) as Vector3;
    const cell: CellGeometry = {
      ...cellOf(gp8, [at, [0.002, 0.002, 0.002]]),
      links: [],
      tool: { name: "Tip", mesh: boxMesh([0.002, 0.002, 0.002]) },
    };
    expect([codesOf(program, bare(gp8), cell), codesOf(program, gp8, cell)]).toEqual([[], ["collision.corner"]]);
  });
});

describe.each([["yaskawa_gp8", gp8, "inform"] as const, ["fanuc_lrmate200id", lrMate, "fanuc-ls"] as const])(
  "%s",
  (_, robot, language) => {
    test("T-63 of 40 random programs among boxes that are green, none touches anything with stops, with the corners of its language, or with any between", () => {
      const random = seededRandom(5);
      const rule = cornerRuleOf(language)!;
      let green = 0;
      let differ = 0;
      for (let k = 0; k < 40; k++) {
        const program = randomCorner(robot, random);
        const targets = program.steps.map(step => (step.type === "move" && "q" in step.target ? step.target.q : []));
        const near = flangePose(robot.arm, targets[1]!).position;
        const off = (): number => 0.24 * (random() - 0.5);
        const cell = cellOf(robot, [
          near.map(v => v + off()) as Vector3,
          [0.04 + 0.1 * random(), 0.04 + 0.1 * random(), 0.04 + 0.1 * random()],
        ]);
        const collider = new CellCollider(cell, robot.arm);
        collider.allowContactsAt(robot.home_rad);
        const touches = (other: Program): boolean => {
          const { plan } = planProgram(other, robot, { start_rad: targets[0]! });
          const q = new Float64Array(6);
          for (let t_s = 0; t_s <= plan.duration_s; t_s += 0.012) {
            samplePlan(plan, t_s, q);
            if (collider.collides(q)) return true;
          }
          return false;
        };
        const { verdict, bad } = checkProgram(program, robot, { cell, start_rad: targets[0]! });
        differ += bad.some(({ code }) => code === "collision.corner") ? 1 : 0;
        if (!verdict.ok) continue;
        green++;
        const ruled = withRuledCorners(program, robot, rule, program);
        const between = {
          ...ruled,
          steps: ruled.steps.map(step =>
            step.type === "move"
              ? { ...step, blend_m: step.blend_m * random(), blend_ratio: (step.blend_ratio ?? 0) * random() }
              : step,
          ),
        };
        expect([touches(withStops(program)), touches(ruled), touches(between)]).toEqual([false, false, false]);
      }
      expect(green).toBeGreaterThan(5);
      expect(differ).toBeGreaterThan(0);
    });
  },
);

function randomCorner(robot: Robot, random: () => number): Program {
  const some = (by: number): number => by * (2 * random() - 1);
  const home = robot.home_rad;
  const q = [0, 1, 2].map(() => home.map((v, j) => v + some(j < 3 ? 0.3 : 0.4)));
  const path = random() < 0.6 ? ptp : straight;
  return {
    ...programOf(robot),
    steps: [ptp("a", q[0]!), path("b", q[1]!, 0.005 + 0.06 * random()), (random() < 0.5 ? ptp : straight)("c", q[2]!)],
  };
}
const straight = (id: string, q: readonly number[], blend_m = 0): MoveStep => ({
  ...ptp(id, q, blend_m),
  path: "lin",
  speed: { mps: 0.3 },
});
