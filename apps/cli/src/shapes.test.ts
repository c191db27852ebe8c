import { spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { boxMesh, fromAxisAngle, meshBounds, pose, robotById, transformMesh, type Vector3 } from "@twincell/core";
import { importFile, readStl, writeGlb, writeStl, type FileSource, type ImportedPart } from "@twincell/formats";
import { cellGeometry, openDocument, physicalScene, rescaledObjects, shapeMesh, worldBounds } from "@twincell/project";

const root = fileURLToPath(new URL("../../../", import.meta.url));
let folder = "";
beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), "twincell-shapes-"));
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));
const at = (name: string): string => join(folder, name);
const write = (name: string, content: string | Uint8Array): string => {
  writeFileSync(at(name), content);
  return at(name);
};
const twincell = (
  ...args: readonly string[]
): { readonly code: number; readonly out: string; readonly err: string } => {
  const run = spawnSync(process.execPath, ["apps/cli/src/main.ts", ...args], { cwd: root, encoding: "utf8" });
  return { code: run.status ?? -1, out: run.stdout, err: run.stderr };
};
const disk: FileSource = { read: path => (existsSync(path) ? readFileSync(path) : undefined), list: () => undefined };

const TETRAHEDRON = `ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('','',(''),(''),'','','');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));
ENDSEC;
DATA;
ENDSEC;
END-ISO-10303-21;
`;

test("import puts the parts of an OBJ into a new cell with names, colours and one size, and adds to one that is there", () => {
  write("a.mtl", "newmtl red\nKd 1 0 0\n");
  const obj = write(
    "a.obj",
    "mtllib a.mtl\nv 0 0 0\nv 400 0 0\nv 0 400 0\nv 0 0 400\no jig\nusemtl red\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n",
  );
  const first = twincell("import", obj, "-o", at("cell.json"));
  expect(first.err).toBe("");
  expect(JSON.parse(first.out)).toMatchObject({
    unit: { metresPerUnit: 0.001, certainty: "likely" },
    report: { triangles: 4, materials: 1, openEdges: 0 },
    objects: ["jig"],
  });
  expect(
    twincell(
      "import",
      write("b.stl", writeStl(boxMesh([9, 4, 4]))),
      "-o",
      at("cell.json"),
      "--unit",
      "mm",
      "--at",
      "1,2,0.5",
    ).code,
  ).toBe(0);
  const cell = openDocument(readFileSync(at("cell.json"), "utf8"));
  if (cell.kind !== "opened") throw new Error(cell.kind);
  expect(cell.document.objects.map(({ id, color }) => [id, color])).toEqual([
    ["jig", "#ff0000"],
    ["b", "#9aa7b0"],
  ]);
  expect(cell.document.objects[1]!.worldFromObject.position).toEqual([1, 2, 0.5]);
  const { lower, upper } = meshBounds(shapeMesh(cell.document.objects[1]!.shape));
  expect(upper[0] - lower[0]).toBeCloseTo(0.009, 6);
});

test("T-16 import --robot PATH makes a cell that brings the robot of a file with it; it is checked in that cell", () => {
  const made = twincell("import", "--robot", "examples/robots/small-arm.json", "-o", at("own.json"));
  expect([made.code, made.out.trim()]).toEqual([0, ""]);
  const cell = openDocument(readFileSync(at("own.json"), "utf8"));
  if (cell.kind !== "opened") throw new Error(cell.kind);
  expect(cell.document.robot.id).toMatch(/^small_arm_[0-9a-f]{8}$/);
  const step = {
    id: "a",
    type: "move",
    path: "ptp",
    target: { q: [0.5, 0, 0, 0, 0.3, 0] },
    speed: { ratio: 0.5 },
    blend_m: 0,
  };
  const [program] = cell.document.programs;
  const check = twincell(
    "check",
    write("own-program.json", JSON.stringify({ ...program, steps: [step] })),
    "--cell",
    at("own.json"),
    "--json",
  );
  expect([check.code, check.err]).toEqual([0, ""]);
  const bad = JSON.parse(readFileSync(at("own.json"), "utf8")) as { robot: { file: { joints: unknown[] } } };
  bad.robot.file.joints = [];
  const refused = twincell("check", at("own-program.json"), "--cell", write("bad.json", JSON.stringify(bad)));
  expect(refused.code).not.toBe(0);
  expect(refused.err).toContain("robot.file.joints: A robot has 1 to 32 joints; here it has 0.");
});

