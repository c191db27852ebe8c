import { existsSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { strToU8, unzipSync, zipSync } from "fflate";
import { afterAll, beforeAll, beforeEach, describe, expect, test } from "vitest";
import {
  boxMesh,
  cylinderMesh,
  fromAxisAngle,
  mergeMeshes,
  meshBounds,
  pose,
  scaleMesh,
  transformMesh,
  type TriangleMesh,
  type Vector3,
} from "@twincell/core";
import { writeStl } from "@twincell/formats";
import { emptyCell, saveDocument, shapeMesh, type ObjectRecord } from "@twincell/project";
import type {} from "../src/console.ts";
import { drawn, picture, Studio, type Page, type StudioPage } from "./support/studio.ts";

const STEP = fileURLToPath(new URL("../../../../shared/bench/part.step", import.meta.url));
let studio: Studio;
let open: StudioPage;
beforeAll(async () => {
  studio = await Studio.start();
  open = await studio.open({ width: 1280, height: 720 });
  await drawn(open.page);
});
afterAll(async () => {
  await studio?.stop();
});
beforeEach(async () => {
  await open.page.evaluate(text => {
    window.twincell.stores.dialogStore.setState({ open: null });
    window.twincell.stores.noticeStore.setState({ notices: [] });
    window.twincell.document.open(text, "empty.json");
    window.twincell.stores.noticeStore.setState({ notices: [] });
  }, saveDocument(emptyCell()));
});

type Files = readonly (readonly [name: string, content: Uint8Array | string])[];
const choose = (page: Page, files: Files): Promise<void> =>
  page
    .locator("[data-file-input]")
    .setInputFiles(
      files.map(([name, content]) => ({ name, mimeType: "application/octet-stream", buffer: Buffer.from(content) })),
    );
const dialog = (page: Page) => page.getByRole("dialog");
async function imported(page: Page, files: Files): Promise<readonly ObjectRecord[]> {
  await choose(page, files);
  await page.getByText("What was changed or left out").waitFor({ timeout: 60_000 });
  return objectsOf(page);
}
const objectsOf = (page: Page): Promise<readonly ObjectRecord[]> =>
  page.evaluate(() => window.twincell.stores.cellStore.getState().document!.objects);
const longest = ({ shape }: ObjectRecord): number => {
  const { lower, upper } = meshBounds(shapeMesh(shape));
  return Math.max(...upper.map((value, k) => value - lower[k]!));
};
const idle = (page: Page): Promise<unknown> =>
  page.waitForFunction(() => window.twincell.stores.shapeStore.getState().busy === null);

const OBJ =
  "mtllib cell.mtl\nv 0 0 0\nv 400 0 0\nv 0 400 0\nv 0 0 400\no table\nusemtl steel\nf 1 3 2\nf 1 2 4\no belt\nusemtl rubber\nf 2 3 4\nf 1 4 3\n";
const MTL = "newmtl steel\nKd 0.5 0.6 0.7\nnewmtl rubber\nKd 0.8 0.1 0.1\n";
const URDF =
  '<robot name="lift"><link name="foot"><visual><geometry><box size="0.4 0.4 0.1"/></geometry><material name="m"><color rgba="1 0 0 1"/></material></visual></link><link name="post"><visual><geometry><mesh filename="package://lift/meshes/post.stl" scale="0.001 0.001 0.001"/></geometry></visual></link><joint name="j" type="prismatic"><parent link="foot"/><child link="post"/><origin xyz="0 0 0.3"/><axis xyz="0 0 1"/><limit lower="0" upper="1" velocity="1" effort="1"/></joint></robot>';

function wave(n: number): TriangleMesh {
  const positions: number[] = [];
  const indices: number[] = [];
  for (let i = 0; i <= n; i++)
    for (let j = 0; j <= n; j++) positions.push(i / n, j / n, 0.1 * Math.sin((3 * i) / n) * Math.cos((2 * j) / n));
  for (let i = 0; i < n; i++)
    for (let j = 0; j < n; j++) {
      const a = i * (n + 1) + j;
      indices.push(a, a + n + 1, a + 1, a + 1, a + n + 1, a + n + 2);
    }
  return { positions: Float64Array.from(positions), indices: Uint32Array.from(indices) };
}

describe("a file of shapes", () => {
  test("an OBJ chosen with its MTL: a part per object with its own colour, and a report with triangles, size and open edges (X-51)", async () => {
    const { page } = open;
    const objects = await imported(page, [
      ["cell.obj", OBJ],
      ["cell.mtl", MTL],
    ]);
    expect(objects.map(({ id, color }) => [id, color])).toEqual([
      ["table", "#8099b3"],
      ["belt", "#cc1a1a"],
    ]);
    const text = (await dialog(page).textContent()) ?? "";
    for (const part of ["cell.obj", "400.0 × 400.0 × 400.0 mm", "Open edges"]) expect(text).toContain(part);
    await page.screenshot({ path: picture("import-report") });
    expect(open.problems).toEqual([]);
  });

  test("a 9 mm part is asked about; said to count in metres it is 9 m, and undo makes it 9 mm with its unit", async () => {
    const { page } = open;
    const [pin] = await imported(page, [["pin.stl", writeStl(boxMesh([9, 4, 4]))]]);
    expect(longest(pin!)).toBeCloseTo(0.009, 6);
    expect(await dialog(page).textContent()).toContain("Please check the unit.");
    await dialog(page).getByRole("radio", { name: "m", exact: true }).click();
    await idle(page);
    expect(longest((await objectsOf(page))[0]!)).toBeCloseTo(9, 4);
    await page.evaluate(() => window.twincell.document.undo());
    expect(longest((await objectsOf(page))[0]!)).toBeCloseTo(0.009, 6);
    expect(await dialog(page).getByRole("radio", { name: "mm", exact: true }).getAttribute("aria-checked")).toBe(
      "true",
    );
  });

  test("T-49: “Make it light” shows triangles before and after and the measured deviation, and can be undone", async () => {
    const { page } = open;
    await imported(page, [["wave.stl", writeStl(wave(60))]]);
    await dialog(page).getByLabel("Triangles wanted").fill("600");
    await dialog(page).getByRole("button", { name: "Make it light" }).click();
    await dialog(page).getByText("Maximum deviation").waitFor();
    const row = (name: string): Promise<string[]> =>
      dialog(page).getByRole("row").filter({ hasText: name }).getByRole("cell").allTextContents();
    const [before, after] = await row("Triangles");
    expect(before).toBe("7,200");
    expect(Number(after!.replace(",", ""))).toBeLessThanOrEqual(600);
    const [, deviation] = await row("Maximum deviation");
    expect(Number.parseFloat(deviation!)).toBeGreaterThan(0);
    expect(Number.parseFloat(deviation!)).toBeLessThan(2);
    const [object] = await objectsOf(page);
    expect(shapeMesh(object!.shape).indices.length / 3).toBe(Number(after!.replace(",", "")));
    await page.screenshot({ path: picture("import-light") });
    await page.evaluate(() => window.twincell.document.undo());
    const [back] = await objectsOf(page);
    expect(shapeMesh(back!.shape).indices.length / 3).toBe(7200);
  });

  test("X-04: a ZIP of a URDF folder comes with every link where it stands, meshes and colours too", async () => {
    const { page } = open;
    const zip = zipSync({
      "lift/package.xml": strToU8("<package><name>lift</name></package>"),
      "lift/urdf/lift.urdf": strToU8(URDF),
      "lift/meshes/post.stl": writeStl(boxMesh([100, 100, 500])),
    });
    await choose(page, [["lift.zip", zip]]);
    // It has a moving axis: it could be the robot of the cell. Here it is furniture.
    await dialog(page).getByText("lift.urdf describes a robot").waitFor({ timeout: 60_000 });
    await dialog(page).getByRole("button", { name: "Add as parts" }).click();
    await page.getByText("What was changed or left out").waitFor({ timeout: 60_000 });
    const objects = await objectsOf(page);
    expect(objects.map(({ id }) => id)).toEqual(["foot", "post"]);
    expect(objects[0]!.color).toBe("#ff0000");
    const [foot, post] = objects.map(object => object.worldFromObject.position[2]);
    expect(post! - foot!).toBeCloseTo(0.3 - 0.25 + 0.05, 6);
    expect(longest(objects[1]!)).toBeCloseTo(0.5, 6);
  });

  test.skipIf(!existsSync(STEP))(
    "a STEP file is read beside the page: closed and 300 mm long, and cancelled within 1 s",
    async () => {
      const { page } = open;
      const bytes = readFileSync(STEP);
      const [part] = await imported(page, [["part.step", bytes]]);
      expect(longest(part!)).toBeCloseTo(0.3, 4);
      await page.screenshot({ path: picture("import-step") });
      await page.evaluate(() => window.twincell.stores.dialogStore.setState({ open: null }));
      const before = await objectsOf(page);
      await choose(page, [["again.step", bytes]]);
      await page.getByText("Reading again.step …").waitFor();
      const pressed = await page.evaluate(async () => {
        const started = performance.now();
        [...document.querySelectorAll("button")].find(button => button.textContent === "Cancel")!.click();
        while (window.twincell.stores.shapeStore.getState().busy !== null) await new Promise(requestAnimationFrame);
        return performance.now() - started;
      });
      expect(pressed).toBeLessThan(1000);
      expect(await objectsOf(page)).toEqual(before);
      expect(open.problems).toEqual([]);
    },
  );

  test("an archive whose paths lead out of it is one sentence, and the cell stays as it was", async () => {
    const { page } = open;
    const before = await objectsOf(page);
    await choose(page, [["bad.zip", zipSync({ "../../a.stl": writeStl(boxMesh([1, 1, 1])) })]]);
    await page.waitForFunction(() => window.twincell.stores.noticeStore.getState().notices.length > 0);
    const [notice] = await page.evaluate(() => window.twincell.stores.noticeStore.getState().notices);
    expect(notice!.sentence).toMatch(/^bad\.zip was not opened\. .*leads out of its folder\.$/);
    expect(await objectsOf(page)).toEqual(before);
  });
});

/** An arm of two axes as a CAD file has it, in millimetres: pivots at (0, 0) upright and at a height of 700 along y. */
function twoAxisArm(): string {
  const lying = fromAxisAngle([1, 0, 0], Math.PI / 2);
  const parts: Readonly<Record<string, TriangleMesh>> = {
    foot: transformMesh(boxMesh([0.3, 0.3, 0.3]), pose([0, 0, 0.15])),
    column: transformMesh(cylinderMesh(0.05, 0.4, 48), pose([0, 0, 0.5])),
    boom: mergeMeshes([
      { mesh: cylinderMesh(0.08, 0.16, 48), pose: pose([0, 0, 0.7], lying) },
      { mesh: boxMesh([0.4, 0.08, 0.08]), pose: pose([0.25, 0, 0.7]) },
    ]),
  };
  const lines: string[] = [];
  let first = 1;
  for (const [name, mesh] of Object.entries(parts)) {
    const { positions, indices } = scaleMesh(mesh, 1000);
    lines.push(`o ${name}`);
    for (let i = 0; i < positions.length; i += 3) lines.push(`v ${[...positions.slice(i, i + 3)].join(" ")}`);
    for (let i = 0; i < indices.length; i += 3)
      lines.push(`f ${[...indices.slice(i, i + 3)].map(vertex => vertex + first).join(" ")}`);
    first += positions.length / 3;
  }
  return `${lines.join("\n")}\n`;
}
/** Moves over these points of the world until one lies on that kind of surface of that object, and clicks there. */
async function pick(page: Page, object: string, kind: string, points: readonly Vector3[]): Promise<void> {
  for (const point of points) {
    const at = await page.evaluate(where => window.twincellScene!.project(where), point);
    await page.mouse.move(at.x - 2, at.y - 1);
    await page.evaluate(() => window.twincell.stores.surfaceStore.setState({ hovered: null }));
    await page.mouse.move(at.x, at.y);
    const found = await page
      .waitForFunction(() => window.twincell.stores.surfaceStore.getState().hovered, null, { timeout: 4000 })
      .then(handle => handle.jsonValue())
      .catch(() => null);
    if (found?.object !== object || found.feature.kind !== kind) continue;
    await page.mouse.click(at.x, at.y);
    return;
  }
  throw new Error(`No ${kind} of ${object} is under any of the points.`);
}
/** Points round an upright or lying cylinder: some of them face the camera. */
const around = ([x, y, z]: Vector3, radius_m: number, lies: boolean): Vector3[] =>
  Array.from({ length: 8 }, (_, i): Vector3 => {
    const angle = ((i - 2) * Math.PI) / 4 + 0.065;
    const [a, b] = [radius_m * 0.998 * Math.cos(angle), radius_m * 0.998 * Math.sin(angle)];
    return lies ? [x + a, y, z + b] : [x + a, y + b, z];
  });
const cellMode = (page: Page): Promise<void> =>
  page
    .getByRole("tab", { name: "Cell", exact: true })
    .or(page.getByRole("radio", { name: "Cell", exact: true }))
    .first()
    .click();

test("T-52, N-05 two shafts of an imported assembly are clicked in order: the chain stands with its limits, is saved as URDF with inertias, and becomes the robot of the cell", async () => {
  const { page } = open;
  await imported(page, [["arm.obj", twoAxisArm()]]);
  await page.keyboard.press("Escape");
  await cellMode(page);
  const [foot, column, boom] = await page.evaluate(() =>
    ["foot", "column", "boom"].map(
      id =>
        [
          ...window.twincell.stores.cellStore.getState().document!.objects.find(object => object.id === id)!
            .worldFromObject.position,
        ] as Vector3,
    ),
  );
  const [x, y] = foot!;
  expect(column![2]).toBeCloseTo(0.3, 6);
  expect(boom![2]).toBeCloseTo(0.62, 6);
  await page.getByRole("button", { name: "Make a robot" }).click();
  const panel = page.getByRole("region", { name: "Make a robot" });
  await pick(page, "column", "cylinder", around([x, y, 0.42], 0.05, false));
  await pick(page, "boom", "cylinder", around([x, y - 0.06, 0.7], 0.08, true));
  await panel.getByRole("textbox", { name: "Upper limit, joint 2" }).fill("75");
  await page.keyboard.press("Enter");
  await panel.getByRole("textbox", { name: "Lower limit, joint 2" }).fill("-60");
  await page.keyboard.press("Enter");
  await panel.getByRole("button", { name: "Pick the flange" }).click();
  await pick(page, "boom", "plane", [
    [x + 0.45, y - 0.02, 0.68],
    [x + 0.45, y + 0.02, 0.72],
    [x + 0.4, y - 0.02, 0.74],
  ]);
  expect(await panel.getByRole("combobox", { name: "Link of boom" }).textContent()).toContain("Link 2");
  expect(await panel.getByRole("combobox", { name: "Link of foot" }).textContent()).toContain("Base");
  const picked = await page.evaluate(() => window.twincell.stores.rigStore.getState().flange!.at_m);
  await page.mouse.move(640, 10);
  await page.screenshot({ path: picture("rig-axes") });

  const [download] = await Promise.all([
    page.waitForEvent("download"),
    panel.getByRole("button", { name: "Save URDF" }).click(),
  ]);
  const packed = unzipSync(readFileSync(await download.path()));
  const urdf = new TextDecoder().decode(packed["arm/urdf/arm.urdf"]);
  expect(Object.keys(packed).filter(path => path.endsWith(".stl"))).toHaveLength(3);
  expect(urdf.match(/<inertia /g)).toHaveLength(2);
  expect(urdf).toContain('lower="-1.0471975511965976" upper="1.3089969389957472"');

  await panel.getByRole("button", { name: "Use as the robot of this cell" }).click();
  await page.waitForFunction(() => window.twincell.stores.cellStore.getState().document!.robot.id.startsWith("arm_"));
  const cell = await page.evaluate(() => {
    const { document } = window.twincell.stores.cellStore.getState();
    window.twincell.live.showJoints([Math.PI / 2, 0.5]);
    return { objects: document!.objects.length, base: document!.robot.worldFromBase.position };
  });
  expect(cell.objects).toBe(0);
  [x, y, 0].forEach((value, k) => expect(cell.base[k]).toBeCloseTo(value, 6));
  // The picked flange, a quarter turn about the column, and 0.5 rad about the shoulder 700 mm up.
  const tip = await page.evaluate(() => window.twincell.live.now().worldFromTcp.position);
  const [dx, dy, dz] = picked.map((value, k) => value - [x, y, 0.7][k]!) as Vector3;
  expect(tip[0]).toBeCloseTo(x - dy, 5);
  expect(tip[1] - y).toBeCloseTo(dx * Math.cos(0.5) + dz * Math.sin(0.5), 5);
  expect(tip[2] - 0.7).toBeCloseTo(dz * Math.cos(0.5) - dx * Math.sin(0.5), 5);
  await page.screenshot({ path: picture("rig-robot") });
  await page.evaluate(() => window.twincell.run("edit.undo"));
  expect(await objectsOf(page)).toHaveLength(3);
  expect(open.problems).toEqual([]);
}, 120_000);

test("a block is put face to face on a table and pushed off by a typed gap, and a pin axis to axis into a bore, one undo each", async () => {
  const { page } = open;
  const object = (id: string, at: Vector3, shape: ObjectRecord["shape"]): ObjectRecord => ({
    id,
    name: id,
    role: "fixture",
    worldFromObject: pose(at, fromAxisAngle([0, 0, 1], 0.3)),
    shape,
    color: "#7a8a94",
  });
  const cell = emptyCell();
  await page.evaluate(
    text => window.twincell.document.open(text, "mates.json"),
    saveDocument({
      ...cell,
      objects: [
        object("table", [0.7, 0, 0.2], { kind: "box", size_m: [0.5, 0.5, 0.4] }),
        object("block", [0.7, -0.7, 0.1], { kind: "box", size_m: [0.2, 0.2, 0.2] }),
        object("post", [0.7, 0.7, 0], { kind: "cylinder", radius_m: 0.06, height_m: 0.5 }),
        object("pin", [1.2, 0.5, 0], { kind: "cylinder", radius_m: 0.05, height_m: 0.3 }),
      ],
    }),
  );
  await cellMode(page);
  await page.getByRole("button", { name: "Mate", exact: true }).click();
  const card = page.getByRole("region", { name: "Mate" });
  await card.getByText("Click a face, bore or shaft of the object that moves.").waitFor();
  const placeOf = (id: string): Promise<ObjectRecord["worldFromObject"]> =>
    page.evaluate(
      which =>
        window.twincell.stores.cellStore.getState().document!.objects.find(each => each.id === which)!.worldFromObject,
      id,
    );
  // The side of the block goes to the top of the table: it comes to lie on that side.
  const out = [-Math.sin(0.3), Math.cos(0.3)] as const;
  const sides = [1, -1].map((sign): Vector3 => [0.7 - sign * out[0] * 0.1, -0.7 - sign * out[1] * 0.1, 0.1]);
  await pick(page, "block", "plane", sides);
  await pick(page, "table", "plane", [[0.7, 0, 0.4]]);
  await card.getByText("Face to face").waitFor();
  expect((await placeOf("block")).position[2]).toBeCloseTo(0.5, 6);
  await page.mouse.move(640, 10);
  await page.screenshot({ path: picture("mate-faces") });
  await card.getByRole("textbox", { name: "Gap" }).fill("30");
  await page.keyboard.press("Enter");
  expect((await placeOf("block")).position[2]).toBeCloseTo(0.53, 6);

  await card.getByRole("button", { name: "Mate another" }).click();
  await pick(page, "pin", "cylinder", around([1.2, 0.5, 0.15], 0.05, false));
  await pick(page, "post", "cylinder", around([0.7, 0.7, 0.4], 0.06, false));
  await card.getByText("Axis to axis").waitFor();
  const pin = await placeOf("pin");
  [0.7, 0.7, 0].forEach((value, k) => expect(pin.position[k]).toBeCloseTo(value, 6));
  await page.evaluate(() => window.twincell.run("edit.undo"));
  expect((await placeOf("pin")).position[0]).toBeCloseTo(1.2, 9);
  expect(open.problems).toEqual([]);
}, 120_000);

test("M-06, M-08 an imported STL is moved, turned and made twice as large by typed numbers, is drawn so, and each is one undo", async () => {
  const { page } = open;
  const [part] = await imported(page, [["bar.stl", writeStl(boxMesh([400, 100, 50]))]]);
  await page.keyboard.press("Escape");
  await cellMode(page);
  const type = async (name: string, value: string): Promise<void> => {
    const field = page.getByRole("textbox", { name }).first();
    await field.fill(value);
    await field.press("Enter");
  };
  /** Waits until what is drawn has these sides and, where asked, its middle at that x [m]. */
  const drawnAs = (size: readonly number[], x_m?: number): Promise<unknown> =>
    page.waitForFunction(
      ([id, wanted, middle]) => {
        const lower = [Infinity, Infinity, Infinity];
        const upper = [-Infinity, -Infinity, -Infinity];
        window.twincellScene!.scene.getObjectByName(id)?.traverse(each => {
          const mesh = each as unknown as {
            isMesh?: boolean;
            geometry: { attributes: { position: { count: number; array: ArrayLike<number> } } };
            matrixWorld: { elements: ArrayLike<number> };
          };
          if (!mesh.isMesh) return;
          const { array, count } = mesh.geometry.attributes.position;
          const m = mesh.matrixWorld.elements;
          for (let i = 0; i < count; i++) {
            const at = [0, 1, 2].map(
              k => m[k]! * array[3 * i]! + m[4 + k]! * array[3 * i + 1]! + m[8 + k]! * array[3 * i + 2]! + m[12 + k]!,
            );
            // The scene is y-up.
            [at[0]!, -at[2]!, at[1]!].forEach((value, k) => {
              lower[k] = Math.min(lower[k]!, value);
              upper[k] = Math.max(upper[k]!, value);
            });
          }
        });
        return (
          wanted.every((side, k) => Math.abs(upper[k]! - lower[k]! - side) < 1e-4) &&
          (middle === undefined || Math.abs((upper[0]! + lower[0]!) / 2 - middle) < 1e-4)
        );
      },
      [part!.id, size, x_m] as const,
      { timeout: 30_000, polling: 100 },
    );
  await drawnAs([0.4, 0.1, 0.05]);
  await type("Position X", "900");
  await type("Rotation Rz", "90");
  await drawnAs([0.1, 0.4, 0.05], 0.9);
  await type("Scale factor", "2");
  await drawnAs([0.2, 0.8, 0.1], 0.9);
  for (const size of [
    [0.1, 0.4, 0.05],
    [0.4, 0.1, 0.05],
  ]) {
    await page.evaluate(() => window.twincell.run("edit.undo"));
    await drawnAs(size);
  }
  expect(open.problems).toEqual([]);
}, 120_000);
