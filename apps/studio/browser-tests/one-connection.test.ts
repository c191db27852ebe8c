import { identity, type MoveStep } from "@twincell/core";
import { saveDocument, tracedCartonCell, type CellDocument } from "@twincell/project";
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

const carton = tracedCartonCell();
/** The robot in its cell, with nothing taught yet. */
const cellOf = (robot: string): CellDocument => ({
  ...carton,
  name: "One connection",
  robot: { ...carton.robot, id: robot, ...(robot === carton.robot.id ? {} : { worldFromBase: identity() }) },
  ...(robot === carton.robot.id ? {} : { objects: [], frames: [], allowedPairs: [] }),
  program: "Taught",
  programs: [{ ...carton.programs[0]!, robot, name: "Taught", groups: {}, steps: [] }],
});

/** In the page: how many links are drawn as the robot of the cell, and how many as any other arm. */
function arms(): { readonly own: number; readonly other: number } {
  let own = 0;
  let other = 0;
  window.twincellScene!.scene.traverse(object => {
    const thing = object.userData["thing"] as { readonly kind?: string } | undefined;
    if (thing?.kind === "link") own++;
    if (object.userData["station"] === true) other++;
  });
  return { own, other };
}
const shown = (page: Page) => page.evaluate(() => Array.from(window.twincell.live.shown().q_rad));
/** What the controller reported last. */
const reported = (page: Page) =>
  page.evaluate(() =>
    Array.from(window.twincell.live.station(window.twincell.stores.connectionStore.getState().station!)!.q_rad),
  );
const stands = (page: Page) =>
  page.waitForFunction(
    () => {
      const [station] = window.twincell.stores.stationStore.getState().stations;
      return station !== undefined && !station.moving && !station.running;
    },
    null,
    { timeout: 60_000, polling: 100 },
  );
async function sameJoints(page: Page): Promise<void> {
  const [a, b] = await page.evaluate(() => {
    const { connectionStore } = window.twincell.stores;
    return [
      Array.from(window.twincell.live.shown().q_rad),
      Array.from(window.twincell.live.station(connectionStore.getState().station!)!.q_rad),
    ];
  });
  a!.forEach((angle, j) => expect(angle).toBeCloseTo(b![j]!, 9));
}
/** Jogs a joint with the enabling switch held by Space, until it has turned by that much [rad]. */
async function jog(page: Page, joint: number, by_rad: number): Promise<void> {
  const from = (await shown(page))[joint - 1]!;
  await page.keyboard.down("Space");
  await page.waitForFunction(() => window.twincell.stores.connectionStore.getState().enabled);
  await page.getByRole("button", { name: `Jog J${joint} up` }).hover();
  await page.mouse.down();
  await page.waitForFunction(
    ([at, start, far]) => Math.abs(window.twincell.live.shown().q_rad[at!]! - start!) > far!,
    [joint - 1, from, by_rad] as const,
    { timeout: 30_000, polling: 30 },
  );
  await page.mouse.up();
  await stands(page);
  await page.keyboard.up("Space");
}

/**
 * Runs the program; a check that is not content asks, since an arm that is stretched at home turns over at once when it
 * is left.
 */
async function start(page: Page): Promise<void> {
  await page.evaluate(() => window.twincell.run("run.start"));
  const red = await page.evaluate(() => window.twincell.stores.playStore.getState().verdict?.ok === false);
  if (red) await page.getByRole("button", { name: "Run all the same" }).click();
}

