import { strToU8, zipSync } from "fflate";
import { afterAll, beforeAll, expect, test } from "vitest";
import { boxMesh, parseRobot } from "@twincell/core";
import { writeStl, writeUrdf } from "@twincell/formats";
import { readFileSync } from "node:fs";
import { drawn, picture, Studio, type Page } from "./support/studio.ts";

let studio: Studio;
beforeAll(async () => {
  studio = await Studio.start();
});
afterAll(async () => {
  await studio.stop();
});

const SMALL = readFileSync(new URL("../../../examples/robots/small-arm.json", import.meta.url), "utf8");
const answer = parseRobot(JSON.parse(SMALL));
if (answer.kind !== "robot") throw new Error("small-arm.json is no robot");
/** The links of the small arm as six bars with a mesh each. */
const ZIP = zipSync({
  "arm/package.xml": strToU8("<package><name>arm</name></package>"),
  "arm/urdf/bench_arm.urdf": strToU8(
    writeUrdf(answer.robot.arm, {
      name: "Bench arm",
      meshesOf: link => [`package://arm/meshes/${link < 3 ? "thick" : "thin"}.stl`],
    }),
  ),
  "arm/meshes/thick.stl": writeStl(boxMesh([0.09, 0.09, 0.2])),
  "arm/meshes/thin.stl": writeStl(boxMesh([0.05, 0.05, 0.09])),
});

const choose = (page: Page, name: string, content: Uint8Array | string): Promise<void> =>
  page
    .locator("[data-file-input]")
    .setInputFiles([{ name, mimeType: "application/octet-stream", buffer: Buffer.from(content) }]);
/** A dialog comes in by fading: a picture is taken when it is there. */
const settled = (page: Page): Promise<unknown> =>
  page.getByRole("dialog").evaluate(dialog => Promise.all(dialog.getAnimations().map(animation => animation.finished)));
const robotHere = (page: Page): Promise<string> =>
  page.evaluate(() => window.twincell.stores.cellStore.getState().document!.robot.id);
/** Two taught postures, judged with everything that stands in the cell. */
async function teachAndCheck(page: Page, ends: readonly (readonly number[])[]): Promise<string[]> {
  for (const q of ends) {
    await page.evaluate(wanted => window.twincell.live.showJoints(wanted), [...q]);
    await page.evaluate(() => window.twincell.run("program.record-ptp"));
  }
  await page.waitForFunction(
    () => {
      const { verdict, checking } = window.twincell.stores.playStore.getState();
      return checking === null && verdict !== null && verdict.steps.length >= 2;
    },
    null,
    { timeout: 60_000 },
  );
  return page.evaluate(() => window.twincell.stores.playStore.getState().verdict!.steps.map(({ verdict }) => verdict));
}

test("T-16 a ZIP of a URDF becomes the robot of the cell in three steps: drawn with its shapes, taught, checked, played, kept with the cell", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  await page.evaluate(() => window.twincell.run("file.new"));
  await choose(page, "bench.zip", ZIP);
  const question = page.getByRole("dialog");
  await question.getByText("bench_arm.urdf describes a robot").waitFor({ timeout: 60_000 });
  expect(await question.textContent()).toContain("6 axes · solved in closed form");
  await settled(page);
  await page.screenshot({ path: picture("own-robot-question") });
  await question.getByRole("button", { name: "Use as the robot of this cell" }).click();
  await page.waitForFunction(() =>
    window.twincell.stores.cellStore.getState().document!.robot.id.startsWith("bench_arm_"),
  );
  const verdicts = await teachAndCheck(page, [
    [0, 0.2, 0.4, 0, 0.5, 0],
    [0.8, 0.4, 0.2, 0, 0.6, 0.3],
  ]);
  expect(verdicts.every(verdict => verdict === "ok" || verdict === "warn")).toBe(true);
  await page.evaluate(() => window.twincell.run("play.toggle"));
  await page.waitForFunction(() => Math.abs(window.twincell.live.now().q_rad[0]! - 0.8) < 1e-3, null, {
    timeout: 60_000,
  });
  await page.screenshot({ path: picture("own-robot-cell") });

  // Kept with the cell: the saved text opens with its robot where nobody has heard of it.
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.evaluate(() => window.twincell.run("file.save")),
  ]);
  const saved = readFileSync(await download.path(), "utf8");
  const other = await studio.open();
  await drawn(other.page);
  await choose(other.page, "cell.twincell.json", saved);
  await other.page.waitForFunction(() =>
    window.twincell.stores.cellStore.getState().document!.robot.id.startsWith("bench_arm_"),
  );
  await other.page.waitForFunction(() => window.twincell.stores.playStore.getState().verdict?.ok === true, null, {
    timeout: 60_000,
  });
  expect([...problems, ...other.problems]).toEqual([]);
});

