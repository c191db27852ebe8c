import { existsSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { strToU8, zipSync } from "fflate";
import { afterAll, beforeAll, beforeEach, describe, expect, test } from "vitest";
import { boxMesh, meshBounds, type TriangleMesh } from "@twincell/core";
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
