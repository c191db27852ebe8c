/**
 * Row M-54 carried out with contact: boxes come on a belt, a photo-cell stops it, a gripper fetches them, a table takes
 * them.
 */
import { cellGeometry, conveyorPalletCell, physicalScene, type CellDocument } from "@twincell/project";
import {
  checkProgram,
  compose,
  distance,
  linkSolids,
  palletSlots,
  robotById,
  type Program,
  type Vector3,
} from "@twincell/core";
import { createWorld, loadEngine, PhysicsRun, type PhysicsEvent } from "@twincell/physics";
import { expect, test } from "vitest";

const engine = await loadEngine();
const robot = robotById("ur10e")!;
/** A box stands where it is let go; the fingers centre it along one axis only. */
const WITHIN_M = 0.003;

/** Runs the program to its end; how far every box is from its place, in the order of the places. */
function fill(
  cell: CellDocument,
  program: Program,
): { readonly off_m: readonly number[]; readonly events: readonly PhysicsEvent[] } {
  const answer = createWorld(engine, physicalScene(cell, robot, { program }));
  if (answer.kind === "refused") throw new Error(answer.why.sentence);
  const { world } = answer;
  const events: PhysicsEvent[] = [];
  const run = new PhysicsRun(world, program, { onEvent: event => events.push(event) });
  const state = run.runFor(120);
  expect([state.kind, state.why?.sentence]).toEqual(["done", undefined]);
  const pallet = program.pallets.places!;
  const frame = program.frames.table!;
  const off_m = palletSlots(pallet).map((place, i) =>
    distance(compose(frame, place).position, [
      world.state.parts[7 * i]!,
      world.state.parts[7 * i + 1]!,
      world.state.parts[7 * i + 2]! - 0.03,
    ] as Vector3),
  );
  world.close();
  return { off_m, events };
}

const cell = conveyorPalletCell();
const program = cell.programs[0]!;

test("M-54 the program is free of contact, in reach and in limits (M-49)", () => {
  const { verdict } = checkProgram(program, robot, { cell: cellGeometry(cell, linkSolids(robot)), margin_m: 0 });
  expect(verdict.steps.filter(step => step.verdict === "bad")).toEqual([]);
});

test("M-54 nine of nine from the conveyor stand on their places, within 3 mm", () => {
  const { off_m, events } = fill(cell, program);
  expect(off_m.length).toBe(9);
  expect(Math.max(...off_m)).toBeLessThan(WITHIN_M);
  expect(events.filter(event => event.kind === "sensor" && event.tripped).length).toBe(9);
  expect(events.filter(event => event.kind === "dropped")).toEqual([]);
});

test("M-54 a skew pattern of two layers, every second row shifted: six of six, the upper ones on the lower ones", () => {
  const places = {
    ...program.pallets.places!,
    rowEnd: [0.14, 0.02, 0] as Vector3,
    columnEnd: [0.03, 0.16, 0] as Vector3,
    rows: 2,
    columns: 2,
    layers: 2,
    interleave: "odd-rows-shifted" as const,
    order: "columns-zigzag" as const,
  };
  const { off_m } = fill(
    { ...cell, objects: cell.objects.filter(({ id }) => !/box-[789]/.test(id)) },
    { ...program, pallets: { places } },
  );
  expect(off_m.length).toBe(6);
  expect(Math.max(...off_m)).toBeLessThan(WITHIN_M);
});