for (const [maker, option, robot] of [
  ["Stäubli CS7", "Virtual: Stäubli CS7 (V+)", "staubli_rx90l"],
  ["UR", "Virtual: Universal Robots", "ur10e"],
  ["Yaskawa", "Virtual: Yaskawa", "yaskawa_gp8"],
] as const)
  test(`T-36 T-37 T-38 ${maker}: the robot of the cell is the connected one, without a second arm: jog, record, run, stop, travel back, clone`, async () => {
    const { page, problems } = await studio.open();
    await drawn(page);
    const cell = cellOf(robot);
    await page.evaluate(text => {
      window.twincell.stores.viewStore.setState({ coachDone: true });
      return window.twincell.document.open(text, "cell.json");
    }, saveDocument(cell));
    await page.waitForFunction(id => window.twincell.stores.cellStore.getState().document?.robot.id === id, robot);
    const alone = await page.evaluate(arms);
    expect(alone.own).toBeGreaterThan(5);
    const before = await page.evaluate(() => window.twincell.stores.cellStore.getState().document);

    // Connect: nothing else in the cell changes, and no second arm is drawn.
    await page.getByRole("combobox", { name: "Connection" }).click();
    await page.getByRole("option", { name: option }).click();
    await page.waitForFunction(
      () => window.twincell.stores.stationStore.getState().stations[0]?.link.state === "open",
      null,
      { timeout: 60_000 },
    );
    await stands(page);
    expect(await page.evaluate(() => window.twincell.stores.stationStore.getState().stations.length)).toBe(1);
    expect(await page.evaluate(() => window.twincell.stores.cellStore.getState().document)).toEqual(before);
    await page.getByText("Live · jogging moves the robot").waitFor();

    // Nothing moves before the switch is held; held, it is jogged, and what is drawn is what the controller says.
    await page.getByRole("radio", { name: "Joint", exact: true }).click();
    const home = await reported(page);
    await page.getByRole("button", { name: "Jog J1 up" }).hover();
    await page.mouse.down();
    await page.waitForFunction(
      () => window.twincell.stores.jogStore.getState().blocked?.sentence === "Hold the enabling switch first.",
      null,
      { polling: 30 },
    );
    await page.mouse.up();
    expect(await reported(page)).toEqual(home);
    await page.getByRole("button", { name: "PTP", exact: true }).click();
    await jog(page, 1, 0.08);
    await sameJoints(page);
    await page.screenshot({ path: picture(`one-connection-live-${robot}`) });
    expect(await page.evaluate(arms)).toEqual(alone);
    await page.getByRole("button", { name: "PTP", exact: true }).click();
    await jog(page, 6, 0.08);
    await sameJoints(page);
    await page.getByRole("button", { name: "PTP", exact: true }).click();
    const steps = await page.evaluate(() =>
      window.twincell.stores.cellStore
        .getState()
        .document!.programs.flatMap(each => (each.format === "twincell.program" ? each.steps : [])),
    );
    expect(steps.map(({ type }) => type)).toEqual(["move", "move", "move"]);
    expect(await page.evaluate(() => window.twincell.stores.connectionStore.getState().view)).toBe("live");
    const taught = await reported(page);

    // Run what was taught on the controller: the robot on screen is the twin, and the run is recorded.
    await page.waitForFunction(
      () => {
        const { verdict, stale } = window.twincell.stores.playStore.getState();
        return verdict !== null && !stale;
      },
      null,
      { timeout: 60_000, polling: 100 },
    );
    const moved = page.waitForFunction(() => window.twincell.stores.stationStore.getState().stations[0]?.moving, null, {
      timeout: 60_000,
      polling: 30,
    });
    await start(page);
    await moved;
    const ended = (count: number) =>
      page.waitForFunction(
        runs =>
          window.twincell.stores.historyStore.getState().runs.filter(({ ending }) => ending !== "running").length ===
          runs,
        count,
        { timeout: 90_000, polling: 100 },
      );
    await ended(1);
    await stands(page);
    await sameJoints(page);
    (await shown(page)).forEach((angle, j) => expect(angle).toBeCloseTo(taught[j]!, 3));
    expect(await page.evaluate(arms)).toEqual(alone);

    // A second run is stopped by STOP: the controller stands before its end.
    await start(page);
    await page.waitForFunction(() => window.twincell.stores.stationStore.getState().stations[0]?.moving, null, {
      timeout: 60_000,
      polling: 30,
    });
    await page.getByRole("button", { name: "STOP", exact: true }).click();
    await ended(2);
    await stands(page);
    expect(
      (
        await page.evaluate(() => window.twincell.stores.historyStore.getState().runs.map(({ ending }) => ending))
      ).sort(),
    ).toEqual(["done", "stopped"]);
    await sameJoints(page);

    // Travel back in the first run: the robot of the cell is shown as it was; back in Teach it is the twin again.
    const stopped = await shown(page);
    await page.getByRole("radio", { name: "History" }).click();
    const row = page.getByRole("listitem").filter({ has: page.getByRole("button", { name: /Download/ }) });
    await row.last().getByRole("button").first().click();
    await page.waitForFunction(() => window.twincell.stores.historyStore.getState().duration_s > 0, null, {
      timeout: 30_000,
    });
    const slider = page.getByRole("slider", { name: "Moment of the run" });
    await slider.focus();
    await slider.press("End");
    await page.waitForFunction(
      ([joint, at]) => Math.abs(window.twincell.live.shown().q_rad[joint!]! - at!) < 2e-3,
      [5, taught[5]!] as const,
      { timeout: 20_000 },
    );
    expect(await page.evaluate(arms)).toEqual(alone);
    await page.getByRole("radio", { name: "Teach" }).click();
    await sameJoints(page);
    (await shown(page)).forEach((angle, j) => expect(angle).toBeCloseTo(stopped[j]!, 3));

    // The clone begins where the robot is, and is moved without moving it.
    await page.getByRole("radio", { name: "Clone" }).click();
    await page.getByText("Clone · not moving the robot").waitFor();
    await sameJoints(page);
    await page.waitForFunction(
      own => {
        let other = 0;
        window.twincellScene!.scene.traverse(object => {
          if (object.userData["station"] === true) other++;
        });
        return other === own;
      },
      alone.own,
      { timeout: 20_000 },
    );
    const twin = await reported(page);
    await page.getByRole("radio", { name: "In steps" }).click();
    const step_rad = await page.evaluate(() => window.twincell.stores.jogStore.getState().step_rad);
    const cloned = await shown(page);
    for (let n = 1; n <= 5; n++) {
      await page.getByRole("button", { name: "Jog J1 up" }).hover();
      await page.mouse.down();
      await page.waitForFunction(
        at => Math.abs(window.twincell.live.shown().q_rad[0]! - at) < 1e-6,
        cloned[0]! + n * step_rad,
        { timeout: 10_000, polling: 30 },
      );
      await page.mouse.up();
      await page.waitForFunction(() => !window.twincell.stores.jogStore.getState().moving, null, { polling: 30 });
    }
    expect(await reported(page)).toEqual(twin);
    await page.screenshot({ path: picture(`one-connection-clone-${robot}`) });

    // Sent there, the robot comes to the clone while the switch is held.
    const send = page.getByRole("button", { name: "Send there" });
    expect(await send.isDisabled()).toBe(true);
    await page.keyboard.down("Space");
    await page.waitForFunction(() => window.twincell.stores.connectionStore.getState().enabled);
    await send.click();
    await page.waitForFunction(
      () => {
        const id = window.twincell.stores.connectionStore.getState().station!;
        const twinNow = window.twincell.live.station(id)!.q_rad;
        return Array.from(window.twincell.live.shown().q_rad).every((q, j) => Math.abs(q - twinNow[j]!) < 1e-3);
      },
      null,
      { timeout: 30_000, polling: 50 },
    );
    await page.keyboard.up("Space");

    // Back to the simulated controller: the robot stays where it is drawn, the program too.
    await page.getByRole("combobox", { name: "Connection" }).click();
    await page.getByRole("option", { name: "Simulated" }).click();
    await page.waitForFunction(() => window.twincell.stores.stationStore.getState().stations.length === 0);
    expect(
      await page.evaluate(() =>
        window.twincell.stores.cellStore
          .getState()
          .document!.programs.flatMap(each => (each.format === "twincell.program" ? each.steps : [])),
      ),
    ).toEqual(steps);
    expect(problems).toEqual([]);
    await page.context().close();
  }, 240_000);

