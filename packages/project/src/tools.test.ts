import {
  checkProgram,
  compose,
  flangePose,
  linkSolids,
  pose,
  robotById,
  samplePlan,
  type MoveStep,
  type Vector3,
} from "@twincell/core";
import { expect, test } from "vitest";
import { conveyorPalletCell, emptyCell, pickAndPlaceCell } from "./example/index.ts";
import type { CellDocument, ToolRecord } from "./document.ts";
import { cellGeometry } from "./mesh/index.ts";
import { fitsQuery, modelQuery, modelsOf } from "./models.ts";
import { openDocument } from "./open.ts";
import { partById } from "./parts/index.ts";
import { knuckleAngle, tipHeight } from "./parts/tools.ts";
import { toolMass } from "./parts/tool-mass.ts";
import { physicalScene } from "./physical.ts";
import { selectedProgram } from "./programs.ts";
import { saveDocument } from "./save.ts";
import { changedTool, pointsTaughtWith, swappedTool, toolOfObject, toolOfPart, withNewTool } from "./tools.ts";

const tool = (id: string, name: string, numbers = {}): ToolRecord => toolOfPart(partById(id)!, name, numbers)!;

test("X-05 the two fingers are those of the 2F-85: 85 mm at 0 rad, 45.3 at 0.4, closed at 0.8; the TCP goes from 149 to 163 mm", () => {
  for (const [gap_m, q] of [
    [0.085, 0],
    [0.0453, 0.4],
    [0.00016, 0.8],
  ] as const)
    expect(knuckleAngle(gap_m)).toBeCloseTo(q, 2);
  expect(tipHeight(0.085)).toBeCloseTo(0.149, 3);
  expect(tipHeight(0.00016)).toBeCloseTo(0.1625, 3);
  const open = tool("two-fingers", "gripper");
  const closed = changedTool(open, { width: 0 });
  expect(closed.flangeFromTcp.position[2] - open.flangeFromTcp.position[2]).toBeCloseTo(0.0136, 3);
  // A TCP that a person measured stays.
  const own = { ...open, flangeFromTcp: { ...open.flangeFromTcp, position: [0, 0, 0.2] as Vector3 } };
  expect(changedTool(own, { width: 0.02 }).flangeFromTcp.position[2]).toBe(0.2);
  expect(open.gripper).toMatchObject({ open_m: 0.085, speed_mps: 0.15, mass_kg: 0.921 });
});

const ur = robotById("ur10e")!;
const at = (id: string, x: number, z: number): MoveStep => ({
  id,
  type: "move",
  path: "lin",
  speed: { mps: 0.2 },
  blend_m: 0,
  target: { pose: { position: [x, 0.2, z], quaternion: [1, 0, 0, 0] }, frame: "world", tool: "pointer" },
});
const judged = (cell: CellDocument) => {
  const [program] = cell.programs;
  if (program === undefined || !("steps" in program)) throw new Error("no steps");
  const tools = Object.fromEntries(cell.tools.map(each => [each.name, each.flangeFromTcp]));
  return checkProgram({ ...program, tools }, ur, { cell: cellGeometry(cell, linkSolids(ur)) });
};

test("M-63, T-59 another tool takes over what was taught: the tip goes where it went, the flange elsewhere, and its body touches what the old one passed", () => {
  const base = emptyCell("ur10e");
  const [program] = base.programs;
  const taught = withNewTool(
    { ...base, programs: [{ ...program!, steps: [at("a", 0.6, 0.3), at("b", 0.75, 0.3)] }] },
    tool("pointer", "pointer"),
  );
  const post = partById("carton")!;
  const cell: CellDocument = {
    ...taught,
    objects: [
      {
        id: "post",
        name: "Post",
        role: "fixture",
        worldFromObject: { position: [0.68, 0.33, 0.25], quaternion: [0, 0, 0, 1] },
        shape: { kind: "box", size_m: [0.05, 0.05, 0.5] },
        color: post.color,
      },
    ],
  };
  const before = judged(cell);
  expect(before.verdict.ok).toBe(true);
  const cups = withNewTool(cell, tool("vacuum-cups", "cups", { length: 0.6, width: 0.4 }));
  expect(pointsTaughtWith(cups, "pointer")).toBe(2);
  const swapped = swappedTool(cups, "pointer", "cups");
  expect([pointsTaughtWith(swapped, "pointer"), pointsTaughtWith(swapped, "cups"), swapped.tool]).toEqual([
    0,
    2,
    "cups",
  ]);
  const after = judged(swapped);
  expect(after.verdict.ok).toBe(false);
  expect(JSON.stringify(after.verdict.steps)).toContain("collision");
  // The tip ends at the same place, to a nanometre, by other joint angles.
  const end = (cellNow: CellDocument, { plan }: typeof before) => {
    const q = new Float64Array(6);
    samplePlan(plan, plan.duration_s, q);
    const { flangeFromTcp } = cellNow.tools.find(({ name }) => name === cellNow.tool)!;
    return { tip: compose(flangePose(ur.arm, q), flangeFromTcp).position, q: Array.from(q) };
  };
  const [old, now] = [end(cell, before), end(swapped, after)];
  for (let k = 0; k < 3; k++) expect(now.tip[k]).toBeCloseTo(old.tip[k]!, 6);
  expect(now.q.some((value, j) => Math.abs(value - old.q[j]!) > 1e-3)).toBe(true);
  // Taught as joint angles, the point is found by other angles; a home position of no tool stays as it is.
  const q = [0.3, -1.4, 1.6, -1.7, -1.5, 0];
  const joints = ["pointer", undefined].map(
    (tool, i): MoveStep => ({ ...at(`q${i}`, 0, 0), target: tool === undefined ? { q } : { q, tool } }),
  );
  const byAngles = swappedTool({ ...cups, programs: [{ ...program!, steps: joints }] }, "pointer", "cups");
  const targets = byAngles.programs.flatMap(each =>
    "steps" in each
      ? each.steps.flatMap(step => (step.type === "move" && "q" in step.target ? [step.target] : []))
      : [],
  );
  expect(targets.map(target => target.tool)).toEqual(["cups", undefined]);
  expect(targets[1]!.q).toEqual(q);
  const tips = [
    [q, "pointer"],
    [targets[0]!.q, "cups"],
  ].map(
    ([angles, name]) =>
      compose(flangePose(ur.arm, angles as number[]), cups.tools.find(each => each.name === name)!.flangeFromTcp)
        .position,
  );
  for (let k = 0; k < 3; k++) expect(tips[0]![k]).toBeCloseTo(tips[1]![k]!, 9);
  const tools = Object.fromEntries(swapped.tools.map(each => [each.name, each.flangeFromTcp]));
  const whole = { ...swapped, programs: swapped.programs.map(each => ("steps" in each ? { ...each, tools } : each)) };
  const opened = openDocument(saveDocument(whole));
  expect(opened.kind).toBe("opened");
});

