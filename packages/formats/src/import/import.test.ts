import { describe, expect, test } from "vitest";
import { boxMesh, seededRandom, sphereMesh } from "@twincell/core";
import { filesInMemory } from "../files/source.ts";
import { writeStl } from "../mesh/stl.ts";
import { filesToImport, importFile, type ImportOptions } from "./import-file.ts";
import { lightened } from "./lighten.ts";
import type { Imported, ImportedPart } from "./part.ts";
import { stepParts, type OcctResult } from "./step-parts.ts";
import { writeGlb } from "./write-glb.ts";

const bytesOf = (text: string): Uint8Array => new TextEncoder().encode(text);
const imported = (
  files: Readonly<Record<string, string | Uint8Array>>,
  path = Object.keys(files)[0]!,
  options?: ImportOptions,
): Imported => {
  const held = new Map(
    Object.entries(files).map(([name, file]) => [name, typeof file === "string" ? bytesOf(file) : file]),
  );
  const answer = importFile(path, filesInMemory(held), options);
  if (answer.kind !== "imported") throw new Error(answer.sentence);
  return answer;
};
const box = (x: number, y: number, z: number): Uint8Array => writeStl(boxMesh([x, y, z]));

describe("the unit of a file", () => {
  test("N-02: a drawing 1185 mm high in millimetres stands 1.185 m high", () => {
    const { report, unit } = imported({ "stand.stl": box(600, 400, 1185) });
    expect(report.size_m[2]).toBeCloseTo(1.185, 6);
    expect(unit).toMatchObject({ metresPerUnit: 0.001, certainty: "likely" });
  });
  test("a 12 m scan stays 12 m, and a 9 mm part does not come in as 9 m; of both the unit is in doubt", () => {
    const ply = `ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n12 0 0\n12 3 0\n0 3 1\n3 0 1 2\n3 0 2 3\n`;
    const scan = imported({ "hall.ply": ply });
    expect(scan.report.size_m[0]).toBeCloseTo(12, 6);
    expect(scan.unit.certainty).toBe("doubtful");
    const pin = imported({ "pin.stl": box(9, 4, 4) });
    expect(pin.report.size_m[0]).toBeCloseTo(0.009, 9);
    expect(pin.unit.certainty).toBe("doubtful");
    expect(pin.unit.sentence).toContain("9 m if it counts in metres, 9 mm if in millimetres");
  });
  test("a unit that a person chooses counts, in inches too", () => {
    const { report, unit } = imported({ "plate.stl": box(10, 2, 1) }, "plate.stl", { metresPerUnit: 0.0254 });
    expect(report.size_m[0]).toBeCloseTo(0.254, 9);
    expect(unit).toMatchObject({ certainty: "chosen", sentence: "The unit was chosen: inches." });
  });
  test("numbers without a unit below 3 are metres", () => {
    expect(imported({ "table.stl": box(1.2, 0.8, 0.7) }).unit).toMatchObject({ metresPerUnit: 1, certainty: "likely" });
  });
});

const OBJ = `mtllib cell.mtl
v 0 0 0
v 1000 0 0
v 0 1000 0
v 0 0 1000
o table
usemtl steel
f 1 3 2
f 1 2 4
o belt
usemtl rubber
f 2 3 4
f 1 4 3
`;
const MTL = "newmtl steel\nKd 0.5 0.6 0.7\nnewmtl rubber\nKd 0.1 0.1 0.1\n";