const ROOM: readonly ImportedPart[] = [
  ["floor", [6, 5, 0.1], [0, 0, -0.05], "#8a8f94"],
  ["wall north", [6, 0.1, 3], [0, 2.55, 1.5], "#e6e9eb"],
  ["wall west", [0.1, 5, 3], [-3.05, 0, 1.5], "#e6e9eb"],
  ["bench", [1.2, 0.6, 0.8], [2, 1.5, 0.4], "#c8a26c"],
].map(([name, size, at, color]) => ({
  name: name as string,
  path: ["laboratory"],
  color: color as string,
  mesh: transformMesh(boxMesh(size as Vector3), pose(at as Vector3)),
}));

test("T-62 the robot stands inside a laboratory: a room of 6 × 5 × 3 m comes at scale around it, each part by its name, and is checked against", () => {
  const room = write("room.glb", writeGlb(ROOM));
  expect(twincell("import", room, "--robot", "ur10e", "-o", at("lab.json"), "--at", "0,0,-0.1").code).toBe(0);
  const cell = openDocument(readFileSync(at("lab.json"), "utf8"));
  if (cell.kind !== "opened") throw new Error(cell.kind);
  expect(cell.document.objects.map(({ name }) => name)).toEqual(ROOM.map(({ name }) => name));
  const boxes = cell.document.objects.map(({ shape, worldFromObject }) => worldBounds(shape, worldFromObject));
  const side = (k: 0 | 1 | 2): number =>
    Math.max(...boxes.map(({ upper }) => upper[k])) - Math.min(...boxes.map(({ lower }) => lower[k]));
  expect([side(0), side(1), side(2)].map(value => value.toFixed(2))).toEqual(["6.10", "5.10", "3.10"]);
  // Stretched to the north the arm meets the wall that stands 2.5 m away only where it is brought there.
  const step = (q: number[]) => ({
    id: `q${q[0]}`,
    type: "move",
    path: "ptp",
    target: { q },
    speed: { ratio: 0.5 },
    blend_m: 0,
  });
  const judged = (file: string, q: number[]): number => {
    const [program] = cell.document.programs;
    const path = write("lab-program.json", JSON.stringify({ ...program, steps: [step(q)] }));
    return twincell("check", path, "--cell", file).code;
  };
  const standing = [0, -1.6, 1.2, 0, 1.5, 0];
  expect(judged(at("lab.json"), standing)).toBe(0);
  const near = JSON.parse(readFileSync(at("lab.json"), "utf8")) as { robot: { worldFromBase: { position: number[] } } };
  near.robot.worldFromBase.position = [0, 2.5, 0];
  expect(judged(write("near.json", JSON.stringify(near)), standing)).toBe(1);
});

test("M-05, M-06, M-08 one STL is taught against and simulated as the same facets, moved, turned and scaled, and comes back as it was", () => {
  const source = boxMesh([40, 30, 20]);
  const stl = write("piece.stl", writeStl(source));
  expect(twincell("import", stl, "-o", at("piece.json"), "--unit", "mm", "--at", "0.5,0.2,0.3").code).toBe(0);
  const cell = openDocument(readFileSync(at("piece.json"), "utf8"));
  if (cell.kind !== "opened") throw new Error(cell.kind);
  const [piece] = cell.document.objects;
  const robot = robotById(cell.document.robot.id)!;
  const turned = {
    ...rescaledObjects([piece!], 25.4)[0]!,
    worldFromObject: pose<"world", "object">([1, 2, 3], fromAxisAngle([0, 0, 1], Math.PI / 2)),
  };
  for (const [object, factor] of [
    [piece!, 1],
    [turned, 25.4],
  ] as const) {
    const document = { ...cell.document, objects: [object] };
    const taught = cellGeometry(document, []).objects[0]!;
    const simulated = physicalScene(document, robot).objects[0]!;
    expect(taught.mesh.indices.length / 3).toBe(12);
    expect(simulated.shape).toEqual({ kind: "mesh", mesh: taught.mesh });
    const back = readStl(writeStl(taught.mesh));
    if (back.kind !== "read") throw new Error(back.sentence);
    const { lower, upper } = meshBounds(back.mesh);
    [0.04, 0.03, 0.02].forEach((side, k) => expect(upper[k]! - lower[k]!).toBeCloseTo(side * factor, 5));
  }
  // Turned by 90° its length lies along y, where it was moved to.
  const box = worldBounds(turned.shape, turned.worldFromObject);
  expect(box.upper[1] - box.lower[1]).toBeCloseTo(0.04 * 25.4, 5);
  expect((box.upper[1] + box.lower[1]) / 2).toBeCloseTo(2, 5);
  // A unit that is in doubt is said, whatever the numbers are: 40 mm could be 40 m.
  const doubt = twincell("import", write("hall.stl", writeStl(boxMesh([400, 300, 20]))), "-o", at("doubt.json"));
  expect(JSON.parse(doubt.out)).toMatchObject({ unit: { metresPerUnit: 0.001 } });
});

