import { readFile } from "node:fs/promises";
import { distance, pose, robotById, transformPoint, unrolled, type Program, type Vector3 } from "@twincell/core";
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

/**
 * A hand over the carton with a tremor of 1 mm: a rest, a straight, a quarter of a circle, a rest; 50 samples a second.
 */
function table(): string {
  const lines = ["t_s,x_m,y_m,z_m,rx_deg,ry_deg,rz_deg,closed"];
  let state = 7;
  const tremor = (): number => {
    state = (state * 1_103_515_245 + 12_345) % 2_147_483_648;
    return 0.001 * (state / 1_073_741_824 - 1);
  };
  for (let i = 0; i <= 300; i++) {
    const t = i / 50;
    const angle = (Math.max(0, Math.min(2, t - 3)) / 2) * (Math.PI / 2);
    const x = t < 1 ? 0.55 : t < 3 ? 0.55 + 0.1 * (t - 1) : 0.75 + 0.1 * Math.sin(angle);
    const y = t < 3 ? -0.15 : -0.05 - 0.1 * Math.cos(angle);
    lines.push([t, x + tremor(), y + tremor(), 0.75 + tremor(), 180, 0, 0, t > 5.5 ? 1 : 0].join(","));
  }
  return lines.join("\n");
}

test("M-36 M-38 M-39 M-40 M-45 M-46 M-47 L-34 X-47 a dropped demonstration is filtered, laid over the hand with its deviation, becomes steps, and is replayed at will from any side", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  await page.evaluate(() => window.twincell.stores.viewStore.setState({ coachDone: true }));
  await page
    .locator("[data-file-input]")
    .setInputFiles({ name: "hand.csv", mimeType: "text/csv", buffer: Buffer.from(table()) });
  const dialog = page.getByRole("dialog", { name: "hand.csv" });
  await dialog.waitFor();
  const fact = (name: string): Promise<string> =>
    dialog.locator("dl.facts > div", { hasText: name }).locator("dd").innerText();
  expect([await fact("Samples"), await fact("Rate")]).toEqual(["301", "50 a second"]);
  await expect.poll(() => fact("Stops")).toBe("2");
  expect([await fact("Stops"), await fact("Straights"), await fact("Curves")]).toEqual(["2", "1", "1"]);
  expect(Number(await fact("Points left"))).toBeLessThan(20);
  const deviation_mm = parseFloat(await fact("Largest deviation"));
  expect(deviation_mm).toBeGreaterThan(0.5);
  expect(deviation_mm).toBeLessThan(4);
  const rms_mm = parseFloat(await fact("Mean deviation"));
  expect(rms_mm).toBeLessThan(deviation_mm);
  // Position and orientation to the joints; speeds to their limits; torques where the robot's are published.
  expect(await fact("Fastest joint")).toMatch(/^J\d, \d{1,2} %$/);
  expect(await fact("Highest torque")).toBe("–");
  await dialog.getByText(/The robot can follow the hand as it went\. The torques of .* are unknown/).waitFor();
  const drawnLines = (): Promise<readonly number[]> =>
    page.evaluate(() =>
      ["demonstration-original", "demonstration-filtered"].map(name => {
        const line = window.twincellScene!.scene.getObjectByName(name) as unknown as
          | { geometry: { getAttribute(of: string): { count: number } } }
          | undefined;
        return line?.geometry.getAttribute("position").count ?? 0;
      }),
    );
  const [original, filtered] = await drawnLines();
  expect(original).toBe(301);
  expect(filtered).toBeGreaterThan(5);
  expect(filtered).toBeLessThan(60);
  await page.screenshot({ path: picture("demonstration") });
  await dialog.getByRole("radio", { name: "Averages" }).click();
  await expect.poll(async () => parseFloat(await fact("Mean deviation"))).not.toBe(rms_mm);
  await dialog.getByRole("radio", { name: "Least squares" }).click();
  await page.setViewportSize({ width: 390, height: 844 });
  await page.screenshot({ path: picture("demonstration-phone") });
  await page.setViewportSize({ width: 1280, height: 800 });
  await dialog.getByRole("button", { name: "Make steps" }).click();
  await dialog.waitFor({ state: "hidden" });
  expect(await drawnLines()).toEqual([0, 0]);
  const kinds = await page.evaluate(() => {
    const [program] = window.twincell.stores.cellStore.getState().document!.programs;
    return program?.format === "twincell.program"
      ? program.steps.map(step => (step.type === "move" ? step.path : step.type))
      : [];
  });
  expect(kinds.slice(0, 2)).toEqual(["ptp", "lin"]);
  expect(kinds.filter(kind => kind === "spline").length).toBeGreaterThanOrEqual(6);
  expect(kinds.at(-1)).toBe("gripper");
  await page.waitForFunction(
    () => {
      const { verdict, stale } = window.twincell.stores.playStore.getState();
      return verdict !== null && !stale;
    },
    null,
    { timeout: 60_000, polling: 100 },
  );
  expect(await page.evaluate(() => window.twincell.stores.playStore.getState().verdict!.ok)).toBe(true);
  await replays(page);
  expect(problems).toEqual([]);
});