test("T-16 a typed D-H table without a closed form is a robot: solved numerically, jogged straight, checked, in the chooser", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  await page.evaluate(() => window.twincell.run("file.new"));
  await page.evaluate(() => window.twincell.run("cell.robot"));
  await page.getByRole("button", { name: "Type a D-H table …" }).click();
  await page.getByLabel("Name", { exact: true }).fill("Odd arm");
  const status = page.getByRole("dialog").getByRole("status");
  const twist = page.getByLabel("α °, joint 2");
  await twist.fill("x");
  await status.getByText("The alpha of row 2 is not a finite number.").waitFor();
  await twist.fill("20");
  await status.getByText("6 axes · solved numerically").waitFor();
  await settled(page);
  await page.screenshot({ path: picture("own-robot-table") });
  await page.getByRole("button", { name: "Use this robot" }).click();
  await page.waitForFunction(() =>
    window.twincell.stores.cellStore.getState().document!.robot.id.startsWith("Odd_arm_"),
  );
  const verdicts = await teachAndCheck(page, [
    [0, -1, 0.6, 0.2, 0.9, 0],
    [0.5, -1.1, 0.7, 0.2, 0.9, 0.3],
  ]);
  expect(verdicts.every(verdict => verdict === "ok" || verdict === "warn")).toBe(true);
  const z = await page.evaluate(() => window.twincell.live.now().worldFromTcp.position[2]);
  await page.evaluate(() => window.twincell.live.hold("keyboard", 2, -1));
  await page.waitForFunction(was => window.twincell.live.now().worldFromTcp.position[2] < was - 0.01, z, {
    timeout: 60_000,
  });
  await page.evaluate(() => window.twincell.live.releaseAll());

  await page.evaluate(() => window.twincell.run("cell.robot"));
  const card = page.getByRole("radio", { name: /Odd arm/ });
  await card.waitFor({ state: "attached" });
  await settled(page);
  await page.screenshot({ path: picture("own-robot-chooser") });
  expect(await robotHere(page)).toMatch(/^Odd_arm_[0-9a-f]{8}$/);
  expect(problems).toEqual([]);
});

test("X-05, M-63 a gripper is put on by a click: the TCP follows its opening, 149 to 163 mm; cups take over what was taught and all is checked anew", async () => {
  const { page, problems } = await studio.open({ width: 1440, height: 900 });
  await drawn(page);
  await page.evaluate(() => window.twincell.run("file.new"));
  // A cell in which nothing is taught opens bent over the work: the flange points down, and the arm can go down.
  const ready = await page.evaluate(() => ({
    z: window.twincell.live.now().worldFromTcp.position[2],
    bent: Math.abs(window.twincell.live.now().q_rad[2]!),
  }));
  expect(ready.z).toBeLessThan(1);
  expect(ready.bent).toBeGreaterThan(0.3);
  await page
    .getByRole("tab", { name: "Cell", exact: true })
    .or(page.getByRole("radio", { name: "Cell", exact: true }))
    .first()
    .click();
  const library = page.getByRole("region", { name: "Part library" });
  await library.getByRole("button", { name: /^Tools/ }).click();
  await library.getByRole("button", { name: /^Two fingers/ }).click();
  const tcp = () =>
    page.evaluate(() => {
      const { document } = window.twincell.stores.cellStore.getState();
      return document!.tools.find(({ name }) => name === document!.tool)!.flangeFromTcp.position[2];
    });
  expect(await tcp()).toBeCloseTo(0.149, 3);
  const lower = await page.evaluate(() => window.twincell.live.now().worldFromTcp.position[2]);
  expect(ready.z - lower).toBeCloseTo(0.149, 3);
  const opening = page.getByRole("textbox", { name: "Opening" });
  await opening.fill("0");
  await opening.press("Enter");
  expect(await tcp()).toBeCloseTo(0.1626, 3);
  await page.screenshot({ path: picture("tool-two-fingers") });
  const q = await page.evaluate(() => Array.from(window.twincell.live.now().q_rad));
  await page.evaluate(() => window.twincell.run("program.record-lin"));
  await page.evaluate(wanted => window.twincell.live.showJoints(wanted), [q[0]! + 0.3, ...q.slice(1)]);
  await page.evaluate(() => window.twincell.run("program.record-lin"));
  const checked = (steps: number) =>
    page.waitForFunction(
      n => {
        const { verdict, checking } = window.twincell.stores.playStore.getState();
        return checking === null && verdict !== null && verdict.steps.length === n;
      },
      steps,
      { timeout: 60_000 },
    );
  await checked(2);
  await library.getByRole("button", { name: /^Vacuum cups/ }).click();
  await page.getByRole("button", { name: "Take over what was taught with Two fingers" }).click();
  const tools = await page.evaluate(() =>
    window.twincell.stores.cellStore
      .getState()
      .document!.programs.flatMap(program =>
        "steps" in program ? program.steps.flatMap(step => (step.type === "move" ? [step.target.tool] : [])) : [],
      ),
  );
  expect(tools).toEqual(["Vacuum cups", "Vacuum cups"]);
  await checked(2);
  await page.screenshot({ path: picture("tool-vacuum-cups") });
  expect(problems).toEqual([]);
});
