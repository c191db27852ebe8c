import { flangeOfTcp, robotById, solveAll, type Pose, type Vector3 } from "@twincell/core";
import { edgeTraceCell } from "@twincell/project";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { drawn, picture, Studio } from "./support/studio.ts";

let studio: Studio;
beforeAll(async () => {
  studio = await Studio.start();
});
afterAll(async () => {
  await studio.stop();
});

const robot = robotById("staubli_rx90l")!;
const cell = edgeTraceCell();
/** Joint angles with the tool straight down and its tip there. */
function toolDownAt(position: Vector3): number[] {
  const worldFromTcp: Pose<"world", "tcp"> = { position, quaternion: [0, 1, 0, 0] };
  const reach = solveAll(robot, flangeOfTcp(cell.robot.worldFromBase, worldFromTcp, cell.tools[0]!.flangeFromTcp), {
    near: [0, -0.5, 2, 0, 1, 0],
  });
  if (reach.kind !== "reached") throw new Error(reach.kind);
  return Array.from(reach.solutions[0]!.q_rad);
}
const tcp = (page: Page): Promise<number[]> =>
  page.evaluate(() => Array.from(window.twincell.live.now().worldFromTcp.position));
const stand = async (page: Page, position: Vector3): Promise<void> => {
  await page.evaluate(q => {
    window.twincell.stores.viewStore.setState({ coachDone: true });
    window.twincell.live.showJoints(q);
  }, toolDownAt(position));
  await frames(page, 3);
};
/** So many more frames of the page have passed. */
const frames = (page: Page, count: number) =>
  page.evaluate(
    wanted =>
      new Promise<void>(resolve => {
        const next = (left: number): void => {
          if (left === 0) resolve();
          else
            requestAnimationFrame(() => {
              next(left - 1);
            });
        };
        next(wanted);
      }),
    count,
  );
/** Keeps a pendant button pressed until something holds, then lets go. */
async function hold(page: Page, button: string, until: () => boolean): Promise<void> {
  const box = (await page.getByRole("button", { name: button, exact: true }).boundingBox())!;
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.waitForFunction(until, null, { timeout: 60_000, polling: 50 });
  await page.mouse.up();
}

test("N-38 a pendant key moves while it is held, along its own axis only, and stops when it is let go", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  await stand(page, [0.6, 0, 0.8]);
  const before = await tcp(page);
  await hold(page, "Jog Y up", () => window.twincell.live.now().worldFromTcp.position[1] > 0.03);
  const after = await tcp(page);
  expect(after[1]!).toBeGreaterThan(0.03);
  expect(after[0]!).toBeCloseTo(before[0]!, 6);
  expect(after[2]!).toBeCloseTo(before[2]!, 6);
  await frames(page, 10);
  const rest = await tcp(page);
  await frames(page, 10);
  expect(await tcp(page)).toEqual(rest);
  expect(problems).toEqual([]);
});

test("N-47 N-48 N-49 X-53 in the cell with table and carton a contact sounds once and paints what is touched, and both end when the tool leaves", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  const ids = await page.evaluate(() =>
    window.twincell.stores.cellStore.getState().document!.objects.map(({ id }) => id),
  );
  expect(ids).toEqual(expect.arrayContaining(["table", "carton"]));
  await stand(page, [0.6, 0, 0.56]);
  expect(await page.evaluate(() => [...window.twincell.live.touching()])).toEqual([]);
  await hold(page, "Jog Z down", () => window.twincell.live.touching().has("carton"));
  expect(await page.evaluate(() => [...window.twincell.live.touching()])).toContain("tool");
  expect(await page.evaluate(() => window.twincell.stores.soundStore.getState().played.crash)).toBe(1);
  await frames(page, 5);
  await page.screenshot({ path: picture("contact") });
  await hold(page, "Jog Z up", () => window.twincell.live.touching().size === 0);
  expect(await page.evaluate(() => window.twincell.stores.soundStore.getState().played.crash)).toBe(1);
  expect(problems).toEqual([]);
});

