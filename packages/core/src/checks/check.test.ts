import { describe, expect, test } from "vitest";
import type { CellGeometry } from "../collision/cell.ts";
import { flangePose } from "../kinematics/forward.ts";
import { linkSolids } from "../robots/shapes/index.ts";
import { robotById } from "../robots/library/index.ts";
import { boxMesh } from "../mesh/solids.ts";
import { compose, identity, pose, type Pose } from "../spatial/pose.ts";
import { fromAxisAngle, multiply, type Quaternion } from "../spatial/quaternion.ts";
import { degrees, radians } from "../spatial/units.ts";
import type { Vector3 } from "../spatial/vector.ts";
import { judgePlan } from "../trajectory/judge.ts";
import { checkProgram, type CheckOptions } from "./check.ts";
import { applyRepair } from "../program/edit.ts";
import { emptyProgram, type MoveStep, type Program, type Step } from "../program/program.ts";
import type { Finding, StepReport, Verdict } from "./verdict.ts";

const robot = robotById("staubli_rx90l")!;
const TORCH: Pose<"flange", "tcp"> = { position: [0, 0, 0.15], quaternion: [0, 0, 0, 1] };
const DOWN: Quaternion = [1, 0, 0, 0];

const at = (position: Vector3, quaternion: Quaternion = DOWN): MoveStep["target"] => ({
  pose: { position, quaternion },
  frame: "world",
  tool: "torch",
});
const move = (
  id: string,
  path: MoveStep["path"],
  target: MoveStep["target"],
  speed: MoveStep["speed"] = { ratio: 0.5 },
  blend_m = 0,
): MoveStep => ({ id, type: "move", path, target, speed, blend_m });
const programOf = (...steps: readonly Step[]): Program => ({
  ...emptyProgram(robot.id),
  tools: { torch: TORCH },
  steps,
});
const check = (program: Program, options: CheckOptions = {}): Verdict => checkProgram(program, robot, options).verdict;
function reportOf(verdict: Verdict, id: string): StepReport {
  const found = verdict.steps.find(step => step.id === id);
  if (found === undefined) throw new Error(`No report of ${id}.`);
  return found;
}
function findingOf(verdict: Verdict, id: string, code: string): Finding {
  const found = reportOf(verdict, id).findings.find(finding => finding.code === code);
  if (found === undefined) throw new Error(`${id} has no ${code}: ${JSON.stringify(reportOf(verdict, id))}`);
  return found;
}
const READY: readonly number[] = [0, -1, 2, 0, 0.6, 0];
const ready = move("ready", "ptp", { q: READY });
const fifth = (angle_deg: number): MoveStep => move("five", "ptp", { q: [0, -1, 2, 0, radians(angle_deg), 0] });