describe("names, places and colours", () => {
  test("an OBJ comes as its objects with the colours of its MTL", () => {
    const { parts, report } = imported({ "cell.obj": OBJ, "cell.mtl": MTL });
    expect(parts.map(({ name, color }) => [name, color])).toEqual([
      ["table", "#8099b3"],
      ["belt", "#1a1a1a"],
    ]);
    expect(report).toMatchObject({ triangles: 4, parts: 2, materials: 2 });
  });
  test("an OBJ without its MTL says that the colours are missing and is no single grey lump", () => {
    const { parts, report } = imported({ "cell.obj": OBJ });
    expect(new Set(parts.map(({ color }) => color)).size).toBe(2);
    expect(report.fixes.join(" ")).toContain("cell.mtl with the colours was not given");
  });
  test("a text STL with two solids is two parts", () => {
    const facet = (z: number): string =>
      `facet normal 0 0 1\nouter loop\nvertex 0 0 ${z}\nvertex 1 0 ${z}\nvertex 0 1 ${z}\nendloop\nendfacet\n`;
    const { parts } = imported({
      "two.stl": `solid lid\n${facet(1)}endsolid lid\nsolid pot\n${facet(0)}endsolid pot\n`,
    });
    expect(parts.map(({ name }) => name)).toEqual(["lid", "pot"]);
  });
  const dae = (
    up: string,
    unit: string,
  ): string => `<?xml version="1.0"?><COLLADA><asset>${unit}<up_axis>${up}</up_axis></asset>
<library_effects><effect id="e"><profile_COMMON><technique sid="t"><phong><diffuse><color>1 0 0 1</color></diffuse></phong></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh><source id="s"><float_array id="a" count="9">0 0 0 100 0 0 0 200 0</float_array><technique_common><accessor source="#a" count="3" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#s"/></vertices><triangles material="paint" count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="scene"><node id="arm" name="arm"><node id="hand" name="hand"><instance_geometry url="#g"><bind_material><technique_common><instance_material symbol="paint" target="#m"/></technique_common></bind_material></instance_geometry></node></node></visual_scene></library_visual_scenes></COLLADA>`;
  test("a COLLADA file keeps its tree, its colour, its unit and its up axis; z can be taken for up whatever it says", () => {
    const file = dae("Y_UP", '<unit meter="0.01"/>');
    const { parts, report, unit } = imported({ "arm.dae": file });
    expect(parts).toMatchObject([{ name: "hand", path: ["arm"], color: "#ff0000" }]);
    expect(unit.certainty).toBe("stated");
    expect(report.size_m.map(side => Number(side.toFixed(6)))).toEqual([1, 0, 2]);
    expect(
      imported({ "arm.dae": file }, "arm.dae", { daeUp: "z" }).report.size_m.map(side => Number(side.toFixed(6))),
    ).toEqual([1, 2, 0]);
  });
  test("X-01, X-02: parts written as GLB come back with the same names, tree, colours, triangles and bounds", () => {
    const parts: ImportedPart[] = [
      { name: "base – größer", path: ["cell", "press"], color: "#2f6db5", mesh: boxMesh([0.4, 0.3, 0.2]) },
      { name: "ram", path: ["cell", "press"], color: "#c9a572", mesh: sphereMesh(0.1) },
    ];
    const back = imported({ "cell.glb": writeGlb(parts) });
    expect(back.parts.map(({ name, path, color }) => ({ name, path, color }))).toEqual(
      parts.map(({ name, path, color }) => ({ name, path: ["z up", ...path], color })),
    );
    expect(back.report.triangles).toBe(parts.reduce((sum, { mesh }) => sum + mesh.indices.length / 3, 0));
    [0.4, 0.3, 0.2].forEach((side, k) => expect(back.report.size_m[k]).toBeCloseTo(side, 6));
    expect(back.report.openEdges).toBe(0);
    expect(back.unit.certainty).toBe("stated");
  });
  test("a STEP assembly keeps its tree, and faces of another colour stay of another colour", () => {
    const result: OcctResult = {
      success: true,
      root: {
        name: "",
        meshes: [],
        children: [{ name: "gripper", meshes: [], children: [{ name: "finger", meshes: [0], children: [] }] }],
      },
      meshes: [
        {
          name: "finger",
          color: [0, 0, 1],
          brep_faces: [
            { first: 0, last: 0, color: null },
            { first: 1, last: 1, color: [1, 0, 0] },
          ],
          attributes: { position: { array: [0, 0, 0, 10, 0, 0, 0, 10, 0, 0, 0, 10] } },
          index: { array: [0, 1, 2, 0, 1, 3] },
        },
      ],
    };
    expect(stepParts(result).parts.map(({ name, path, color }) => ({ name, path, color }))).toEqual([
      { name: "finger", path: ["gripper"], color: [0, 0, 1] },
      { name: "finger", path: ["gripper"], color: [1, 0, 0] },
    ]);
  });
  test("N-65: a cloud of points becomes a closed surface that every point lies in, and its size is right to one cube", () => {
    const random = seededRandom(7);
    const points = Array.from({ length: 2000 }, () => {
      const [u, v] = [2 * Math.PI * random(), Math.acos(2 * random() - 1)];
      return `${Math.cos(u) * Math.sin(v)} ${Math.sin(u) * Math.sin(v)} ${Math.cos(v)}`;
    });
    const { report, parts } = imported({
      "scan.ply": `ply\nformat ascii 1.0\nelement vertex 2000\nproperty float x\nproperty float y\nproperty float z\nend_header\n${points.join("\n")}\n`,
    });
    expect(report.format).toBe("PLY point cloud");
    expect(report.openEdges).toBe(0);
    expect(report.fixes.join(" ")).toMatch(/2000 points became the surface of cubes/);
    const cube = 2 / 160;
    for (const side of report.size_m) {
      expect(side).toBeGreaterThan(1.95);
      expect(side).toBeLessThan(2 + 2 * cube);
    }
    expect(parts).toHaveLength(1);
  });
  test("X-51, N-03: the report counts open edges, triangles without area and coordinates that are no numbers", () => {
    const { report } = imported({
      "bad.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nv 2 0 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\n",
    });
    expect(report).toMatchObject({ trianglesInFile: 3, triangles: 1, openEdges: 3 });
    expect(report.fixes).toEqual(
      expect.arrayContaining([
        "1 triangle with coordinates that are not numbers left out.",
        "1 triangle without area left out.",
        "The surface is open along 3 edges: inside and outside are not certain there.",
      ]),
    );
  });
  test("of a folder the robot description is imported, else every shape", () => {
    expect(filesToImport(["meshes/a.stl", "robot.urdf", "LICENSE"])).toEqual(["robot.urdf"]);
    expect(filesToImport(["b/a.stl", "c.step", "notes.txt"])).toEqual(["c.step", "b/a.stl"]);
  });
});