test("points are recorded where the robot stands, touched up, and taken back one by one", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  const steps = () =>
    page.evaluate(
      () =>
        window.twincell.stores.cellStore
          .getState()
          .document!.programs.filter(program => program.format === "twincell.program")[0]!.steps,
    );
  await stand(page, [0.6, 0.1, 0.8]);
  await page.getByRole("button", { name: "PTP", exact: true }).first().click();
  await stand(page, [0.6, -0.1, 0.8]);
  await page.getByRole("button", { name: "LIN", exact: true }).first().click();
  expect((await steps()).map(step => step.type === "move" && step.path)).toEqual(["ptp", "lin"]);
  await stand(page, [0.65, -0.1, 0.8]);
  await page.getByRole("button", { name: "Touch up" }).first().click();
  const touched = (await steps())[1]!;
  const shown = await page.evaluate(() => Array.from(window.twincell.live.now().q_rad));
  expect(touched.type === "move" && "q" in touched.target && touched.target.q).toEqual(shown);
  for (const left of [2, 1, 0]) {
    await page.keyboard.press("Control+z");
    await page.waitForFunction(
      count =>
        window.twincell.stores.cellStore
          .getState()
          .document!.programs.filter(program => program.format === "twincell.program")[0]!.steps.length === count,
      left,
    );
  }
  expect(problems).toEqual([]);
});

test("L-28 L-30 the ring at the tool is dragged with the mouse; the tool follows, lets go where the mouse does, and keeps what is locked", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  await stand(page, [0.6, 0, 0.8]);
  await page.evaluate(() => {
    window.twincell.run("view.fit");
  });
  await frames(page, 30);
  const before = (await tcp(page)) as Vector3;
  const at = await page.evaluate(point => window.twincellScene!.project(point), before);
  await page.mouse.move(at.x, at.y);
  await frames(page, 3);
  await page.mouse.down();
  for (let i = 1; i <= 8; i++) {
    await page.mouse.move(at.x + 4 * i, at.y - 3 * i);
    await frames(page, 2);
  }
  await page.mouse.up();
  const after = (await tcp(page)) as Vector3;
  const now = await page.evaluate(point => window.twincellScene!.project(point), after);
  expect(Math.hypot(...after.map((value, i) => value - before[i]!))).toBeGreaterThan(0.01);
  expect(Math.hypot(now.x - (at.x + 32), now.y - (at.y - 24))).toBeLessThan(3);
  await page.mouse.move(at.x + 120, at.y + 80);
  await frames(page, 5);
  expect(await tcp(page)).toEqual(after);
  // Its height locked, the tool goes to the side only.
  await page.getByRole("button", { name: "Lock Z", exact: true }).click();
  const there = await page.evaluate(point => window.twincellScene!.project(point), after);
  await page.mouse.move(there.x, there.y);
  await frames(page, 3);
  await page.mouse.down();
  for (let i = 1; i <= 8; i++) {
    await page.mouse.move(there.x - 4 * i, there.y - 3 * i);
    await frames(page, 2);
  }
  await page.mouse.up();
  const aside = (await tcp(page)) as Vector3;
  expect(aside[2]).toBeCloseTo(after[2], 6);
  expect(Math.hypot(aside[0] - after[0], aside[1] - after[1])).toBeGreaterThan(0.01);
  expect(problems).toEqual([]);
});

/** Frames of the page from each press that follows to the first in which the robot stands elsewhere. */
const watchPresses = (page: Page): Promise<void> =>
  page.evaluate(() => {
    const late: number[] = [];
    let frame = 0;
    let pressed = -1;
    let before: readonly number[] = [];
    const press = (event: Event): void => {
      if (event instanceof KeyboardEvent && event.repeat) return;
      pressed = frame;
      before = [...window.twincell.live.now().q_rad];
    };
    addEventListener("pointerdown", press, true);
    addEventListener("keydown", press, true);
    const look = (): void => {
      frame++;
      const { q_rad } = window.twincell.live.now();
      if (pressed >= 0 && before.some((angle, j) => angle !== q_rad[j])) {
        late.push(frame - pressed);
        pressed = -1;
      }
      requestAnimationFrame(look);
    };
    requestAnimationFrame(look);
    window.framesLate = late;
  });
declare global {
  interface Window {
    framesLate: number[];
  }
}