/** Played three times to its end; one animation at a time; the view is turned and zoomed while the robot moves. */
async function replays(page: Page): Promise<void> {
  const state = () =>
    page.evaluate(() => {
      const { playing, t_s, plan } = window.twincell.stores.playStore.getState();
      return { playing, t_s, duration_s: plan!.duration_s, q: Array.from(window.twincell.live.now().q_rad) };
    });
  const playing = (is: boolean): Promise<unknown> =>
    page.waitForFunction(wanted => window.twincell.stores.playStore.getState().playing === wanted, is, { polling: 50 });
  const { duration_s } = await state();
  const ends: number[][] = [];
  for (let round = 0; round < 3; round++) {
    await page.evaluate(to => window.twincell.seek(to), duration_s - 0.6);
    await page.getByRole("button", { name: "Play", exact: true }).click();
    await playing(false);
    const now = await state();
    expect(now.t_s).toBeCloseTo(duration_s, 9);
    ends.push(now.q);
  }
  expect(ends[1]).toEqual(ends[0]);
  expect(ends[2]).toEqual(ends[0]);

  // From the start again: the view is turned and zoomed towards the pointer while it plays.
  await page.getByRole("button", { name: "Play", exact: true }).click();
  await playing(true);
  const camera = () =>
    page.evaluate(() => {
      const { x, y, z } = window.twincellScene!.camera.position;
      return [x, y, z];
    });
  const before = await camera();
  const view = (await page.locator(".viewport canvas").boundingBox())!;
  const at = { x: view.x + 0.12 * view.width, y: view.y + 0.7 * view.height };
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await page.mouse.move(at.x + 160, at.y - 60, { steps: 4 });
  await page.mouse.up();
  const turned = await camera();
  const apart = (a: readonly number[], b: readonly number[]): number =>
    Math.hypot(...a.map((value, i) => value - b[i]!));
  expect(apart(turned, before)).toBeGreaterThan(0.2);
  await page.mouse.wheel(0, -400);
  await expect.poll(async () => apart(await camera(), turned)).toBeGreaterThan(0.1);
  expect((await state()).playing).toBe(true);

  // Paused it stands; resumed it goes on from there; another animation ends this one.
  await page.getByRole("button", { name: "Pause", exact: true }).click();
  const held = await state();
  await page.mouse.move(at.x, at.y);
  expect((await state()).q).toEqual(held.q);
  await page.getByRole("button", { name: "Play", exact: true }).click();
  await page.waitForFunction(from => window.twincell.stores.playStore.getState().t_s > from, held.t_s, { polling: 50 });
  await page.getByRole("button", { name: "Move to home" }).first().click();
  await playing(false);
  const home = [...robotById("staubli_rx90l")!.home_rad];
  await page.waitForFunction(
    goal => goal.every((angle, j) => Math.abs(angle - window.twincell.live.now().q_rad[j]!) < 1e-9),
    home,
    { polling: 100 },
  );
}

/** Two of nine placements on the pallet of the example, each missed by 5 mm; 50 samples a second. */
function twoPlacements(): string {
  const lines = ["t_s,x_m,y_m,z_m,rx_deg,ry_deg,rz_deg,closed"];
  let now = [0.3, -0.6, 0.9];
  let closed = 0;
  const go = (to: readonly number[], count: number): void => {
    const from = now;
    for (let i = 1; i <= count; i++) {
      const s = i / count;
      const at = from.map((value, k) => value + (3 * s * s - 2 * s ** 3) * (to[k]! - value));
      lines.push([(lines.length - 1) / 50, ...at.map(value => value.toFixed(5)), 180, 0, 0, closed].join(","));
    }
    now = [...to];
  };
  const grip = ([x, y, z]: readonly [number, number, number], closes: 0 | 1): void => {
    go([x, y, z + 0.12], 40);
    go([x, y, z], 30);
    go([x, y, z], 15);
    closed = closes;
    go([x, y, z], 15);
    go([x, y, z + 0.12], 30);
  };
  grip([0.103, -0.946, 0.579], 1);
  grip([0.804, 0.003, 0.582], 0);
  grip([0.097, -0.953, 0.58], 1);
  grip([0.946, 0.153, 0.578], 0);
  return lines.join("\n");
}