describe("checkProgram", () => {
  test("a good program is ok and says what it rests on", () => {
    const verdict = check(
      programOf(ready, move("a", "lin", at([0.55, 0.1, 0.35]), { mps: 0.2 }), { id: "w", type: "wait", s: 0.5 }),
    );
    expect(verdict).toMatchObject({
      ok: true,
      clearance_m: null,
      steps: [{ verdict: "ok" }, { verdict: "ok" }, { verdict: "ok" }],
    });
    expect(verdict.duration_s).toBeGreaterThan(0.5);
    expect(verdict.assumptions.join(" ")).toMatch(/accelerations are not published.*no cell was given/);
  });

  test("L-39 joint 5: ok, near from 10° before its limit, bad beyond it", () => {
    expect(reportOf(check(programOf(fifth(109.9))), "five").verdict).toBe("ok");
    const near = check(programOf(fifth(110.1)));
    expect(near.ok).toBe(true);
    expect(findingOf(near, "five", "limits.near")).toMatchObject({
      joint: 5,
      unit: "rad",
      sentence: "Joint 5 turns to 110.1°, 9.9° before its limit of 120.0°.",
    });
    expect(reportOf(check(programOf(fifth(119.9))), "five").verdict).toBe("warn");
    expect(reportOf(check(programOf(fifth(120.1))), "five").verdict).toBe("bad");
  });

  test("L-56 a joint out of its limit: the joint, the value and the limit", () => {
    const verdict = check(programOf(ready, fifth(123.4)));
    expect(verdict.ok).toBe(false);
    const finding = findingOf(verdict, "five", "limits.joint");
    expect(finding).toMatchObject({
      joint: 5,
      unit: "rad",
      sentence: "Joint 5 would turn to 123.4°; its limit is 120.0°.",
    });
    expect(degrees(finding.value)).toBeCloseTo(123.4, 6);
    expect(degrees(finding.limit)).toBeCloseTo(120, 6);
    expect(finding.at_s).toBeCloseTo(verdict.duration_s, 6);
  });

  test("L-38 a limit inside a straight path between good ends is found, and the path is there to draw", () => {
    // The tool turns about its own axis on the way: joint 6 runs beyond 270° while both ends would have a posture.
    const spun = (turn_deg: number): Quaternion => multiply(fromAxisAngle([0, 0, 1], radians(turn_deg)), DOWN);
    const steps = [
      move("a", "ptp", { q: [0, -0.6, 2.1, 0, Math.PI - 1.5, radians(200)] }),
      ...[1, 2, 3].map(i =>
        move(
          `l${i}`,
          "lin",
          { pose: { position: [0.55, 0.05 * i, 0.4], quaternion: spun(-20 - 60 * i) }, frame: "world", tool: "torch" },
          { mps: 0.1 },
        ),
      ),
    ];
    const { verdict, plan } = checkProgram(programOf(...steps), robot);
    const bad = verdict.steps.filter(step => step.verdict === "bad");
    expect(bad.length).toBeGreaterThan(0);
    expect(bad[0]!.findings[0]).toMatchObject({ code: "limits.joint", joint: 6 });
    expect(new Set(plan.segments.map(segment => segment.step))).toEqual(new Set(steps.map(step => step.id)));
    expect(judgePlan(plan, robot).filter(flaw => flaw.code !== "plan.limit")).toEqual([]);
  });

  test("L-26 L-56 too fast: the joint is named, and the offered speed is kept", () => {
    const fast = move("fast", "lin", at([0.55, 0.3, 0.35]), { mps: 6 });
    const verdict = check(programOf(ready, fast));
    const finding = findingOf(verdict, "fast", "speed.joint");
    const [value, limit] = [finding.value, finding.limit].map(speed => `${degrees(speed).toFixed(1)}°/s`);
    expect(finding.sentence).toBe(`Joint ${finding.joint} would turn at ${value}; its limit is ${limit}.`);
    expect(finding.value).toBeGreaterThan(finding.limit);
    expect(finding.limit).toBe(robot.arm.joints[finding.joint! - 1]!.limits.speed_rad_s);
    expect(check(applyRepair(programOf(ready, fast), "fast", finding.repairs[0]!)).ok).toBe(true);
  });

  test("a duration that is too short is bad, and the offered one is kept", () => {
    const quick = move("quick", "ptp", { q: [1, -1, 2, 0, 0.6, 0] }, { time_s: 0.05 });
    const verdict = check(programOf(ready, quick));
    const finding = findingOf(verdict, "quick", "speed.joint");
    expect(finding.joint).toBe(1);
    expect(check(applyRepair(programOf(ready, quick), "quick", finding.repairs[0]!)).ok).toBe(true);
  });

  test("out of reach: how far, how long the arm is, a target within reach; later steps are judged too", () => {
    const program = programOf(ready, move("far", "ptp", at([1.4, 0, 0.3])), move("after", "ptp", at([0.55, 0, 0.35])));
    const verdict = check(program);
    const finding = findingOf(verdict, "far", "reach.too-far");
    expect(finding.sentence).toMatch(/^The wrist would be 1[0-9]{3} mm from the shoulder; the arm is 1100 mm long\.$/);
    expect(finding.limit).toBeCloseTo(1.1, 9);
    expect(finding.repairs.length).toBeGreaterThan(0);
    expect(reportOf(check(applyRepair(program, "far", finding.repairs.at(-1)!)), "far").verdict).not.toBe("bad");
    expect(reportOf(verdict, "after").verdict).toBe("ok");
  });

  test("every repair of a target that cannot be reached can be reached", () => {
    const target = at([0.75, 0, 0.3], multiply(fromAxisAngle([0, 1, 0], radians(90)), DOWN));
    const program = programOf(ready, move("m", "ptp", target));
    const verdict = check(program);
    const findings = reportOf(verdict, "m").findings.filter(
      finding => finding.code === "limits.joint" || finding.code.startsWith("reach."),
    );
    expect(findings.length).toBeGreaterThan(0);
    for (const repair of findings.flatMap(finding => finding.repairs))
      expect(
        reportOf(check(applyRepair(program, "m", repair)), "m").findings.map(finding => finding.code),
      ).not.toContain("reach.too-far");
  });

  test("a straight move that cannot end in the taught posture says which joint", () => {
    const taught = [0, -1, 2, 0.8, 0.6, 0.3];
    const other = [0, -1, 2, 0.8 - Math.PI, -0.6, 0.3 - Math.PI];
    const program = programOf(move("a", "ptp", { q: taught }), move("b", "lin", { q: other }, { mps: 0.1 }));
    const finding = findingOf(check(program), "b", "branch.other");
    expect([4, 6]).toContain(finding.joint);
    expect(check(applyRepair(program, "b", finding.repairs[0]!)).ok).toBe(true);
  });

  test("a joint move to a pose that turns the arm over is warned of", () => {
    const program = programOf(
      move("a", "ptp", { q: [0, -1, 2, 0.2, 0.6, 0] }),
      move("b", "ptp", { ...at([0.5, 0.1, 0.4]), branch: { shoulder: "front", elbow: "up", wrist: "negative" } }),
    );
    expect(findingOf(check(program), "b", "branch.turn-over").joint).toBeGreaterThan(3);
  });

  test("a straight path through a straight wrist is warned of", () => {
    const forward: Quaternion = fromAxisAngle([0, 1, 0], Math.PI / 2);
    const pose = (y: number, z: number): MoveStep["target"] => ({
      pose: { position: [0.8, y, z], quaternion: forward },
      frame: "world",
      tool: "flange",
    });
    const verdict = check(
      programOf(move("a", "ptp", pose(0.02, 1)), move("b", "lin", pose(0.02, 0.75), { mps: 0.05 })),
    );
    const codes = reportOf(verdict, "b").findings.map(finding => finding.code);
    expect(codes.some(code => code === "singular.wrist" || code === "branch.jump" || code === "speed.joint")).toBe(
      true,
    );
  });

  test("cancelled: what was not reached is unknown and the program is not ok", () => {
    let asked = 0;
    const verdict = check(programOf(ready, fifth(20), move("c", "ptp", { q: READY })), {
      cancelled: () => ++asked > 2,
    });
    expect(verdict.ok).toBe(false);
    expect(verdict.steps.map(step => step.verdict)).toEqual(["ok", "ok", "unknown"]);
  });
});

