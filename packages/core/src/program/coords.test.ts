import { describe, expect, test } from "vitest";
import { addCoords, editCoords, emptyProgram, parseProgram, pose, removeCoords, serializeProgram, stepsFromCoords, type SavedPose } from "../index.ts";

const at = (x: number): SavedPose["worldFromTcp"] => pose([x, 0, 0.5], [0, 1, 0, 0]);
const names = (list: readonly SavedPose[]): string[] => list.map(({ name }) => name);
const two = addCoords(addCoords([], at(0.8), "above"), at(0.9));

describe("saved poses", () => {
  test("L-44 AddCoords adds a frame where the tool tip is, under a name of its own, and keeps no hold of the pose it was given", () => {
    const tip = at(0.7), list = addCoords(two, tip, "above");
    expect(names(list)).toEqual(["above", "P1", "above 2"]);
    expect(list[2]!.worldFromTcp).toEqual(tip);
    tip.position[0] = 5;
    expect(list[2]!.worldFromTcp.position[0]).toBe(0.7);
    expect(names(two)).toEqual(["above", "P1"]);
    expect(names(addCoords(addCoords(two, tip), tip))).toEqual(["above", "P1", "P2", "P3"]);
  });

  test("L-45 EditCoords moves and renames one pose, also to where no robot reaches", () => {
    const far = at(1000), list = editCoords(two, "P1", { worldFromTcp: far, name: "far" });
    expect(names(list)).toEqual(["above", "far"]);
    expect(list[1]!.worldFromTcp).toEqual(far);
    expect(list[0]).toEqual(two[0]);
    expect(names(editCoords(two, "P1", { name: "above" }))).toEqual(["above", "above 2"]);
    expect(editCoords(two, "P1", { name: "P1" })).toEqual(two);
    expect(editCoords(two, "gone", { name: "x" })).toBe(two);
  });

  test("L-48 RemoveCoords erases all poses, and some; the list before is untouched, which is its undo", () => {
    expect(removeCoords(two)).toEqual([]);
    expect(names(two)).toEqual(["above", "P1"]);
    expect(names(removeCoords(two, ["above"]))).toEqual(["P1"]);
    expect(removeCoords(two, ["gone"])).toBe(two);
  });

  test("L-49 saved poses become a trajectory: one move each, in their order, with fresh ids", () => {
    const program = { ...emptyProgram("staubli_rx90l"), tools: { torch: pose<"flange", "tcp">([0, 0, 0.1]) }, steps: [{ id: "s4", type: "wait", s: 1 } as const] };
    const steps = stepsFromCoords(program, addCoords(two, at(1)), { path: "lin", speed: { mps: 0.2 }, tool: "torch", blend_m: 0.01 });
    expect(steps.map(({ id, name, path, blend_m }) => [id, name, path, blend_m])).toEqual([["s5", "above", "ptp", 0.01], ["s6", "P1", "lin", 0.01], ["s7", "P2", "lin", 0]]);
    expect(steps[1]!.target).toEqual({ pose: at(0.9), frame: "world", tool: "torch" });
    const whole = { ...program, steps: [...program.steps, ...steps] };
    expect(parseProgram(serializeProgram(whole))).toMatchObject({ kind: "program", program: whole });
    expect(stepsFromCoords(program, [], { path: "lin", speed: { mps: 0.2 }, tool: "torch" })).toEqual([]);
  });
});