test("T-53 X-56 the Run panel: a program runs cycle after cycle, is held before a step, stepped, jogged by hand and handed back; a changed program takes over at the next cycle", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  const empty = cellOf("yaskawa_gp8");
  const step = (id: string, name: string, turn_rad: number): MoveStep => ({
    id,
    name,
    type: "move",
    path: "ptp",
    target: { q: [turn_rad, 0.1, 0, 0, -0.5, 0] },
    speed: { ratio: 0.5 },
    blend_m: 0,
  });
  const steps = [step("a", "First", 0.2), step("b", "Second", 0.4), step("c", "Third", 0.1)];
  const cell: CellDocument = { ...empty, programs: [{ ...empty.programs[0]!, steps } as CellDocument["programs"][0]] };
  await page.evaluate(text => {
    window.twincell.stores.viewStore.setState({ coachDone: true });
    return window.twincell.document.open(text, "cell.json");
  }, saveDocument(cell));
  await page.getByRole("combobox", { name: "Connection" }).click();
  await page.getByRole("option", { name: "Virtual: Yaskawa" }).click();
  await page.waitForFunction(
    () => window.twincell.stores.stationStore.getState().stations[0]?.link.state === "open",
    null,
    { timeout: 60_000 },
  );
  await stands(page);
  await page.getByRole("radio", { name: "Run" }).click();
  const panel = page.getByRole("group", { name: "Cycle after cycle" });
  const says = (words: string) =>
    panel.getByTestId("production-state").filter({ hasText: words }).waitFor({ timeout: 90_000 });
  const choose = (id: string) =>
    page.evaluate(step => window.twincell.stores.selectionStore.setState({ selected: { kind: "step", id: step } }), id);
  await panel.getByRole("button", { name: "Select a step to hold before it" }).waitFor();
  await choose("b");
  await panel.getByRole("button", { name: "Hold before Second" }).click();
  await panel.getByRole("radio", { name: "Several times" }).click();
  await panel.getByLabel("Cycles").fill("2");
  await panel.getByLabel("Cycles").press("Enter");
  await panel.getByRole("button", { name: "Begin" }).click();
  await says("Cycle 1 of 2 is held before: Second");
  await page.screenshot({ path: picture("production-held") });
  await panel.getByRole("button", { name: "One step" }).click();
  await says("Cycle 1 of 2 is held before: Third");
  expect((await reported(page))[0]).toBeCloseTo(0.4, 3);

  // The second cycle has two steps, without a place to hold: what takes over was checked before.
  await choose("c");
  await page.evaluate(() => window.twincell.run("program.delete"));
  await panel.getByRole("button", { name: "Use the changed program from the next cycle" }).click();
  await panel.getByText("“Taught” takes over at the next cycle.").waitFor({ timeout: 90_000 });
  await panel.getByRole("button", { name: "No longer held before Second" }).click();

  // Taken over by hand, from the pendant, and handed back with the step it was in.
  await page.getByRole("radio", { name: "Teach" }).click();
  await page.getByRole("radio", { name: "Joint", exact: true }).click();
  const from = (await reported(page))[0]!;
  await page.keyboard.down("Space");
  await page.waitForFunction(() => window.twincell.stores.connectionStore.getState().enabled);
  await page.getByRole("button", { name: "Jog J1 up" }).hover();
  await page.mouse.down();
  await page.waitForFunction(at => window.twincell.live.shown().q_rad[0]! - at > 0.05, from, {
    timeout: 30_000,
    polling: 30,
  });
  await page.mouse.up();
  await page.waitForFunction(() => window.twincell.stores.stationStore.getState().stations[0]?.moving === false);
  await page.keyboard.up("Space");
  await page.getByRole("radio", { name: "Run" }).click();
  await says("Cycle 1 of 2 is held before");
  await panel.getByRole("button", { name: "Hand back" }).click();
  await page.waitForFunction(
    () => {
      const [run] = window.twincell.stores.historyStore.getState().runs;
      return run !== undefined && run.ending !== "running";
    },
    null,
    { timeout: 90_000, polling: 100 },
  );
  await stands(page);
  expect(await page.evaluate(() => window.twincell.stores.historyStore.getState().runs.map(run => run.ending))).toEqual(
    ["done"],
  );
  expect((await reported(page))[0]).toBeCloseTo(0.4, 3);
  await panel.getByRole("button", { name: "Begin" }).waitFor();
  expect(problems).toEqual([]);
  await page.context().close();
}, 240_000);