describe("collision in a program", () => {
  /** A post in the way between two points, standing on a table. */
  const cell = (allowedPairs: CellGeometry["allowedPairs"] = []): CellGeometry => ({
    worldFromBase: identity(),
    links: linkSolids(robot),
    allowedPairs,
    shapeError_m: robot.shapeError_m,
    tool: { name: "torch", mesh: boxMesh([0.02, 0.02, 0.28]) },
    objects: [
      {
        id: "post",
        name: "Post",
        worldFromObject: { position: [0.55, 0, 0.25], quaternion: [0, 0, 0, 1] },
        mesh: boxMesh([0.04, 0.04, 0.5]),
      },
      {
        id: "plate",
        name: "Plate",
        worldFromObject: { position: [0.55, 0, 0.2], quaternion: [0, 0, 0, 1] },
        mesh: boxMesh([0.3, 0.6, 0.02]),
      },
    ],
  });
  const left = move("left", "ptp", at([0.55, 0.2, 0.4]));
  const across = move("across", "lin", at([0.55, -0.2, 0.4]), { mps: 0.2 });
  const right = move("right", "ptp", at([0.55, -0.2, 0.6]));

  test("a path through an object is bad, with both names and the time; the rest is ok", () => {
    const verdict = check(programOf(left, across, right), { cell: cell() });
    const finding = findingOf(verdict, "across", "collision.contact");
    expect(finding.sentence).toMatch(/^(The tool|Link [0-9]) touches “Post” at [0-9.]+ s\.$/);
    expect(reportOf(verdict, "left").verdict).toBe("ok");
    expect(reportOf(verdict, "right").verdict).toBe("ok");
    expect(verdict.clearance_m).toBe(0);
    expect(verdict.ok).toBe(false);
  });

  test("M-49 one report: reach and orientation of a target, clearance and collision, each with its number", () => {
    const back: Quaternion = fromAxisAngle([0, 1, 0], -Math.PI / 2);
    const far = move("far", "ptp", at([1.6, 0, 0.4]));
    const turned = move("turned", "ptp", at([0.68, 0, 0.3], back));
    const targets = check(programOf(left, far, turned), { cell: cell() });
    expect(findingOf(targets, "far", "reach.too-far")).toMatchObject({ unit: "m" });
    const orientation = findingOf(targets, "turned", "limits.joint");
    expect(orientation).toMatchObject({ joint: 5, unit: "rad" });
    expect(orientation.repairs.map(({ sentence }) => sentence).join()).toMatch(/^Tilt the tool by /);
    const high = move("high", "ptp", at([0.55, 0.2, 0.5]));
    const free = check(programOf(high), { cell: cell() });
    expect(free.ok).toBe(true);
    expect(free.clearance_m).toBeGreaterThan(0.05);
    expect(free.clearance_m).toBeLessThan(0.3);
    const blocked = check(programOf(left, across), { cell: cell() });
    // The first contact is found to within 0.2 mm of distance.
    expect(findingOf(blocked, "across", "collision.contact").value).toBeLessThan(0.0005);
    expect(blocked.clearance_m).toBe(0);
  });

  test("pairs that may touch are not reported", () => {
    const contacts = (pairs: CellGeometry["allowedPairs"]): number =>
      reportOf(check(programOf(left, across), { cell: cell(pairs) }), "across").findings.length;
    expect(contacts([])).toBe(1);
    const both: [string, string][] = [
      ["tool", "post"],
      ...Array.from({ length: 7 }, (_, i): [string, string] => [`link ${i}`, "post"]),
    ];
    expect(contacts(both)).toBe(0);
  });

  test("a thin sheet cannot be stepped over", () => {
    const sheet: CellGeometry = {
      ...cell(),
      objects: [
        {
          id: "sheet",
          name: "Sheet",
          worldFromObject: { position: [0.55, 0, 0.5], quaternion: [0, 0, 0, 1] },
          mesh: boxMesh([0.3, 0.0002, 0.4]),
        },
      ],
    };
    expect(findingOf(check(programOf(left, across), { cell: sheet }), "across", "collision.contact").sentence).toMatch(
      /“Sheet”/,
    );
  });

  test("a repair of a target in an object leads out of it", () => {
    const low = move("low", "ptp", at([0.55, 0.2, 0.19]));
    const program = programOf(left, low);
    const verdict = check(program, { cell: cell() });
    const finding = findingOf(verdict, "low", "collision.contact");
    expect(finding.repairs[0]?.sentence).toMatch(/^Raise the target by [0-9.]+ mm\.$/);
    expect(check(applyRepair(program, "low", finding.repairs[0]!), { cell: cell() }).ok).toBe(true);
  });

  test("a margin is kept as a distance, and the clearance is measured", () => {
    const above = move("above", "lin", at([0.55, -0.2, 0.72]), { mps: 0.2 });
    const program = programOf(move("up", "ptp", at([0.55, 0.2, 0.72])), above);
    const free = check(program, { cell: cell() });
    expect(free.ok).toBe(true);
    // The torch reaches 0.14 m below the flange; the post is 0.5 m high.
    expect(free.clearance_m).toBeCloseTo(0.72 + 0.15 - 0.14 - 0.5, 2);
    const kept = findingOf(check(program, { cell: cell(), margin_m: 0.24 }), "above", "collision.contact");
    expect(kept.sentence).toMatch(/comes within [0-9]+ mm of “Post” at .* s; the margin is [0-9]+ mm\.$/);
  });

  const ur10e = robotById("ur10e")!;
  const q = [0, -1.2, 1.6, -2, -1.57, 0];
  /** The verdict on a UR10e that turns its last joint beside a wall across x, whose near side is at x. */
  const besideWall = (x_m: number, more: Partial<CellGeometry> = {}) => {
    const turn: Program = {
      ...emptyProgram(ur10e.id),
      steps: [
        { id: "turn", type: "move", path: "ptp", target: { q: q.with(5, 0.3) }, speed: { ratio: 0.5 }, blend_m: 0 },
      ],
    };
    const wall = { id: "wall", name: "Wall", mesh: boxMesh([0.1, 6, 6]) };
    const cell: CellGeometry = {
      worldFromBase: identity(),
      links: linkSolids(ur10e),
      allowedPairs: [],
      shapeError_m: ur10e.shapeError_m,
      objects: [{ ...wall, worldFromObject: pose<"world", "object">([x_m + 0.05, 0, 0]) }],
      ...more,
    };
    return checkProgram(turn, ur10e, { cell, start_rad: q }).verdict;
  };

  test("T-64 a link nearer to a wall than the error of its drawn shape is not ok, and both numbers are said", () => {
    // The wall is flat and stands across x: what is clear of it is a distance along x.
    const touching_m = 1.1 - besideWall(1.1).clearance_m!;
    expect(ur10e.shapeError_m).toBeGreaterThan(0.02);
    const finding = findingOf(besideWall(touching_m + 0.002), "turn", "collision.contact");
    expect(finding.limit).toBeCloseTo(ur10e.shapeError_m, 12);
    expect(besideWall(touching_m + 0.002).ok).toBe(false);
    // Where the motion first comes nearer than that; the nearest is 2 mm.
    expect(finding.value).toBeGreaterThan(0.0019);
    expect(finding.value).toBeLessThan(ur10e.shapeError_m);
    expect(finding.sentence).toMatch(/comes within [0-9.]+ mm of “Wall” at .* s; the margin is 21 mm, /);
    expect(finding.sentence).toMatch(/; the margin is 21 mm, 21 mm of it for the error of the drawn shape\.$/);
    expect(besideWall(touching_m + ur10e.shapeError_m + 0.002).ok).toBe(true);
  });

  test("T-64 registration and twin error count for arm and tool, and are said apart from the shape's", () => {
    const touching_m = 1.1 - besideWall(1.1).clearance_m!;
    // 2 mm beyond the error of the shape is enough where nothing else is unknown, and 5 mm of registration are not.
    const x_m = touching_m + ur10e.shapeError_m + 0.002;
    expect(besideWall(x_m).ok).toBe(true);
    const finding = findingOf(besideWall(x_m, { placeError_m: 0.005 }), "turn", "collision.contact");
    expect(finding.limit).toBeCloseTo(ur10e.shapeError_m + 0.005, 12);
    expect(finding.sentence).toMatch(
      /the margin is 26 mm, 21 mm of it for the error of the drawn shape, 5(\.0)? mm for where the robot may stand\.$/,
    );
    expect(besideWall(x_m + 0.005, { placeError_m: 0.005 }).ok).toBe(true);
    // A tool has no shape error, and the same error of place.
    const tool = { name: "Bar", mesh: boxMesh([0.02, 0.02, 0.3]) };
    // The tool points down and reaches no further than the arm: a table comes up to it instead of the wall.
    const table = (z_m: number, place_m: number) =>
      besideWall(5, {
        tool,
        placeError_m: place_m,
        objects: [{ id: "table", name: "Table", mesh: boxMesh([0.3, 0.3, 0.1]), worldFromObject: tableAt(z_m) }],
      });
    const [flangeX, flangeY, flangeZ] = flangePose(ur10e.arm, q).position;
    const tableAt = (z_m: number) => pose<"world", "object">([flangeX, flangeY, z_m - 0.05]);
    const tip_m = flangeZ - 0.15;
    expect(table(tip_m - 0.003, 0).ok).toBe(true);
    expect(findingOf(table(tip_m - 0.003, 0.005), "turn", "collision.contact").limit).toBeCloseTo(0.005, 12);
    expect(table(tip_m - 0.007, 0.005).ok).toBe(true);
  });

  test("the cell's place of the robot counts", () => {
    const shifted: CellGeometry = { ...cell(), worldFromBase: { position: [0, 0, 0.1], quaternion: [0, 0, 0, 1] } };
    const { plan } = checkProgram(programOf(left), robot, { cell: shifted });
    const last = plan.segments.at(-1)!;
    const q = last.kind === "motion" ? last.q_rad.slice(-6) : last.q_rad;
    const there = checkProgram(programOf(move("left", "ptp", at([0.55, 0.2, 0.3]))), robot).plan.segments.at(-1)!;
    expect(Array.from(q)).toEqual(
      Array.from(there.kind === "motion" ? there.q_rad.slice(-6) : there.q_rad, x => expect.closeTo(x, 9) as number),
    );
    expect(compose(shifted.worldFromBase, identity()).position[2]).toBe(0.1);
  });
});