test("M-54 two of nine placements, each missed by 5 mm, become a program for all nine, right to 2 mm, that moves with the pallet", async () => {
  const { page, problems } = await studio.open({ width: 1440, height: 900 });
  await drawn(page);
  const cell = JSON.parse(
    await readFile(new URL("../../../examples/05-pallet-of-nine/cell.json", import.meta.url), "utf8"),
  ) as {
    objects: object[];
    programs: object[];
  };
  cell.programs = cell.programs.map(program => ({ ...program, pallets: {}, steps: [] }));
  cell.objects.push({
    id: "part",
    name: "Part",
    role: "workpiece",
    worldFromObject: { position: [0.1, -0.95, 0.54], quaternion: [0, 0, 0, 1] },
    color: "#c79a5a",
    shape: { kind: "box", size_m: [0.1, 0.1, 0.08] },
  });
  await page.evaluate(text => {
    window.twincell.stores.viewStore.setState({ coachDone: true });
    window.twincell.document.open(text, "cell.json");
  }, JSON.stringify(cell));
  await page
    .locator("[data-file-input]")
    .setInputFiles({ name: "two.csv", mimeType: "text/csv", buffer: Buffer.from(twoPlacements()) });
  const dialog = page.getByRole("dialog", { name: "two.csv" });
  const places = dialog.getByRole("textbox", { name: /^Places/ });
  await places.fill("1");
  await places.press("Enter");
  await dialog.getByRole("alert").filter({ hasText: "1 place does not fit" }).waitFor();
  await places.fill("9");
  await places.press("Enter");
  await dialog.getByText("“Part” on “Pallet”: 3 × 3 places.").waitFor();
  await dialog.getByText("The 2 placements shown are at most").waitFor();
  await page.screenshot({ path: picture("whole-pallet") });
  await dialog.getByRole("button", { name: "Make a pallet program" }).click();
  await dialog.waitFor({ state: "hidden" });
  const taught = (): Promise<Program> =>
    page.evaluate(() => {
      const { document } = window.twincell.stores.cellStore.getState();
      return document!.programs.find(program => program.name === document!.program) as Program;
    });
  const opens = async (): Promise<Vector3[]> => {
    const program = await taught();
    const found: Vector3[] = [];
    let last: Vector3 = [0, 0, 0];
    for (const step of unrolled(program)) {
      if (step.type === "gripper" && !step.closed) found.push(last);
      if (step.type === "move" && "pose" in step.target)
        last = transformPoint(program.frames[step.target.frame] ?? pose(), step.target.pose.position);
    }
    return found;
  };
  const wanted = [0, 1, 2].flatMap(row => [0, 1, 2].map((column): Vector3 => [0.8 + 0.15 * column, 0.15 * row, 0.58]));
  const worst_m = (found: readonly Vector3[], aside_m: number): number =>
    Math.max(...wanted.map(([x, y, z]) => Math.min(...found.map(each => distance(each, [x, y + aside_m, z])))));
  const nine = await opens();
  expect(nine).toHaveLength(9);
  expect(worst_m(nine, 0)).toBeLessThan(0.002);
  expect((await taught()).steps).toHaveLength(1);
  await page.waitForFunction(
    () => {
      const { verdict, stale } = window.twincell.stores.playStore.getState();
      return verdict !== null && !stale;
    },
    null,
    { timeout: 60_000, polling: 100 },
  );
  const bad = await page.evaluate(
    () => window.twincell.stores.playStore.getState().verdict!.steps.filter(step => step.verdict === "bad").length,
  );
  expect(bad).toBe(0);
  await page.screenshot({ path: picture("whole-pallet-program") });
  await page.evaluate(() => {
    window.twincell.document.commit("move", document => ({
      ...document,
      objects: document.objects.map(object =>
        object.id === "table"
          ? {
              ...object,
              worldFromObject: { ...object.worldFromObject, position: [0.95, 0.2, 0.25] as [number, number, number] },
            }
          : object,
      ),
    }));
  });
  expect(worst_m(await opens(), 0.05)).toBeLessThan(0.002);
  expect(problems).toEqual([]);
});

test("a table that is no demonstration is refused with its line, and nothing changes", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  await page
    .locator("[data-file-input]")
    .setInputFiles({ name: "bad.csv", mimeType: "text/csv", buffer: Buffer.from("a,b\n1,2\n") });
  await page.getByText("bad.csv, line 1: The column of times, t_s or t_ms, is missing.").waitFor();
  expect(problems).toEqual([]);
});