test("T-59 an object of the cell becomes a tool with its shape, its TCP at its end", () => {
  const made = toolOfObject(conveyorPalletCell().objects.at(-1)!, "own", 0.06);
  expect(made).toMatchObject({ name: "own", flangeFromTcp: { position: [0, 0, 0.06] }, shape: { kind: "box" } });
});

test("M-17 hand, work pieces, conveyor and storage table stand in the conveyor cell; only work pieces can be grasped", () => {
  const cell = conveyorPalletCell();
  const scene = physicalScene(cell, ur);
  expect(cell.tools.find(({ name }) => name === cell.tool)?.gripper).toBeDefined();
  expect(cell.objects.filter(({ role }) => role === "workpiece").length).toBeGreaterThan(1);
  expect(cell.objects.find(({ id }) => id === "conveyor")?.belt?.speed_mps).toBeGreaterThan(0);
  expect(cell.objects.find(({ id }) => id === "table")?.role).toBe("furniture");
  expect(scene.objects.length).toBe(cell.objects.length);
  const graspable = cellGeometry(cell, [])
    .objects.filter(object => object.graspable)
    .map(({ id }) => id);
  expect(graspable).toEqual(cell.objects.filter(({ role }) => role === "workpiece").map(({ id }) => id));
});

test("M-18 models are asked for by name, geometry, physical properties and behaviour", () => {
  const models = modelsOf(conveyorPalletCell());
  const found = (text: string): string[] => {
    const query = modelQuery(text);
    if (query === undefined) throw new Error(`no query: ${text}`);
    return models.filter(model => fitsQuery(model, query)).map(({ name }) => name);
  };
  expect(found("speed > 0")).toEqual(["Conveyor"]);
  expect(found("table length = 500")).toEqual(["Table"]);
  expect(found("friction > 0.7 kg")).toContain("Conveyor");
  expect(found("workpiece height < 100 mm").every(name => name.startsWith("Box"))).toBe(true);
  expect(found("mass > 1000")).toEqual([]);
  expect(modelQuery("Conveyor and pallet")).toBeUndefined();
  expect(modelQuery("weight > 3")).toBeUndefined();
});

test("X-07 the tool counts: alone on the first motion, with what it carries where it takes it; a typed mass goes before that of the library", () => {
  const cell = pickAndPlaceCell();
  const robot = robotById(cell.robot.id)!;
  const program = selectedProgram(cell)!;
  const limit = robot.payloadMax_kg ?? robot.payload_kg!;
  const findings = (toolMass_kg: number, part_kg: number) => {
    const document = {
      ...cell,
      tools: cell.tools.map(each => ({ ...each, mass_kg: toolMass_kg })),
      objects: cell.objects.map(object => (object.role === "workpiece" ? { ...object, mass_kg: part_kg } : object)),
    };
    const { verdict } = checkProgram(program, robot, { cell: cellGeometry(document, linkSolids(robot)) });
    return verdict.steps.flatMap(({ id, findings: found }) =>
      found.flatMap(({ code, value }) => (code.startsWith("payload.") ? [{ id, code, value }] : [])),
    );
  };
  const half = limit / 2;
  expect(findings(half, half - 0.1)).toEqual([]);
  const grasp = program.steps.find(step => step.type === "gripper" && step.closed)!;
  expect(findings(half, half + 0.1)).toEqual([{ id: grasp.id, code: "payload.too-heavy", value: limit + 0.1 }]);
  const first = program.steps.find(step => step.type === "move")!;
  expect(findings(limit + 1, 0.1)[0]).toEqual({ id: first.id, code: "payload.too-heavy", value: limit + 1 });
  const fingers = tool("two-fingers", "fingers");
  expect(toolMass(fingers)).toBe(0.921);
  expect(toolMass({ ...fingers, mass_kg: 1.2 })).toBe(1.2);
  expect(toolMass({ name: "bare", flangeFromTcp: pose() })).toBeUndefined();
});
