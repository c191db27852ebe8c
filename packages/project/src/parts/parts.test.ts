import { cellGeometry } from "../mesh/index.ts";
import { CellCollider, isClosed, linkSolids, meshBounds, meshVolume, pose, robotById } from "@twincell/core";
import { expect, test } from "vitest";
import { emptyCell } from "../example/index.ts";
import { openDocument } from "../open.ts";
import { physicalScene } from "../physical.ts";
import { saveDocument } from "../save.ts";
import { changedPart, partById, partNumbers, partObject, partPieces, PARTS, partSolid } from "./index.ts";

const numbersOf = (id: string, pick: "value" | "min" | "max") =>
  Object.fromEntries(partById(id)!.parameters.map(each => [each.id, each[pick]]));
const partOf = (id: string, pick: "value" | "min" | "max" = "value") =>
  ({ kind: "part", part: id, parameters: numbersOf(id, pick) }) as const;

test.each(PARTS.flatMap(({ id }) => (["value", "min", "max"] as const).map(pick => [id, pick] as const)))(
  "%s with its numbers at %s stands on the floor, closed and wound outward, as large as its numbers say",
  (id, pick) => {
    const shape = partOf(id, pick);
    const mesh = partSolid(shape);
    const numbers = numbersOf(id, pick);
    const { lower, upper } = meshBounds(mesh);
    expect(isClosed(mesh)).toBe(true);
    expect(meshVolume(mesh)).toBeGreaterThan(0);
    expect(lower[2]).toBeCloseTo(0, 6);
    if (numbers.height !== undefined) expect(upper[2]).toBeCloseTo(numbers.height, 1);
    if (numbers.length !== undefined) expect(upper[0] - lower[0]).toBeGreaterThanOrEqual(numbers.length - 1e-9);
    if (numbers.length !== undefined) expect(upper[0] - lower[0]).toBeLessThan(numbers.length + 0.16);
    expect(mesh.indices.length / 3).toBeLessThan(16_000);
    for (const piece of partPieces(shape))
      if (piece.kind === "box") expect(Math.min(...piece.size_m), `${id} ${piece.material}`).toBeGreaterThan(0);
  },
);

test("a part in a cell has mass, friction and, as a conveyor, a belt; it is saved, opened, checked against and simulated", () => {
  const conveyor = partObject(partById("roller-conveyor")!, { id: "c", name: "Infeed" }, pose([1.5, 0, 0]), {
    length: 2,
  });
  const cell = { ...emptyCell("ur10e"), objects: [conveyor] };
  expect(conveyor.mass_kg).toBeGreaterThan(20);
  expect(conveyor.friction).toBe(0.5);
  expect(conveyor.belt).toEqual({ direction: [1, 0, 0], speed_mps: 0.25 });
  const opened = openDocument(saveDocument(cell));
  expect(opened).toMatchObject({ kind: "opened" });
  expect(opened.kind === "opened" && saveDocument(opened.document)).toBe(saveDocument(cell));
  const robot = robotById("ur10e")!;
  const collider = new CellCollider(cellGeometry(cell, linkSolids(robot)), robot.arm);
  // Stretched out over its height towards it, and away from it.
  const hits = [0, Math.PI].filter(q1 => collider.collides(Float64Array.from([q1, -0.45, 0.1, 0, 0, 0])));
  expect(hits).toHaveLength(1);
  expect(physicalScene(cell, robot).objects[0]).toMatchObject({ friction: 0.5, belt: { speed_mps: 0.25 } });
});

test("other numbers change size, mass and belt; a mass that was typed and the signal of the belt stay", () => {
  const before = partObject(partById("roller-conveyor")!, { id: "c", name: "Infeed" }, pose());
  const longer = changedPart(before, { length: 3.2, speed: 0.5 });
  expect(longer.mass_kg).toBeGreaterThan(before.mass_kg!);
  expect(longer.belt!.speed_mps).toBe(0.5);
  const own = { ...before, mass_kg: 77, belt: { ...before.belt!, runs: { signal: "free", is: false } } };
  const after = changedPart(own, { length: 3.2 });
  expect(after.mass_kg).toBe(77);
  expect(after.belt).toMatchObject({ runs: { signal: "free", is: false }, speed_mps: 0.25 });
  expect(partNumbers(partById("pallet")!, { length: 99 }).length).toBe(1.6);
});

test("a part that the library does not have, or a number beyond its range, is refused with its place", () => {
  const pallet = partObject(partById("pallet")!, { id: "p", name: "Pallet" }, pose());
  const bad = (shape: object): unknown =>
    openDocument(saveDocument({ ...emptyCell(), objects: [{ ...pallet, shape } as never] }));
  expect(bad({ kind: "part", part: "spaceship", parameters: {} })).toMatchObject({
    kind: "not-a-cell",
    why: [expect.stringMatching(/objects\[0\]\.shape\.part.*spaceship/)],
  });
  expect(bad({ kind: "part", part: "pallet", parameters: { length: 50 } })).toMatchObject({
    kind: "not-a-cell",
    why: [expect.stringMatching(/50 is not between 0.4 and 1.6/)],
  });
});
