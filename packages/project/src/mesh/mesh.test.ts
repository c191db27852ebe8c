import { boxMesh, isClosed, meshBounds, meshVolume } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { cellGeometry, decodeMesh, edgeTraceCell, emptyCell, encodeMesh, shapeMesh } from "../index.ts";

describe("mesh codec", () => {
  test("a mesh keeps its triangles and its points to single precision", () => {
    const box = boxMesh([0.3, 0.4, 0.2]);
    const decoded = decodeMesh(encodeMesh(box));
    expect(decoded.kind).toBe("mesh");
    if (decoded.kind !== "mesh") return;
    expect(decoded.mesh.indices).toEqual(box.indices);
    for (const [i, x] of decoded.mesh.positions.entries()) expect(x).toBe(Math.fround(box.positions[i]!));
  });

  test("one triangle written out by hand", () => {
    const bytes = [
      0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0x80, 0x3f, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0x40, 0, 0, 0,
      0,
    ];
    const decoded = decodeMesh({
      positions: Buffer.from(bytes).toString("base64"),
      indices: Buffer.from([0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]).toString("base64"),
    });
    expect(decoded).toEqual({
      kind: "mesh",
      mesh: { positions: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 2, 0), indices: Uint32Array.of(0, 1, 2) },
    });
  });

  test("a triangle without its vertex and a coordinate that is no number are said", () => {
    const positions = Buffer.from(new Float32Array([0, 0, 0]).buffer).toString("base64");
    expect(
      decodeMesh({ positions, indices: Buffer.from(new Uint32Array([0, 0, 1]).buffer).toString("base64") }),
    ).toEqual({ kind: "not-a-mesh", sentence: "Triangle 1 of the mesh names vertex 2 of 1." });
    expect(
      decodeMesh({ positions: Buffer.from(new Float32Array([0, NaN, 0]).buffer).toString("base64"), indices: "" }).kind,
    ).toBe("not-a-mesh");
  });
});

describe("solids of a cell", () => {
  test("every shape stands where the document says", () => {
    expect(meshBounds(shapeMesh({ kind: "box", size_m: [2, 4, 6] }))).toEqual({
      lower: [-1, -2, -3],
      upper: [1, 2, 3],
    });
    const cylinder = meshBounds(shapeMesh({ kind: "cylinder", radius_m: 0.5, height_m: 2 }));
    expect([cylinder.lower[2], cylinder.upper[2], cylinder.upper[0]]).toEqual([0, 2, 0.5]);
    const cone = shapeMesh({
      kind: "revolved",
      profile_m: [
        [1, 0],
        [0, 3],
      ],
    });
    expect(meshVolume(cone)).toBeGreaterThan(0.99 * Math.PI);
    expect(meshVolume(cone)).toBeLessThan(Math.PI);
  });

  test("the example's solids are closed and its nozzle ends 12 mm before the TCP, so that the wire may touch", () => {
    const cell = edgeTraceCell();
    const geometry = cellGeometry(cell, []);
    for (const object of geometry.objects) expect(isClosed(object.mesh), object.name).toBe(true);
    expect(geometry.tool).toBeDefined();
    expect(isClosed(geometry.tool!.mesh)).toBe(true);
    expect(meshBounds(geometry.tool!.mesh).upper[2]).toBeCloseTo(cell.tools[0]!.flangeFromTcp.position[2] - 0.012, 12);
    expect(geometry.worldFromBase).toBe(cell.robot.worldFromBase);
    expect(geometry.shapeError_m).toBeGreaterThan(0);
    expect(cellGeometry(emptyCell(), []).tool).toBeUndefined();
  });
});