test("T-49: mesh writes a GLB with the triangles asked for and prints faces, materials, bounds and both deviations in metres", () => {
  const positions: number[] = [];
  const indices: number[] = [];
  const n = 60;
  for (let i = 0; i <= n; i++)
    for (let j = 0; j <= n; j++) positions.push(i / n, j / n, 0.1 * Math.sin((3 * i) / n) * Math.cos((2 * j) / n));
  for (let i = 0; i < n; i++)
    for (let j = 0; j < n; j++) {
      const a = i * (n + 1) + j;
      indices.push(a, a + n + 1, a + 1, a + 1, a + n + 1, a + n + 2);
    }
  const input = write(
    "wave.stl",
    writeStl({ positions: Float64Array.from(positions), indices: Uint32Array.from(indices) }),
  );
  const { code, out } = twincell("mesh", input, "-o", at("wave.glb"), "--faces", "600");
  expect(code).toBe(0);
  const report = JSON.parse(out) as Record<string, number>;
  expect(report).toMatchObject({ faces_before: 7200, materials: 1 });
  expect(report["faces"]).toBeLessThanOrEqual(600);
  expect(report["bounds_change_m"]).toBeLessThan(1e-4);
  expect(report["max_deviation_m"]).toBeGreaterThan(1e-6);
  expect(report["max_deviation_m"]).toBeLessThan(2e-3);
  expect(report["rms_deviation_m"]).toBeLessThan(report["max_deviation_m"]!);
  const back = importFile(at("wave.glb"), disk);
  expect(back.kind === "imported" && back.report.triangles).toBe(report["faces"]);
});

describe("what cannot be read ends with 2 and one sentence, and no cell is written", () => {
  test.each<readonly [string, () => readonly string[], RegExp]>([
    ["no file", () => ["import", at("none.stl"), "-o", at("no.json")], /There is no file/],
    ["an ending nobody knows", () => ["import", write("a.fbx", "x"), "-o", at("no.json")], /cannot be imported/],
    [
      "a file cut off",
      () => ["import", write("cut.stl", writeStl(boxMesh([1, 1, 1])).subarray(0, 200)), "-o", at("no.json")],
      /promises 12 triangles/,
    ],
    ["an empty STEP", () => ["import", write("e.step", TETRAHEDRON), "-o", at("no.json")], /STEP/],
    ["no archive", () => ["import", write("a.zip", "PK"), "-o", at("no.json")], /no ZIP archive/],
    [
      "a unit nobody knows",
      () => ["import", write("u.stl", writeStl(boxMesh([1, 1, 1]))), "-o", at("no.json"), "--unit", "ell"],
      /--unit wants/,
    ],
    [
      "too few faces",
      () => ["mesh", write("u.stl", writeStl(boxMesh([1, 1, 1]))), "-o", at("no.glb"), "--faces", "2"],
      /--faces wants/,
    ],
  ])("%s", (_, args, says) => {
    const { code, err } = twincell(...args());
    expect(code).toBe(2);
    expect(err).toMatch(says);
    expect(err.trim().split("\n")).toHaveLength(1);
    expect(existsSync(at("no.json")) || existsSync(at("no.glb"))).toBe(false);
  });
});

const part = process.env["TWINCELL_SHARED"] ?? fileURLToPath(new URL("../../../../shared", import.meta.url));
test.skipIf(!existsSync(join(part, "bench/part.step")))(
  "X-02: a machined STEP part comes in as closed 300 × 200 mm, to 0.1 mm",
  () => {
    const { out } = twincell("mesh", join(part, "bench/part.step"), "-o", at("part.glb"));
    const report = JSON.parse(out) as { lower_m: number[]; upper_m: number[]; open_edges: number; format: string };
    expect(report).toMatchObject({ format: "STEP", open_edges: 0 });
    [0.3, 0.2].forEach((side, k) =>
      expect(Math.abs(report.upper_m[k]! - report.lower_m[k]! - side)).toBeLessThan(1e-4),
    );
  },
);