test("L-27 L-63 L-66 M-44 the pendant and the keyboard move the TCP within one frame; LIN is a straight segment; a saved pose is gone to", async () => {
  const { page, problems } = await studio.open({ width: 1440, height: 900 });
  await drawn(page);
  await stand(page, [0.6, 0.1, 0.8]);
  await page.getByRole("button", { name: "PTP", exact: true }).first().click();
  await watchPresses(page);
  const presses = (count: number): Promise<unknown> =>
    page.waitForFunction(wanted => window.framesLate.length >= wanted, count, { polling: 20 });
  const key = (await page.getByRole("button", { name: "Jog Y down", exact: true }).boundingBox())!;
  for (let i = 1; i <= 5; i++) {
    await page.mouse.move(key.x + key.width / 2, key.y + key.height / 2);
    await page.mouse.down();
    await presses(2 * i - 1);
    await page.mouse.up();
    await page.keyboard.down("s");
    await presses(2 * i);
    await page.keyboard.up("s");
    await frames(page, 3);
  }
  expect(await page.evaluate(() => window.framesLate)).toEqual(Array.from({ length: 10 }, () => 1));
  await hold(page, "Jog Y down", () => window.twincell.live.now().worldFromTcp.position[1] < -0.1);
  const end = await tcp(page);
  expect(end[0]!).toBeCloseTo(0.6, 6);
  expect(end[2]!).toBeCloseTo(0.8, 6);
  await page.getByRole("button", { name: "LIN", exact: true }).first().click();
  await page.getByRole("button", { name: "Pose", exact: true }).first().click();
  await page.waitForFunction(
    () => {
      const { stale, path } = window.twincell.stores.playStore.getState();
      return !stale && path.length >= 1;
    },
    null,
    { polling: 100 },
  );
  const segment = await page.evaluate(() => {
    const { document } = window.twincell.stores.cellStore.getState();
    const [program] = document!.programs;
    const lin =
      program?.format === "twincell.program"
        ? program.steps.find(s => s.type === "move" && s.path === "lin")
        : undefined;
    return window.twincell.stores.playStore
      .getState()
      .path.filter(piece => piece.step === lin?.id)
      .flatMap(piece => piece.points.map(point => [...point]));
  });
  expect(segment.length).toBeGreaterThan(5);
  for (const [x, , z] of segment) expect(Math.hypot(x! - 0.6, z! - 0.8)).toBeLessThan(1e-5);
  expect(Math.abs(segment.at(-1)![1]! - end[1]!)).toBeLessThan(1e-5);

  await hold(page, "Jog Z up", () => window.twincell.live.now().worldFromTcp.position[2] > 0.85);
  await page.getByRole("button", { name: /^Go to “/ }).click();
  await page.waitForFunction(
    ([x, y, z]) => {
      const { position } = window.twincell.live.now().worldFromTcp;
      return Math.hypot(position[0] - x!, position[1] - y!, position[2] - z!) < 1e-5;
    },
    end,
    { polling: 100 },
  );
  await page.screenshot({ path: picture("lead-through") });
  expect(problems).toEqual([]);
});

test("X-18 X-29 a visible target sphere is moved by the pendant, the arm follows; out of reach it is red, with the distance", async () => {
  const { page, problems } = await studio.open({ width: 1440, height: 900 });
  await drawn(page);
  await stand(page, [0.6, 0, 0.8]);
  const sphere = (): Promise<{ position: number[]; red: boolean } | null> =>
    page.evaluate(() => {
      const found = window.twincellScene!.scene.getObjectByName("target-sphere") as unknown as
        | { position: { x: number; y: number; z: number }; material: { color: { r: number; g: number } } }
        | undefined;
      if (!found) return null;
      const { position, material } = found;
      return { position: [position.x, position.y, position.z], red: material.color.r > 2 * material.color.g };
    });
  expect(await sphere()).toBeNull();
  await page.getByRole("button", { name: "Follow a target" }).click();
  await hold(page, "Jog Y up", () => window.twincell.live.now().worldFromTcp.position[1] > 0.05);
  await frames(page, 10);
  const there = (await sphere())!;
  const tip = await tcp(page);
  expect(Math.hypot(...there.position.map((value, i) => value - tip[i]!))).toBeLessThan(1e-5);
  await page.getByText("The tool is at the target.").waitFor();
  await page.evaluate(() => window.twincell.stores.jogStore.setState({ speed: 1 }));
  const far = page.getByText(/The tool stays [\d.]{4,} mm away\./);
  const key = (await page.getByRole("button", { name: "Jog X up", exact: true }).boundingBox())!;
  await page.mouse.move(key.x + key.width / 2, key.y + key.height / 2);
  await page.mouse.down();
  await far.waitFor({ timeout: 60_000 });
  await page.mouse.up();
  await frames(page, 5);
  const out = (await sphere())!;
  const stays = await tcp(page);
  const off_mm = Math.hypot(...out.position.map((value, i) => value - stays[i]!)) * 1000;
  expect(out.red).toBe(true);
  expect(parseFloat((await far.innerText()).match(/[\d.]+/)![0])).toBeCloseTo(off_mm, 0);
  await page.screenshot({ path: picture("target-sphere") });
  expect(problems).toEqual([]);
});