describe("fewer triangles", () => {
  const sphere = (radius: number, rings: number): ImportedPart["mesh"] => {
    const positions: number[] = [0, 0, radius];
    const indices: number[] = [];
    const around = 2 * rings;
    for (let r = 1; r < rings; r++)
      for (let s = 0; s < around; s++) {
        const [t, f] = [(Math.PI * r) / rings, (2 * Math.PI * s) / around];
        positions.push(radius * Math.sin(t) * Math.cos(f), radius * Math.sin(t) * Math.sin(f), radius * Math.cos(t));
      }
    positions.push(0, 0, -radius);
    const last = positions.length / 3 - 1;
    const at = (r: number, s: number): number => 1 + (r - 1) * around + (s % around);
    for (let s = 0; s < around; s++) {
      indices.push(0, at(1, s), at(1, s + 1), last, at(rings - 1, s + 1), at(rings - 1, s));
      for (let r = 1; r < rings - 1; r++)
        indices.push(at(r, s), at(r + 1, s), at(r + 1, s + 1), at(r, s), at(r + 1, s + 1), at(r, s + 1));
    }
    return { positions: Float64Array.from(positions), indices: Uint32Array.from(indices) };
  };
  test("T-49: a ball of 39,600 triangles keeps its size to 0.1 mm with 8 % of them, closed, and the deviation is measured", async () => {
    const { parts, report } = await lightened(
      [{ name: "ball", path: [], color: "#112233", mesh: sphere(0.1, 100) }],
      3168,
      seededRandom(1),
    );
    expect(report.faces_before).toBe(39_600);
    expect(report.faces).toBeLessThanOrEqual(3168);
    expect(report.faces).toBeGreaterThan(3000);
    expect(report.bounds_change_m).toBeLessThan(1e-4);
    expect(report.open_edges).toBe(0);
    // Triangles of that number on a ball of 100 mm stand off by about its sagitta, 0.2 mm: less would be no
    // measurement.
    expect(report.max_deviation_m).toBeGreaterThan(2e-5);
    expect(report.max_deviation_m).toBeLessThan(3e-4);
    expect(report.rms_deviation_m).toBeLessThan(report.max_deviation_m);
    const radii = Array.from({ length: parts[0]!.mesh.positions.length / 3 }, (_, v) =>
      Math.hypot(...parts[0]!.mesh.positions.slice(3 * v, 3 * v + 3)),
    );
    expect(Math.max(...radii.map(radius => Math.abs(radius - 0.1)))).toBeLessThan(3e-4);
  });
  test("T-50: 3000 materials become at most 20, and the parts keep their names", async () => {
    const random = seededRandom(3);
    const parts = Array.from(
      { length: 3000 },
      (_, i): ImportedPart => ({
        name: `bolt ${i}`,
        path: [],
        color: `#${Math.floor(random() * 0xffffff)
          .toString(16)
          .padStart(6, "0")}`,
        mesh: boxMesh([0.01, 0.01, 0.02]),
      }),
    );
    const light = await lightened(parts, 1e6, random);
    expect(light.report.materials_before).toBeGreaterThan(2900);
    expect(light.report.materials).toBeLessThanOrEqual(20);
    expect(light.parts.map(({ name }) => name)).toEqual(parts.map(({ name }) => name));
    expect(light.report).toMatchObject({ faces: 36_000, max_deviation_m: 0 });
  });
});
